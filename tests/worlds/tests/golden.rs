//! Recorded trace hashes: equal on every machine and at every optimisation level.
//!
//! Only a new engine or a changed model, template or plan may change them; `AFP_BLESS=1` then
//! records them again.

use std::env;
use std::fs;
use std::path::Path;

use afp_sim::World;
use afp_worlds::{Case, plan, run};

/// The number of recorded random worlds.
const RANDOM: u64 = 24;
/// The number of robots in the room of the paper.
const QUIET: u64 = 4;

/// The plans are listed by name, so that a new one changes nothing here.
fn cases() -> impl Iterator<Item = (String, Case)> {
    let room = include_str!("../../../worlds/wall_following.toml");
    let room = World::parse(room).expect("the room is well-formed");
    let (follow, rounds) = (plan("wall_following"), plan("rounds"));
    let quiet = (0..QUIET).map(move |seed| {
        (format!("room of the paper, seed {seed}"), Case::quiet(follow, room.clone(), seed))
    });
    let random = (0..RANDOM).map(move |number| {
        let plan = if number % 2 == 0 { follow } else { rounds };
        (format!("world {number}"), Case { plan, ..Case::random(number) })
    });
    quiet.chain(random)
}

#[test]
fn traces_equal_the_recorded_traces() {
    let line = |(name, case): (String, Case)| {
        let plan = &case.plan.name;
        format!("{} {plan}, {name}\n", run(&case).trace)
    };
    let now: String = cases().map(line).collect();
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden.txt");
    if env::var_os("AFP_BLESS").is_some() {
        fs::write(&file, &now).expect("the file can be written");
    }
    let recorded = fs::read_to_string(&file).expect("the file can be read");
    for (now, recorded) in now.lines().zip(recorded.lines()) {
        assert_eq!(now, recorded, "AFP_BLESS=1 cargo test -p afp-worlds records anew");
    }
    assert_eq!(now.lines().count(), recorded.lines().count());
}
