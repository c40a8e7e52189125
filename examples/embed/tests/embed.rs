//! The embedding program, as its users would check it.

use afp::quantity::Length;
use afp::{Ending, Wake};
use embed::{errand, fetch, follow, open};

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
