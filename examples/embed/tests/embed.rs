//! Tests of the embedding program, from its users' point of view.

use afp::quantity::{AngularSpeed, Length, Speed};
use afp::trace::{Line, Observe, Record};
use afp::{Ending, Instant, NamedPlan, Plan, Platform, Scheduler, Wake};
use afp_carbot::devices::{Navigator, Odometry};
use afp_sim::{Simulation, World};
use embed::{errand, fetch, follow, open};

afp::plan!("../../plans/wall_following.afp");

const ROOM: &str = include_str!("../room.toml");

#[test]
fn entries_are_set_and_read_and_events_arrive() {
    let mut shop = open(include_str!("../../../worlds/wall_following.toml"), 3).unwrap();
    let followed = follow(&mut shop, Length::from_si(0.25), Length::from_si(0.35), 20).unwrap();
    let angle = followed.wall_angle.expect("a wall was found").si().to_degrees();
    assert!((-180.0..180.0).contains(&angle), "{angle} deg");
    assert!(followed.activations.iter().any(|line| line.ends_with(" followWall")));
    let gap = shop.robot.truth().right_side_gap().expect("a wall is beside it");
    assert!((gap - 0.35).abs() < 0.04, "the outside write moved it to {gap} m");
}

#[test]
fn a_template_calls_the_program_back() {
    let mut shop = open(ROOM, 1).unwrap();
    assert_eq!(fetch(&mut shop, 2).unwrap(), Wake::Ended(Ending::Ok));
    assert_eq!(shop.announced, ["fetched 2"]);
}

#[test]
fn a_sub_plan_runs_by_itself_and_the_bumper_interrupts_it() {
    let mut shop = open(ROOM, 1).unwrap();
    assert_eq!(errand(&mut shop, Length::from_si(0.3)).unwrap(), Wake::Ended(Ending::Ok));
    let far = errand(&mut shop, Length::from_si(10.0)).unwrap();
    assert_eq!(far, Wake::Ended(Ending::Interrupted));
}

/// The trace of the paper's plan on a platform in half a minute.
fn trace<E: Platform>(on: &mut E) -> Vec<String>
where
    WallFollowing: Plan<E>,
{
    let plan = WallFollowing::new();
    let (names, mut lines) = (plan.names(), Vec::new());
    let mut sink = Observe(|at: Instant, record: &Record<'_>| {
        lines.push(Line { at, record, names: &names }.to_string());
    });
    let end = Instant::from_nanos(30_000_000_000);
    Scheduler::new(plan).run_until(on, &mut sink, end).expect("it starts");
    lines
}

#[test]
fn the_robot_in_the_shop_is_the_robot() {
    let world = include_str!("corner.toml");
    let mut robot = Simulation::new(&World::parse(world).unwrap(), 1).unwrap();
    let mut shop = open(world, 1).unwrap();
    let (alone, within) = (trace(&mut robot), trace(&mut shop));
    assert!(alone.iter().any(|line| line.contains("TouchSensorPressed")), "it bumps");
    assert_eq!(alone, within);
    assert!(robot.last_bump().is_some());
    assert_eq!(robot.last_bump(), shop.last_bump());
    assert_eq!(format!("{:?}", robot.trail()), format!("{:?}", shop.trail()));
    let (speed, turn) = (Speed::from_si(10.0), AngularSpeed::from_si(1.0));
    assert_eq!(robot.reduced(speed, turn), shop.reduced(speed, turn));
}
