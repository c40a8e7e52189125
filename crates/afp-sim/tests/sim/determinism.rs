//! The same world, seed and commands give the same run, bit for bit.

use crate::drive;
use afp_carbot::devices::Rotator;
use afp_core::quantity::Angle;
use afp_sim::{Simulation, World};

/// The script's hash with the pinned version of the engine, on every platform and at every level of
/// optimisation. Only a new engine, model or room may change it.
const GOLDEN: u64 = 0x35ae60ab2d4e57af;

/// Adds a number's bits to a hash (FNV-1a).
fn mix(hash: &mut u64, value: f64) {
    for byte in value.to_bits().to_le_bytes() {
        *hash = (*hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3);
    }
}

/// Drives a fixed script of curves, turns and bumps, and hashes the observable states.
fn script(seed: u64) -> u64 {
    let room = include_str!("../../../../worlds/wall_following.toml");
    let world = World::parse(room).expect("the room is well-formed");
    let mut sim = Simulation::new(&world, seed).expect("the room can be built");
    let mut hash = 0xcbf2_9ce4_8422_2325;
    for round in 0..60 {
        let turn = f64::from(round % 7 - 3) * 0.2;
        sim.point(Angle::from_si(turn), sim.now());
        drive(&mut sim, 0.25, turn, 500);
        let seen = sim.snapshot();
        for value in [seen.pose.x, seen.pose.y, seen.pose.heading, seen.odometry.x.si()] {
            mix(&mut hash, value);
        }
        let distance = seen.sonar.and_then(|sonar| sonar.distance);
        mix(&mut hash, distance.unwrap_or(-1.0));
    }
    assert!(!sim.truth().collisions().is_empty(), "the script shall bump into something");
    hash
}

#[test]
fn the_same_seed_gives_the_same_run() {
    assert_eq!(script(11), script(11));
    assert_ne!(script(11), script(12));
}

#[test]
fn the_run_equals_the_recorded_run() {
    assert_eq!(script(11), GOLDEN, "{:#018x}", script(11));
}

#[test]
fn a_simulation_may_run_on_any_thread() {
    fn any_thread<T: Send + Sync>() {}
    any_thread::<Simulation>();
    any_thread::<World>();
}
