//! Success rates of plans in random rooms, with times and contacts. `AFP_GOALS` sets the first seed
//! and the number of rooms, as in `AFP_GOALS=5000..100`; `AFP_GOAL` shows the details of one run,
//! as in `AFP_GOAL=5017`.

use std::collections::BTreeMap;
use std::env;
use std::sync::{Mutex, PoisonError};

use afp_core::Instant;
use afp_worlds::{Contact, Errand, Outcome, Pushes, run};
use rayon::iter::{ParallelBridge, ParallelIterator};

/// The default rooms: the first seed and the number.
const ROOMS: (u64, usize) = (1000, 24);

fn rooms() -> (u64, usize) {
    if let Ok(room) = env::var("AFP_GOAL") {
        return (room.parse().unwrap_or_else(|_| panic!("AFP_GOAL={room}: not a number")), 1);
    }
    let Ok(text) = env::var("AFP_GOALS") else { return ROOMS };
    let parts = text.split_once("..").and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
    parts.unwrap_or_else(|| panic!("AFP_GOALS={text}: not FIRST..COUNT"))
}

/// Rooms with a longer push are listed, in seconds.
const PUSHED: f64 = 1.0;

/// The results of a plan in all rooms.
#[derive(Debug, Default)]
struct Account {
    /// The rooms with a missed goal, and the reasons.
    missed: Vec<(u64, String)>,
    /// The rooms with forbidden contacts, and the actors.
    touched: Vec<(u64, Vec<Contact>)>,
    /// The times to the goal, in seconds.
    took: Vec<f64>,
    /// The durations of pushes in seconds, with the rooms and the obstacles.
    pushed: Vec<(f64, u64, Pushes)>,
    /// The durations of contacts while driving in any direction, in seconds.
    touching: Vec<f64>,
    /// The rooms in which the robot was lost, and since when.
    astray: Vec<(u64, Instant)>,
}

impl Account {
    fn add(&mut self, errand: &Errand, outcome: &Outcome) {
        let room = errand.case.seed;
        match errand.objection(outcome) {
            Some(why) => self.missed.push((room, why)),
            None => self.took.push(outcome.at.as_secs_f64()),
        }
        let touches: Vec<_> = errand.touches(outcome).cloned().collect();
        if !touches.is_empty() {
            self.touched.push((room, touches));
        }
        let pushes = outcome.seen.pushes.clone();
        self.pushed.push((outcome.seen.pushing.as_secs_f64(), room, pushes));
        self.touching.push(outcome.seen.touching.as_secs_f64());
        self.astray.extend(outcome.seen.astray.map(|at| (room, at)));
    }

    /// Sorts and prints everything.
    fn tell(&mut self, name: &str) {
        self.missed.sort();
        self.touched.sort_by_key(|(room, _)| *room);
        self.took.sort_by(f64::total_cmp);
        let (reached, all) = (self.took.len(), self.took.len() + self.missed.len());
        let share = |share: usize| self.took.get(reached * share / 100).copied().unwrap_or(0.0);
        println!("{name}: {reached} of {all} reach their goal, {} touch", self.touched.len());
        println!("  after {:.0} s mostly, {:.0} s of nine in ten", share(50), share(90));
        println!("  in a minute: {}", self.took.iter().filter(|took| **took <= 60.0).count());
        self.pushed.sort_by(|a, b| b.0.total_cmp(&a.0));
        let long: Vec<_> = self.pushed.iter().take_while(|(time, ..)| *time > PUSHED).collect();
        println!("  pushed for more than {PUSHED} s in {}", long.len());
        for (time, room, pushes) in long {
            print!("  pushed for {time:.1} s in random:{room}\n{pushes}");
        }
        let touching = self.touching.iter().filter(|time| **time > PUSHED).count();
        println!("  touched something for more than {PUSHED} s while it drove in {touching}");
        self.astray.sort();
        for (room, at) in &self.astray {
            println!("  astray in random:{room} from {at} on");
        }
        let mut by: BTreeMap<&str, usize> = BTreeMap::new();
        for contact in self.touched.iter().flat_map(|(_, contacts)| contacts) {
            *by.entry(&contact.actor).or_default() += 1;
        }
        println!("  touches by actor: {by:?}");
        for (room, contacts) in &self.touched {
            let contacts: Vec<_> = contacts.iter().map(Contact::to_string).collect();
            println!("  touched in random:{room}: {}", contacts.join(", "));
        }
        for (room, why) in &self.missed {
            println!("  missed in random:{room}: {why}");
        }
    }

    /// Whether at most one goal of this number is missed.
    fn misses_one_of(&self, many: usize) -> bool {
        self.missed.len() * many <= self.took.len() + self.missed.len()
    }
}

/// Runs an errand in the first suitable rooms.
fn sent(name: &str, errand: fn(u64) -> Option<Errand>) -> Account {
    let (first, count) = rooms();
    let account = Mutex::new(Account::default());
    // Rooms are tested while others are driven in; two thirds are suitable.
    (first..).filter_map(errand).take(count).par_bridge().for_each(|errand| {
        let outcome = run(&errand.case);
        if env::var_os("AFP_GOAL").is_some() {
            println!("{}\n{}\n{}", errand.text, errand.case, outcome.timeline);
            println!("{}", outcome.seen.pushes);
        }
        account.lock().unwrap_or_else(PoisonError::into_inner).add(&errand, &outcome);
    });
    let mut account = account.into_inner().unwrap_or_else(PoisonError::into_inner);
    account.tell(name);
    account
}

#[test]
fn obstacles_are_avoided() {
    let account = sent("avoid_obstacle", Errand::ahead);
    assert!(account.misses_one_of(6), "{account:?}");
}

#[test]
fn the_beacon_is_found() {
    let account = sent("find_infrared", Errand::beacon);
    assert!(account.misses_one_of(6), "{account:?}");
}

#[test]
fn the_bin_is_found() {
    let account = sent("find_object", Errand::bin);
    assert!(account.misses_one_of(6), "{account:?}");
}

#[test]
fn the_place_is_reached() {
    let account = sent("navigate_room", Errand::place);
    assert!(account.misses_one_of(6), "{account:?}");
}
