//! Wall following along plane walls, with a robot that moves exactly as commanded.

use super::*;
use crate::fake::{Fake, Plane, plane};
use crate::helpers::guard::NO_RANGE;
use crate::helpers::guard::STUCK_ROTATOR;
use afp_core::quantity::{Length, Speed};

fn inputs(step: f64) -> Inputs {
    Inputs {
        walldist: Length::from_si(0.3),
        lanedist: Length::from_si(0.3),
        gain: 1.0,
        tolerance: Length::from_si(0.2),
        absent: Length::from_si(0.15),
        step: Length::from_si(step),
        speed: Speed::from_si(0.2),
    }
}

fn follow(robot: &mut Fake, step: f64) -> Result<Option<State>, Fault> {
    robot.run::<templates::WallForward, WallForward>(inputs(step), || Live {}, 60)
}

/// A wall on the right, `distance` from the robot's centre.
fn beside(distance: f64) -> Plane {
    plane(-90.0, distance)
}

#[test]
fn it_reaches_the_distance_from_both_sides_and_ends_after_the_step() {
    for start in [0.475 + 0.18, 0.475, 0.475 - 0.1] {
        let mut robot = Fake::new(&[beside(start)]);
        assert_eq!(follow(&mut robot, 2.0), Ok(Some(State::ForwardSuccessful)));
        let gap = start + robot.motion.y.si() - 0.175;
        assert!((gap - 0.3).abs() < 0.01, "from {start}: {gap}");
        assert!(robot.motion.heading.si().abs() < 0.03, "{:?}", robot.motion);
    }
}

#[test]
fn it_follows_a_wall_that_was_not_parallel() {
    let mut robot = Fake::new(&[plane(-90.0 + 6.0, 0.475)]);
    assert_eq!(follow(&mut robot, 3.0), Ok(Some(State::ForwardSuccessful)));
    assert!((robot.motion.heading.si().to_degrees() - 6.0).abs() < 1.5, "{:?}", robot.motion);
}

#[test]
fn it_stops_at_the_lane_distance_before_a_wall_ahead() {
    let mut robot = Fake::new(&[beside(0.475), plane(0.0, 2.0)]);
    assert_eq!(follow(&mut robot, 5.0), Ok(Some(State::LaneNotFree)));
    let front = 2.0 - robot.motion.x.si() - 0.2;
    assert!((0.28..0.36).contains(&front), "{front}");
}

#[test]
fn it_waits_for_a_missing_wall_for_the_given_time() {
    for absent in [0.15, 0.25] {
        let mut robot = Fake::new(&[]);
        let inputs = Inputs { absent: Length::from_si(absent), ..inputs(2.0) };
        let state = robot.run::<templates::WallForward, WallForward>(inputs, || Live {}, 60);
        assert_eq!(state, Ok(Some(State::WallLost)));
        let driven = robot.motion.x.si();
        assert!((absent..absent + 0.06).contains(&driven), "{absent}: {driven}");
    }
}

#[test]
fn lost_pings_do_not_open_the_lane() {
    // The robot sees the wall ahead in time, even if any two consecutive pings are lost.
    for from in (0..9000).step_by(50) {
        let mut robot = Fake::new(&[beside(0.475), plane(0.0, 1.5)]);
        robot.lost_pings = (from, 2);
        assert_eq!(follow(&mut robot, 5.0), Ok(Some(State::LaneNotFree)), "from {from}");
        let front = 1.5 - robot.motion.x.si() - 0.2;
        assert!(front > 0.24, "lost from {from}: {front}");
    }
}

#[test]
fn a_lane_of_any_valid_length_is_driven_while_it_is_free() {
    for lanedist in [0.05, 0.3, 0.9, 1.2, 2.0] {
        let inputs = |speed| Inputs {
            lanedist: Length::from_si(lanedist),
            speed: Speed::from_si(speed),
            ..inputs(2.0)
        };
        for speed in [0.01, 0.2, 0.31] {
            let mut robot = Fake::new(&[beside(0.475)]);
            let state =
                robot.run::<templates::WallForward, WallForward>(inputs(speed), || Live {}, 210);
            assert_eq!(state, Ok(Some(State::ForwardSuccessful)), "{lanedist} m at {speed} m/s");
        }
        let mut robot = Fake::new(&[beside(0.475), plane(0.0, 3.5)]);
        let inputs = Inputs { step: Length::from_si(5.0), ..inputs(0.2) };
        let state = robot.run::<templates::WallForward, WallForward>(inputs, || Live {}, 60);
        assert_eq!(state, Ok(Some(State::LaneNotFree)), "{lanedist} m");
        let front = 3.5 - robot.motion.x.si() - 0.2;
        assert!((lanedist - 0.03..lanedist + 0.12).contains(&front), "{lanedist} m: {front}");
    }
}

#[test]
fn it_does_not_drive_into_an_obstacle_at_the_start() {
    let mut robot = Fake::new(&[beside(0.475), plane(0.0, 0.45)]);
    assert_eq!(follow(&mut robot, 5.0), Ok(Some(State::LaneNotFree)));
    assert_eq!(robot.motion.x.si(), 0.0);
}

#[test]
fn the_wall_is_lost_a_third_of_a_metre_after_its_end() {
    let mut robot = Fake::new(&[Plane { end: 1.0, ..beside(0.475) }]);
    assert_eq!(follow(&mut robot, 5.0), Ok(Some(State::WallLost)));
    // The sensor is 10 cm before the centre.
    assert!(
        (0.9 + LOST - 0.02..0.9 + LOST + 0.1).contains(&robot.motion.x.si()),
        "{:?}",
        robot.motion
    );
    assert!(robot.motion.heading.si().abs() < 0.05);
}

#[test]
fn a_wall_that_steps_back_is_also_lost() {
    let near = Plane { end: 1.0, ..beside(0.475) };
    let mut robot = Fake::new(&[near, beside(1.175)]);
    assert_eq!(follow(&mut robot, 5.0), Ok(Some(State::WallLost)));
}

#[test]
fn it_does_not_wait_for_a_wall_that_never_existed() {
    let mut robot = Fake::new(&[beside(1.175)]);
    assert_eq!(follow(&mut robot, 5.0), Ok(Some(State::WallLost)));
    let way = robot.motion.x.si();
    assert!((0.13..0.25).contains(&way), "{way}");
}

#[test]
fn a_sensor_that_fails_while_driving_stops_the_robot_at_once_and_is_a_fault_later() {
    let mut robot = Fake::new(&[beside(0.475)]);
    robot.range_dies = 3000;
    assert_eq!(follow(&mut robot, 5.0), Err(NO_RANGE));
    let mut before = Fake::new(&[beside(0.475)]);
    let inputs = inputs(5.0);
    let run = before.run::<templates::WallForward, WallForward>(inputs, || Live {}, 3);
    assert_eq!(run, Ok(None));
    let way = robot.motion.x.si() - before.motion.x.si();
    assert!((0.0..0.05).contains(&way), "{way}");
}

#[test]
fn late_echoes_are_a_fault_and_end_driving_and_waiting() {
    let mut robot = Fake::new(&[beside(0.475), plane(0.0, 2.0)]);
    robot.late_echoes = 150;
    assert_eq!(follow(&mut robot, 5.0), Ok(Some(State::LaneNotFree)));
    let front = 2.0 - robot.motion.x.si() - 0.2;
    assert!(front > 0.24, "{front}");
    for late in [250, 400, 600] {
        let mut robot = Fake::new(&[beside(0.475), plane(0.0, 2.0)]);
        robot.late_echoes = late;
        assert_eq!(follow(&mut robot, 5.0), Err(NO_RANGE), "{late} ms late");
        assert_eq!(robot.motion.x.si(), 0.0, "{late} ms late");
        assert!(robot.millis() <= 600, "{late} ms late: a fault after {} ms", robot.millis());
    }
}

#[test]
fn dead_devices_are_faults() {
    let mut robot = Fake::new(&[beside(0.475)]);
    robot.range_dies = 0;
    assert_eq!(follow(&mut robot, 5.0), Err(NO_RANGE));
    assert_eq!(robot.motion.x.si(), 0.0, "drove without having seen the lane");
    let mut robot = Fake::new(&[beside(0.475)]);
    robot.dead_odometry = true;
    assert_eq!(follow(&mut robot, 5.0), Err(NO_ODOMETRY));
    let mut robot = Fake::new(&[beside(0.475)]);
    robot.stuck_rotator = true;
    robot.rotator = -1.57;
    assert_eq!(follow(&mut robot, 5.0), Err(STUCK_ROTATOR));
}
