//! The robot's motion.

use crate::{among, drive, the_box, wait};
use afp_carbot::devices::{Navigator, Odometry, TouchSensor};
use afp_core::quantity::{AngularSpeed, Speed};
use afp_core::{Duration, Environment};
use afp_sim::Simulation;

fn speed(sim: &mut Simulation) -> f64 {
    let before = sim.truth().pose();
    wait(sim, 5);
    let after = sim.truth().pose();
    (after.x - before.x).hypot(after.y - before.y) / 0.005
}

#[test]
fn top_speed_is_31_centimetres_a_second_for_every_command() {
    let mut sim = among("");
    drive(&mut sim, 5.0, 0.0, 2000);
    let speed = speed(&mut sim);
    assert!((0.29..=0.3105).contains(&speed), "{speed}");
}

#[test]
fn turns_in_place() {
    let mut sim = among("");
    drive(&mut sim, 0.0, 0.785, 2000);
    let pose = sim.truth().pose();
    assert!((pose.heading.to_degrees() - 85.0).abs() < 6.0, "{pose:?}");
    assert!(pose.x.hypot(pose.y) < 0.03, "{pose:?}");
}

#[test]
fn drives_a_curve_like_a_car() {
    let mut sim = among("");
    // A quarter of a circle of half a metre.
    drive(&mut sim, 0.2, 0.4, 3927);
    let pose = sim.truth().pose();
    assert!((pose.x - 0.5).abs() < 0.05 && (pose.y - 0.5).abs() < 0.05, "{pose:?}");
    assert!((pose.heading.to_degrees() - 90.0).abs() < 6.0, "{pose:?}");
}

#[test]
fn stops_within_five_centimetres_and_300_ms_from_top_speed() {
    let mut sim = among("");
    drive(&mut sim, 0.31, 0.0, 2000);
    let before = sim.truth().pose().x;
    let now = sim.now();
    sim.stop(now);
    wait(&mut sim, 300);
    assert!(speed(&mut sim) < 0.01);
    let way = sim.truth().pose().x - before;
    assert!((0.01..0.05).contains(&way), "{way}");
}

#[test]
fn it_stops_within_300_ms_from_any_curve_and_turn() {
    for (ahead, turn) in [
        (0.31, 1.8),
        (0.31, -1.8),
        (-0.31, 1.8),
        (0.31, 0.5),
        (0.1, 1.8),
        (0.0, 1.8),
        (0.0, -100.0),
        (100.0, 100.0),
    ] {
        // Even while the wheels still steer.
        for millis in [100, 200, 300, 2000] {
            let mut sim = among("");
            drive(&mut sim, ahead, turn, millis);
            sim.stop(sim.now());
            wait(&mut sim, 300);
            let before = sim.truth().pose().heading;
            let speed = speed(&mut sim);
            let turns = (sim.truth().pose().heading - before).abs() / 0.005;
            let what = format!("{ahead} m/s, {turn} rad/s for {millis} ms");
            assert!(speed < 0.006 && turns < 0.026, "{what}: {speed} m/s, {turns} rad/s");
        }
    }
}

#[test]
fn a_curve_that_is_too_fast_is_driven_slower_with_the_same_radius() {
    let mut sim = among("");
    drive(&mut sim, 0.31, 0.62, 1000);
    let (mut length, mut angle) = (0.0, 0.0);
    for _ in 0..200 {
        let before = sim.truth().pose();
        drive(&mut sim, 0.31, 0.62, 10);
        let after = sim.truth().pose();
        length += (after.x - before.x).hypot(after.y - before.y);
        angle += after.heading - before.heading;
    }
    assert!((length / angle - 0.5).abs() < 0.01, "{length} m in {angle} rad");
    assert!(length < 0.5, "the outer wheel is faster than it can be: {length} m in 2 s");
}

#[test]
fn an_emergency_stop_is_shorter_than_a_stop() {
    let way = |stop: fn(&mut Simulation)| {
        let mut sim = among("");
        drive(&mut sim, 0.31, 0.0, 2000);
        let before = sim.truth().pose().x;
        stop(&mut sim);
        wait(&mut sim, 500);
        sim.truth().pose().x - before
    };
    let stop = way(|sim| sim.stop(sim.now()));
    let emergency = way(Simulation::emergency_stop);
    assert!(emergency < stop && emergency > 0.0, "{emergency} against {stop}");
}

#[test]
fn the_controller_stops_by_itself_200_ms_after_the_last_command() {
    let mut sim = among("");
    drive(&mut sim, 0.2, 0.0, 1000);
    // The last command was given 10 ms ago.
    wait(&mut sim, 185);
    assert!(speed(&mut sim) > 0.19, "stopped too early");
    wait(&mut sim, 400);
    assert!(speed(&mut sim) < 0.005, "still drives");
}

#[test]
fn a_command_that_is_not_a_number_is_a_stop() {
    let mut sim = among("");
    drive(&mut sim, 0.2, 0.0, 1000);
    drive(&mut sim, f64::NAN, 0.0, 500);
    assert!(speed(&mut sim) < 0.005);
    drive(&mut sim, 0.2, f64::INFINITY, 500);
    assert!(speed(&mut sim) < 0.005);
}

#[test]
fn odometry_drifts_but_not_far() {
    let mut sim = among("");
    drive(&mut sim, 0.2, 0.0, 10_000);
    drive(&mut sim, 0.0, 0.0, 300);
    let believed = sim.motion().value.unwrap();
    let error = (believed.x.si() - sim.truth().pose().x).abs();
    assert!(error > 1e-4, "the odometry is perfect");
    assert!(error < 0.1, "{error}");
    assert!(believed.stands());
}

#[test]
fn a_wall_holds_the_robot_and_presses_the_bumper() {
    let mut sim = among(&the_box([1.0, 0.0], [0.2, 2.0], 2.0));
    drive(&mut sim, 0.2, 0.0, 2000);
    assert_eq!(sim.touched().value, Ok(false));
    drive(&mut sim, 0.2, 0.0, 3000);
    assert_eq!(sim.touched().value, Ok(true));
    let pose = sim.truth().pose();
    assert!((pose.x - 0.7).abs() < 0.005, "{pose:?}");
    let collisions = sim.truth().collisions();
    assert_eq!(collisions.len(), 1, "{collisions:?}");
    drive(&mut sim, -0.2, 0.0, 1000);
    assert_eq!(sim.touched().value, Ok(false));
    drive(&mut sim, 0.2, 0.0, 2000);
    assert_eq!(sim.truth().collisions().len(), 2, "a second bump counts");
}

#[test]
fn backing_into_something_does_not_press_the_bumper() {
    let mut sim = among(&the_box([-1.0, 0.0], [0.2, 2.0], 2.0));
    drive(&mut sim, -0.2, 0.0, 5000);
    assert_eq!(sim.truth().collisions().len(), 1);
    assert_eq!(sim.touched().value, Ok(false));
}

#[test]
fn time_in_many_pieces_equals_time_in_one_piece() {
    let mut whole = among("");
    let mut pieces = among("");
    for sim in [&mut whole, &mut pieces] {
        let now = sim.now();
        sim.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.3), now);
    }
    wait(&mut whole, 150);
    for _ in 0..150_000 / 7 {
        pieces.advance_to(pieces.now() + Duration::from_micros(7));
    }
    pieces.advance_to(whole.now());
    assert_eq!(whole.snapshot(), pieces.snapshot());
}
