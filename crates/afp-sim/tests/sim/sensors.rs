//! The readings of the sensors.

use crate::{among, among_with, drive, the_box, wait};
use afp_carbot::devices::{
    Button, Buttons, Echo, Invalid, Odometry, RotatingTelemetry, Rotator, TouchSensor, Ultrasonic,
};
use afp_core::quantity::Angle;
use afp_sim::Simulation;

/// Points the sensor, waits for it, and returns the latest echo.
fn look(sim: &mut Simulation, degrees: f64) -> Echo {
    sim.point(Angle::from_deg(degrees), sim.now());
    wait(sim, 1000);
    sim.echo().value.expect("the sensor works")
}

/// Mean range of `count` pings, and the number of heard pings.
fn ranges(sim: &mut Simulation, degrees: f64, count: u32) -> (f64, u32) {
    look(sim, degrees);
    let (mut sum, mut heard) = (0.0, 0);
    for _ in 0..count {
        wait(sim, 50);
        if let Some(distance) = sim.echo().value.unwrap().distance {
            (sum, heard) = (sum + distance.si(), heard + 1);
        }
    }
    (sum / f64::from(heard.max(1)), heard)
}

/// A wall square ahead, its face one metre from the sensor.
fn wall_ahead() -> String {
    the_box([1.2, 0.0], [0.2, 6.0], 2.0)
}

#[test]
fn a_plane_wall_reads_its_perpendicular_distance_while_its_normal_is_in_the_beam() {
    let mut sim = among(&wall_ahead());
    for degrees in [0.0, 10.0, -12.0] {
        let (mean, heard) = ranges(&mut sim, degrees, 100);
        assert!((mean - 1.0).abs() < 0.015, "{degrees}: {mean}");
        assert!((80..=100).contains(&heard), "{degrees}: {heard}");
    }
}

#[test]
fn a_wall_next_to_the_beam_reads_farther_and_a_slanted_wall_is_silent() {
    let mut sim = among(&wall_ahead());
    let (mean, _) = ranges(&mut sim, 30.0, 100);
    assert!((1.0..1.08).contains(&mean), "{mean}");
    assert_eq!(ranges(&mut sim, 60.0, 50).1, 0, "a mirror sends sound back");
}

#[test]
fn ranges_are_noisy_and_some_pings_are_lost() {
    let mut sim = among(&wall_ahead());
    look(&mut sim, 0.0);
    let mut seen: Vec<Option<i64>> = Vec::new();
    for _ in 0..400 {
        wait(&mut sim, 50);
        let distance = sim.echo().value.unwrap().distance;
        seen.push(distance.map(|distance| (distance.si() * 1000.0).round() as i64));
    }
    let lost = seen.iter().filter(|range| range.is_none()).count();
    assert!((1..20).contains(&lost), "{lost} of 400 lost");
    seen.sort_unstable();
    seen.dedup();
    assert!(seen.len() > 5, "{seen:?}");
}

#[test]
fn nothing_within_range_is_silence_and_not_an_error() {
    let mut sim = among("");
    assert_eq!(look(&mut sim, 0.0).distance, None);
}

#[test]
fn an_echo_arrives_when_the_sound_does() {
    let mut sim = among(&wall_ahead());
    assert_eq!(sim.echo().value, Err(Invalid::NotYet));
    // The first ping is sent at 50 ms; one metre and back takes 5.8 ms.
    wait(&mut sim, 55);
    assert_eq!(sim.echo().value, Err(Invalid::NotYet));
    wait(&mut sim, 1);
    assert!(sim.echo().value.is_ok());
    assert_eq!(sim.echo().time, crate::at(50));
}

#[test]
fn the_rotator_has_a_rate_and_a_limit() {
    let mut sim = among("");
    sim.point(Angle::from_deg(90.0), sim.now());
    wait(&mut sim, 200);
    let there = sim.bearing().value.unwrap().si().to_degrees();
    assert!((there - 60.0).abs() < 2.0, "{there}");
    assert!((look(&mut sim, 400.0).bearing.si().to_degrees() - 130.0).abs() < 0.5);
    sim.point(Angle::from_si(f64::NAN), sim.now());
    wait(&mut sim, 1000);
    assert!((sim.bearing().value.unwrap().si().to_degrees() - 130.0).abs() < 0.5);
}

#[test]
fn the_beam_passes_above_a_low_step_and_the_bumper_finds_it() {
    let low = the_box([1.0, 0.0], [0.3, 0.3], 0.08);
    let mut sim = among(&low);
    assert_eq!(ranges(&mut sim, 0.0, 50).1, 0);
    assert_eq!(sim.truth().right_side_gap(), None, "a low step is no wall");
    drive(&mut sim, 0.2, 0.0, 4000);
    assert_eq!(sim.touched().value, Ok(true));
    let high = the_box([1.0, 0.0], [0.3, 0.3], 0.3);
    assert!(ranges(&mut among(&high), 0.0, 50).1 > 40);
}

#[test]
fn the_escape_button_is_pressed_while_it_is_held() {
    let mut sim = among("");
    let pressed = |sim: &Simulation| sim.pressed(Button::Escape).value;
    assert_eq!(pressed(&sim), Ok(false));
    sim.press_escape();
    assert_eq!(pressed(&sim), Ok(true));
    sim.release_escape();
    assert_eq!(pressed(&sim), Ok(false));
}

#[test]
fn the_judge_measures_from_the_right_side() {
    let sim = among(&the_box([0.0, -0.6], [4.0, 0.2], 2.0));
    let gap = sim.truth().right_side_gap().unwrap();
    assert!((gap - (0.5 - 0.175)).abs() < 1e-6, "{gap}");
}

#[test]
fn a_wall_behind_the_robot_is_not_beside_it() {
    // The position of the wall's end ahead of the robot's middle.
    for (end, beside) in [(0.5, true), (0.0, true), (-0.19, true), (-0.21, false), (-0.5, false)] {
        let truth = |x: f64| among(&the_box([x, -0.6], [4.0, 0.2], 2.0));
        let sim = truth(end - 2.0);
        assert_eq!(sim.truth().right_side_wall().is_some(), beside, "{end}");
        assert!(sim.truth().right_side_gap().is_some());
    }
    assert_eq!(among("").truth().right_side_wall(), None);
}

/// The odometry of a robot against a wall that it pushes: the true way, and the counted way.
fn pushed(encoders: bool, seed: u64) -> (f64, f64) {
    let wall = "[[wall]]\npoints_m = [[1.0, -1.0], [1.0, 1.0]]\n";
    let mut sim = among_with(&format!("encoders = {encoders}\n{wall}"), seed);
    drive(&mut sim, 0.2, 0.0, 8000);
    (sim.truth().pose().x, sim.motion().value.unwrap().x.si())
}

#[test]
fn a_robot_without_encoders_counts_on_while_a_wall_blocks_it() {
    let (way, counted) = pushed(true, 1);
    assert!((counted / way - 1.0).abs() < 0.05, "{way} {counted}");
    let all: Vec<_> = (0..20).map(|seed| pushed(false, seed)).collect();
    assert!(all.iter().all(|(way, counted)| *way < 1.0 && *counted > 1.2), "{all:?}");
    // No two robots drive equally fast with the same power.
    let counts = all.iter().map(|(_, counted)| counted / 1.6);
    let spread = (counts.map(|it| (it - 1.0).powi(2)).sum::<f64>() / 20.0).sqrt();
    assert!((0.04..0.15).contains(&spread), "{spread}");
}
