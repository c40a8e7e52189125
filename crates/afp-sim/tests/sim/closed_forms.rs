//! The vehicle against closed-form results; docs/simulator.md has the numbers.

use crate::{among, drive, wait};
use afp_carbot::devices::Odometry;
use afp_core::{Duration, Environment};
use afp_sim::{Fault, Simulation};

/// Standard gravity times the share of the weight that the two driven wheels hold: half of the
/// weight is on them, with a friction of 0.7.
const GRIP: f64 = 0.7 * 9.81 / 2.0;
/// The braking of the castors: the other half with a rolling resistance of 0.02.
const ROLLING: f64 = 0.02 * 9.81 / 2.0;

/// The error of `is` against `expected`, as a share; printed for the numbers in docs/simulator.md.
fn off(what: &str, is: f64, expected: f64) -> f64 {
    let off = is / expected - 1.0;
    println!("{what}: {is:.4}, computed {expected:.4}, {:+.2} %", off * 100.0);
    off.abs()
}

/// The robot's distance and turn during a time, summed every 10 ms.
fn way(sim: &mut Simulation, speed: f64, turn: f64, millis: u64) -> (f64, f64) {
    let (mut length, mut angle) = (0.0, 0.0);
    let mut last = sim.truth().pose();
    for _ in 0..millis / 10 {
        drive(sim, speed, turn, 10);
        let here = sim.truth().pose();
        length += (here.x - last.x).hypot(here.y - last.y);
        let turned = here.heading - last.heading;
        angle += (turned + 3.0 * std::f64::consts::PI).rem_euclid(std::f64::consts::TAU)
            - std::f64::consts::PI;
        last = here;
    }
    (length, angle)
}

#[test]
fn at_low_speed_it_drives_the_circles_of_a_bicycle() {
    for (speed, turn) in
        [(0.1, 0.1), (0.1, 0.3), (0.2, 0.4), (0.18, -0.72), (-0.1, 0.3), (0.25, 0.25)]
    {
        let mut sim = among("");
        drive(&mut sim, speed, turn, 1000);
        let (length, angle) = way(&mut sim, speed, turn, 10_000);
        let what = format!("circle at {speed} m/s, {turn} rad/s");
        // If the wheels roll without slip, both determine the turning centre.
        let radius = off(&format!("{what}: radius"), length / angle.abs(), (speed / turn).abs());
        let rate = off(&format!("{what}: turn rate"), angle / 10.0, turn);
        assert!(radius < 0.001, "{what}");
        assert!(rate < 0.001, "{what}");
    }
}

#[test]
fn it_turns_in_place_at_the_commanded_rate() {
    for turn in [0.3_f64, 0.8, -1.5] {
        let mut sim = among("");
        drive(&mut sim, 0.0, turn, 1000);
        let before = sim.truth().pose();
        let (_, angle) = way(&mut sim, 0.0, turn, 10_000);
        let after = sim.truth().pose();
        let rate = off(&format!("turn in place at {turn} rad/s"), angle / 10.0, turn);
        let drift = (after.x - before.x).hypot(after.y - before.y);
        println!("drift of the centre in 10 s: {drift:.4} m");
        assert!(rate < 0.001);
        assert!(drift < 0.001, "{drift}");
    }
}

/// The robot's distance after a stop command.
fn stopping_distance(sim: &mut Simulation, speed: f64) -> (f64, f64) {
    drive(sim, speed, 0.0, 3000);
    let before = sim.truth().pose().x;
    drive(sim, speed, 0.0, 10);
    let real = (sim.truth().pose().x - before) / 0.01;
    let before = sim.truth().pose().x;
    sim.stop(sim.now());
    wait(sim, 3000);
    (real, sim.truth().pose().x - before)
}

#[test]
fn it_stops_by_lag_and_brakes() {
    for speed in [0.31, 0.2, 0.1] {
        let (real, way) = stopping_distance(&mut among(""), speed);
        // The motors brake with 2 m/s^2 down to 0.12 m/s, then with a time constant of 60 ms. In
        // steps of 5 ms, the error is up to the distance of one step.
        let knee = real.min(0.12);
        let computed = (real * real - knee * knee) / 4.0 + knee * 0.06;
        off(&format!("stopping from {speed} m/s"), way, computed);
        assert!((way - computed).abs() < real * 0.005);
    }
}

#[test]
fn on_a_slippery_floor_it_stops_by_friction() {
    for grip in [0.05, 0.1, 0.2] {
        let mut sim = among("");
        drive(&mut sim, 0.31, 0.0, 3000);
        sim.inject(Fault::WheelsSlip { share: grip }, sim.now(), Duration::MAX);
        let (real, way) = stopping_distance(&mut sim, 0.31);
        let computed = real * real / 2.0 / (GRIP * grip + ROLLING);
        assert!(off(&format!("stopping with {grip} of the grip"), way, computed) < 0.01);
    }
}

#[test]
fn friction_limits_the_speed_in_a_curve() {
    let mut sim = among("");
    drive(&mut sim, 0.3, 0.0, 2000);
    sim.inject(Fault::WheelsSlip { share: 0.005 }, sim.now(), Duration::MAX);
    let (length, angle) = way(&mut sim, 0.21, 0.63, 2000);
    // The curve needs 0.13 m/s^2; the floor gives 0.02 plus the castors' part.
    let (speed, radius) = (length / 2.0, length / angle.abs());
    let across = speed * speed / radius;
    println!("in a slippery curve: {across:.3} m/s^2 across of {:.3}", 0.005 * GRIP + ROLLING);
    assert!(across < 0.005 * GRIP + ROLLING && radius > 0.4, "{across} {radius}");
}

#[test]
fn the_odometer_drifts_by_the_difference_of_the_wheels() {
    let (mut squares, mut turns) = (0.0, 0.0);
    for seed in 0..40 {
        let mut sim = crate::among_with("", seed);
        drive(&mut sim, 0.2, 0.0, 10_000);
        let believed = sim.motion().value.expect("it counts");
        let error = believed.x.si() / sim.truth().pose().x - 1.0;
        squares += error * error / 40.0;
        drive(&mut sim, 0.0, 0.5, 10_000);
        let (believed, pose) = (sim.motion().value.expect("it counts"), sim.truth().pose());
        let truth = pose.heading + if pose.heading < 0.0 { std::f64::consts::TAU } else { 0.0 };
        turns += (believed.heading.si() / truth - 1.0).powi(2) / 40.0;
    }
    println!("odometry: way {:.4}, turn {:.4}", squares.sqrt(), turns.sqrt());
    assert!((0.003..0.015).contains(&squares.sqrt()), "{squares}");
    assert!((0.005..0.03).contains(&turns.sqrt()), "{turns}");
}
