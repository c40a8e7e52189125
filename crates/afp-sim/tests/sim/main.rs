//! The guarantees of the simulated world and robot for templates and judges.

mod closed_forms;
mod determinism;
mod faults;
mod late;
mod locating;
mod map;
mod moving;
mod objects;
mod random;
mod ranges;
mod schema;
mod seeing;
mod sensors;
mod storms;
mod vehicle;
mod wanderer;
mod world;

use afp_carbot::devices::Navigator;
use afp_core::quantity::{AngularSpeed, Speed};
use afp_core::{Duration, Instant};
use afp_sim::{Simulation, World};

/// A simulation of a robot at the origin, looking along the x axis, among `obstacles` (TOML).
fn among(obstacles: &str) -> Simulation {
    among_with(obstacles, 1)
}

/// Like [`among`], with another seed.
fn among_with(obstacles: &str, seed: u64) -> Simulation {
    let text = format!("version = 1\n[robot]\npose_m_deg = [0.0, 0.0, 0.0]\n{obstacles}");
    let world = World::parse(&text).expect("the test's world is well-formed");
    Simulation::new(&world, seed).expect("the test's world can be built")
}

fn the_box(middle: [f64; 2], size: [f64; 2], height: f64) -> String {
    format!(
        "[[box]]\npose_m_deg = [{}, {}, 0.0]\nsize_m = {size:?}\nheight_m = {height}\n",
        middle[0], middle[1]
    )
}

fn wait(sim: &mut Simulation, millis: u64) {
    sim.advance_to(sim.now() + Duration::from_millis(millis));
}

/// Repeats a command every 10 ms for a time.
fn drive(sim: &mut Simulation, speed: f64, turn: f64, millis: u64) {
    for _ in 0..millis / 10 {
        let now = sim.now();
        sim.drive(Speed::from_si(speed), AngularSpeed::from_si(turn), now);
        sim.advance_to(now + Duration::from_millis(10));
    }
}

fn at(millis: u64) -> Instant {
    Instant::ZERO + Duration::from_millis(millis)
}
