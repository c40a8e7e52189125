//! A hand in a world: objects are at their new places, and occupied places are refused.

use super::*;
use crate::world::World;
use afp_core::Instant;
use afp_session::Robot;

const ROOM: &str = "version = 1\n[robot]\npose_m_deg = [0, 0, 0]\n\
    [[box]]\nname = \"bin\"\npose_m_deg = [1, 0, 0]\nsize_m = [0.2, 0.2]\nheight_m = 0.4\nmass_kg = 1\n\
    [[box]]\nname = \"post\"\npose_m_deg = [0, 2, 0]\nsize_m = [0.2, 0.2]\nheight_m = 0.4\n";

fn at(x: f64, y: f64) -> Pose {
    Pose { x, y, heading: 0.0 }
}

fn room() -> Simulation {
    Simulation::new(&World::parse(ROOM).unwrap(), 1).unwrap()
}

fn middle(corners: &[[f64; 2]]) -> [i64; 2] {
    let sum = corners.iter().fold([0.0, 0.0], |sum, at| [sum[0] + at[0], sum[1] + at[1]]);
    sum.map(|part| (part / corners.len() as f64 * 1000.0).round() as i64)
}

#[test]
fn a_moved_robot_is_at_its_place_and_its_odometry_does_not_change() {
    let mut room = room();
    room.put(&Put::Robot, Pose { heading: 1.0, ..at(-1.0, 0.5) }).unwrap();
    room.advance_to(Instant::from_nanos(500_000_000));
    let pose = room.truth().pose();
    assert!((pose.x + 1.0).abs() < 1e-3 && (pose.heading - 1.0).abs() < 1e-3, "{pose:?}");
    assert!(room.snapshot().odometry.x.si().abs() < 0.01);
}

#[test]
fn movable_objects_are_moved_and_fixed_objects_are_not() {
    let mut room = room();
    room.put(&Put::Thing("bin".to_owned()), at(-0.5, -0.5)).unwrap();
    assert_eq!(middle(&room.outline(0)), [-500, -500]);
    room.put(&Put::Thing("0 bin".to_owned()), at(1.5, 0.0)).unwrap();
    assert_eq!(middle(&room.outline(0)), [1500, 0]);
    for name in ["post", "ghost"] {
        let refused = room.put(&Put::Thing(name.to_owned()), at(1.0, 1.0));
        assert_eq!(refused, Err(RequestError::NoThing(name.to_owned())));
    }
}

#[test]
fn an_object_at_rest_can_be_moved_again() {
    let mut room = room();
    room.put(&Put::New("crate".to_owned()), at(1.0, 0.4)).unwrap();
    for round in 1..=6_u64 {
        room.advance_to(Instant::from_nanos(round * 5_000_000_000));
        // Next to each other, and apart.
        let y = if round % 2 == 0 { 0.4 } else { -0.8 };
        room.put(&Put::Thing("crate 1".to_owned()), at(1.0, y)).unwrap();
        room.put(&Put::Thing("bin".to_owned()), at(1.0, y - 0.35)).unwrap();
    }
    room.advance_to(Instant::from_nanos(31_000_000_000));
    assert_eq!(middle(&room.outline(0)), [1000, 50]);
}

#[test]
fn no_object_is_put_into_an_obstacle() {
    let mut room = room();
    let occupied = |by: &str| Err(RequestError::Occupied(by.to_owned()));
    assert_eq!(room.put(&Put::Robot, at(1.0, 0.1)), occupied("bin"));
    assert_eq!(room.put(&Put::Thing("bin".to_owned()), at(0.0, 0.1)), occupied("the robot"));
    assert_eq!(room.put(&Put::New("crate".to_owned()), at(0.0, 2.0)), occupied("post"));
    assert_eq!(room.put(&Put::Robot, at(1e6, 0.0)), Err(RequestError::Nowhere));
}

#[test]
fn the_number_of_dropped_objects_is_limited() {
    let named = ROOM.replace("\"post\"", "\"can 1\"");
    let mut room = Simulation::new(&World::parse(&named).unwrap(), 1).unwrap();
    let put = |room: &mut Simulation, n: usize| {
        let shape = if n.is_multiple_of(2) { "can" } else { "wall" };
        room.put(&Put::New(shape.to_owned()), at(5.0 + n as f64, 5.0))
    };
    for n in 0..MOST {
        assert_eq!(put(&mut room, n), Ok(()), "{n}");
    }
    assert_eq!(room.stage.obstacles[2].name, "can 2");
    let mut copy = room.keyframe().unwrap();
    for each in [&mut room, &mut copy] {
        assert_eq!(put(each, MOST), Err(RequestError::Full(MOST)));
        assert!(each.put(&Put::Thing("can 2".to_owned()), at(3.0, 3.0)).is_ok());
    }
}

#[test]
fn dropped_objects_are_felt_heard_and_copied() {
    let mut room = room();
    room.put(&Put::New("crate".to_owned()), at(0.6, 0.0)).unwrap();
    room.put(&Put::New("crate".to_owned()), at(-1.0, -1.0)).unwrap();
    assert_eq!(room.movers().count(), 3);
    assert_eq!(middle(&room.outline(2)), [600, 0]);
    let mut copy = room.keyframe().unwrap();
    for each in [&mut room, &mut copy] {
        each.advance_to(Instant::from_nanos(1_000_000_000));
    }
    let heard = |room: &Simulation| room.snapshot().sonar.and_then(|sonar| sonar.distance);
    assert!(heard(&room).is_some_and(|distance| distance < 0.5), "{:?}", heard(&room));
    assert_eq!(heard(&room), heard(&copy));
    assert_eq!(middle(&copy.outline(3)), [-1000, -1000]);
    let refused = room.put(&Put::New("piano".to_owned()), at(3.0, 3.0));
    assert_eq!(refused, Err(RequestError::NoShape("piano".to_owned())));
}
