//! Robots that follow commands or not, and commands after a halt.

use super::*;
use crate::devices::Odometry;
use crate::fake::Fake;
use crate::objects::Appearance;
use crate::objects::Path;
use afp_core::quantity::{Angle, Length};
use afp_core::{Actor, ActorTemplate};

/// Repeats a command for some seconds; the fault's time is in milliseconds.
fn drive(robot: &mut Fake, command: (f64, f64), seconds: u64) -> Result<(), (u64, Fault)> {
    let mut tracking = Tracking::new(robot.now);
    for _ in 0..seconds * 100 {
        robot.tick();
        let (now, motion) = (robot.now, robot.motion().value.expect("it is alive"));
        tracking.drive(robot, &motion, command, now).map_err(|fault| (robot.millis(), fault))?;
    }
    Ok(())
}

#[test]
fn a_robot_that_moves_as_commanded_continues() {
    for command in [(0.3, 0.0), (-0.05, 0.0), (0.0, 1.5), (0.2, -0.7), (0.01, 0.0)] {
        assert_eq!(drive(&mut Fake::new(&[]), command, 5), Ok(()), "{command:?}");
    }
}

#[test]
fn stopped_wheels_are_noticed_within_half_a_second() {
    for command in [(0.3, 0.0), (-0.05, 0.0), (0.0, 1.5), (0.01, 0.0)] {
        let mut robot = Fake::new(&[]);
        robot.follows = (0.0, 0.0);
        let (millis, fault) = drive(&mut robot, command, 5).expect_err("it stands");
        assert_eq!(fault, DRIVE_BLOCKED);
        assert!(millis < 650, "{command:?}: {millis}");
    }
}

#[test]
fn the_platform_receives_only_obstacles_ahead() {
    for (command, told) in [((0.3, 0.0), 1), ((0.2, 0.5), 1), ((-0.05, 0.0), 0), ((0.0, 1.5), 0)] {
        let mut robot = Fake::new(&[]);
        robot.follows = (0.0, 0.0);
        assert!(drive(&mut robot, command, 5).is_err());
        assert_eq!(robot.blocked, told, "{command:?}");
    }
}

#[test]
fn a_robot_that_turns_instead_of_driving_is_noticed() {
    let mut robot = Fake::new(&[]);
    robot.follows = (0.5, 1.0);
    robot.drifts = 0.5;
    let (millis, fault) = drive(&mut robot, (0.2, 0.0), 5).expect_err("it turns");
    assert_eq!(fault, DRIVE_STALLED);
    assert!(millis < 650, "{millis}");
}

#[test]
fn slipping_wheels_are_noticed_and_a_weak_drive_continues() {
    let command = (0.0, 0.8);
    let mut robot = Fake::new(&[]);
    let mut tracking = Tracking::new(robot.now);
    let fault = (0..200).find_map(|tick| {
        // 200 ms held, 60 ms free: shorter than the tolerated time.
        robot.follows = if tick % 26 < 20 { (0.0, 0.0) } else { (1.0, 1.0) };
        robot.tick();
        let (now, motion) = (robot.now, robot.motion().value.expect("it is alive"));
        tracking.drive(&mut robot, &motion, command, now).err()
    });
    assert!(fault.is_some() && robot.millis() < 1000, "{fault:?} {}", robot.millis());
    let mut robot = Fake::new(&[]);
    robot.follows = (0.8, 0.8);
    assert_eq!(drive(&mut robot, command, 5), Ok(()));
}

#[test]
fn an_odometry_that_repeats_itself_is_noticed_after_ten_centimetres() {
    let mut robot = Fake::new(&[]);
    assert_eq!(drive(&mut robot, (0.2, 0.0), 1), Ok(()));
    let (mut tracking, frozen) = (Tracking::new(robot.now), robot.motion);
    let mut driven = 0.0;
    let fault = loop {
        robot.tick();
        driven += 0.002;
        let now = robot.now;
        if let Err(fault) = tracking.drive(&mut robot, &frozen, (0.2, 0.0), now) {
            break fault;
        }
    };
    assert_eq!(fault, NO_PROGRESS);
    assert!(driven < 0.12, "{driven}");
}

/// Runs an actor through a gap in the odometry; returns the largest increase of its commanded speed
/// and turn rate per tick.
fn gains<'a, T: ActorTemplate, A: Actor<T, Fake>>(
    inputs: T::Inputs<'_>,
    live: impl Fn() -> T::Live<'a>,
) -> (f64, f64) {
    let mut robot = Fake::new(&[]);
    (robot.light, robot.odometry_gap) = (Some((4.0, 0.0)), (1500, 1850));
    let _ = robot.run::<T, A>(inputs, live, 4);
    assert!(robot.millis() >= 1990 && robot.motion != Motion::default());
    robot.gains
}

#[test]
fn driving_after_a_gap_in_the_odometry_begins_from_a_standstill() {
    use crate::templates as t;
    let (distance, speed, tolerance) =
        (Length::from_si(5.0), Speed::from_si(0.3), Length::from_si(0.1));
    let (angle, radius) = (Angle::from_deg(360.0), Length::from_si(1.0));
    let path = Path::new([[0.0, 0.0], [5.0, 0.0]]).unwrap();
    let zero = Length::from_si(0.0);
    let go = [
        gains::<t::Forward, crate::Forward>(t::forward::Inputs { distance, speed }, || {
            t::forward::Live {}
        }),
        gains::<t::Retrace, crate::Retrace>(t::retrace::Inputs { distance, speed }, || {
            t::retrace::Live {}
        }),
        gains::<t::Curve, crate::Curve>(t::curve::Inputs { radius, angle, speed }, || {
            t::curve::Live {}
        }),
        gains::<t::FollowPath, crate::FollowPath>(
            t::follow_path::Inputs { speed, tolerance },
            || t::follow_path::Live { path: &path },
        ),
        gains::<t::ApproachInfrared, crate::ApproachInfrared>(
            t::approach_infrared::Inputs { strength: 4.0, speed },
            || t::approach_infrared::Live {},
        ),
    ];
    assert!(go.iter().all(|gain| gain.0 < ACCELERATION * 0.0101), "{go:?}");
    let speed = AngularSpeed::from_si(1.5);
    let heading = Angle::from_deg(179.0);
    let turn = [
        gains::<t::Turn, crate::Turn>(t::turn::Inputs { angle, speed }, || t::turn::Live {}),
        gains::<t::DriveTo, crate::DriveTo>(
            t::drive_to::Inputs {
                x: zero,
                y: zero,
                heading,
                speed: Speed::from_si(0.3),
                tolerance,
            },
            || t::drive_to::Live {},
        ),
        gains::<t::FindObject, crate::FindObject>(
            t::find_object::Inputs {
                look: &Appearance::default(),
                tolerance: Angle::from_deg(5.0),
                speed,
            },
            || t::find_object::Live {},
        ),
    ];
    assert!(turn.iter().all(|gain| gain.1 < TURN_ACCELERATION * 0.0101), "{turn:?}");
}

#[test]
fn the_expected_motion_stays_within_the_limits_of_the_robot() {
    let mut robot = Fake::new(&[]);
    robot.top_speed = 0.1;
    assert_eq!(drive(&mut robot, (0.4, 0.0), 5), Ok(()));
}
