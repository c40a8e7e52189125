//! Errands: a plan in a random room, with a target.
//!
//! A room is suitable for an errand if a wide enough path leads to its goal; missing the goal is
//! then the plan's fault.

use std::sync::OnceLock;

use afp_core::trace::Ending;
use afp_core::{Duration, Instant};
use afp_sim::world::Mobility;
use afp_sim::{Pose, World};

use crate::case::Case;
use crate::chance::Dice;
use crate::contact::Contact;
use crate::drive::Outcome;
use crate::plans::{Plan, part, plan};
use crate::reach::{Reach, bounds, is_in_sight, room};

/// The range sensor does not detect obstacles lower than this, in metres.
const HEARD: f64 = 0.15;
/// The height of the robot's eyes, in metres.
const EYE: f64 = 0.15;
/// The attempts to find a random goal.
const TRIES: usize = 200;
/// The free distance around the lane to a goal straight ahead, in metres.
const LANE: f64 = 0.45;
/// The free distance around the middle of a bin, in metres.
const BIN: f64 = 0.25;
/// The smallest distance of a random goal from the start, in metres.
const APART: f64 = 1.5;

/// A plan, a room and a goal.
#[derive(Clone, Debug)]
pub struct Errand {
    /// The case, with its time limit.
    pub case: Case,
    /// The text of the room's file, to repeat the drive by hand.
    pub text: String,
    goal: [f64; 2],
    /// The largest final distance of the robot's middle from the goal, in metres.
    within: f64,
    /// Whether a place beyond the goal, seen from the start, is as good.
    beyond: bool,
}

impl Errand {
    /// Two metres straight ahead, around obstacles; `None` if the room with that number is not
    /// suitable.
    pub fn ahead(number: u64) -> Option<Errand> {
        let text = World::random_text(number);
        let world = parsed(&text);
        let Pose { x, y, heading } = world.start;
        let goal = [x + 2.0 * heading.cos(), y + 2.0 * heading.sin()];
        let fit = Reach::of(&world).has(goal) && room(&world, goal) > LANE;
        let case = Case::quiet(plan("avoid_obstacle"), world, number);
        // The place counts as reached from 40 cm, and the odometry drifts.
        fit.then(|| Errand { case: lasting(case, 300), text, goal, within: 0.7, beyond: true })
    }

    /// To the bright surroundings of the room's beacon.
    pub fn beacon(number: u64) -> Option<Errand> {
        let text = World::random_text(number);
        let world = parsed(&text);
        let goal = world.lights[0].position;
        // The distance from turning centre to beacon with enough brightness: the sensor is 18 cm
        // ahead.
        let seen = |place| is_in_sight(&world, (place, EYE), (goal, world.lights[0].height));
        let fit = Reach::of(&world).near(goal, 0.5).any(seen);
        let case = Case::quiet(plan("find_infrared"), world, number);
        fit.then(|| Errand { case: lasting(case, 300), text, goal, within: 0.9, beyond: false })
    }

    /// To a pink bin at a random place.
    pub fn bin(number: u64) -> Option<Errand> {
        let text = World::random_text(number);
        let world = parsed(&text);
        let goal = somewhere(&world, number, |place| room(&world, place) > BIN)?;
        let text = format!(
            "{text}\n[[box]]\nname = \"bin\"\npose_m_deg = [{:.3}, {:.3}, 30.0]\nsize_m = [0.3, 0.3]\n\
             height_m = 0.5\ncolor = \"#d91a80\"\n",
            goal[0], goal[1]
        );
        let seen = |place| is_in_sight(&world, (place, EYE), (goal, EYE));
        let with = World::parse(&text).ok()?;
        let fit = Reach::of(&with).near(goal, 0.7).any(seen);
        let case = Case::quiet(plan("find_object"), with, number);
        fit.then(|| Errand { case: lasting(case, 300), text, goal, within: 1.2, beyond: false })
    }

    pub fn place(number: u64) -> Option<Errand> {
        let text = World::random_text(number);
        let world = parsed(&text);
        let reach = Reach::of(&world);
        Errand::within_reach((&world, &reach), text, number, 180)
    }

    /// To a reachable place of a world, within some seconds; the number selects the place.
    pub fn within_reach(
        (world, reach): (&World, &Reach),
        text: String,
        number: u64,
        seconds: u64,
    ) -> Option<Errand> {
        static GO_TO: OnceLock<Plan> = OnceLock::new();
        let goal = somewhere(world, number, |place| reach.has(place))?;
        let plan = GO_TO.get_or_init(|| part("parts/go_to", "GoTo"));
        let mut case = lasting(Case::quiet(plan, world.clone(), number), seconds);
        case.inputs = ["x", "y"].into_iter().zip(goal.map(|at| format!("{at} m"))).collect();
        Some(Errand { case, text, goal, within: 0.3, beyond: false })
    }

    /// The reason why the robot failed its errand, if it did.
    pub fn objection(&self, outcome: &Outcome) -> Option<String> {
        let [mut x, mut y] = [outcome.pose.x - self.goal[0], outcome.pose.y - self.goal[1]];
        let (sin, cos) = self.case.world.start.heading.sin_cos();
        let beyond = (x * cos + y * sin).max(0.0);
        if self.beyond {
            (x, y) = (x - beyond * cos, y - beyond * sin);
        }
        let far = x.hypot(y);
        match outcome.ending {
            None => Some(format!("not yet there, {far:.1} m away")),
            Some(Ending::Ok) if far <= self.within => None,
            Some(Ending::Ok) => Some(format!("ended {far:.1} m away")),
            Some(ending) => Some(format!("{ending:?}, {far:.1} m away")),
        }
    }

    /// The contacts with obstacles that the range sensor detects and that do not walk into the
    /// robot.
    pub fn touches<'a>(&self, outcome: &'a Outcome) -> impl Iterator<Item = &'a Contact> {
        outcome.contacts.iter().filter(|contact| {
            let obstacle = self.case.world.obstacles.get(contact.obstacle);
            let walks = |mobility: &Mobility| matches!(mobility, Mobility::Scripted(_));
            obstacle.is_some_and(|it| it.height >= HEARD && !walks(&it.mobility))
        })
    }
}

fn parsed(text: &str) -> World {
    World::parse(text).expect("a generated room is valid")
}

fn lasting(case: Case, seconds: u64) -> Case {
    Case { until: Instant::ZERO + Duration::from_secs(seconds), ..case }
}

/// A suitable place of the room, away from the start.
fn somewhere(world: &World, number: u64, is_fit: impl Fn([f64; 2]) -> bool) -> Option<[f64; 2]> {
    let (low, high) = bounds(world);
    let mut dice = Dice::new(number, 3);
    (0..TRIES).find_map(|_| {
        let place = [0, 1].map(|i| dice.between(low[i], high[i]));
        let far = (place[0] - world.start.x).hypot(place[1] - world.start.y);
        (far >= APART && is_fit(place)).then_some(place)
    })
}
