//! Drives the manoeuvres of a file and prints the positions of robot and box every 20 ms, one JSON
//! object a line: `cargo run --package afp-sim --example manoeuvres --
//! tests/python/manoeuvres.json`. `tests/python/compare_engine.py` drives the same manoeuvres with
//! another engine.

use afp_carbot::devices::Navigator;
use afp_core::quantity::{AngularSpeed, Speed};
use afp_core::{Duration, Instant};
use afp_sim::{Fault, Simulation, World};
use serde::Deserialize;
use std::error::Error;

/// The time between two commands.
const TICK: Duration = Duration::from_millis(10);

#[derive(Deserialize)]
struct Manoeuvre {
    name: String,
    /// Commanded speed and turn rate, with their duration: seconds, metres and radians a second.
    drive: Vec<(f64, f64, f64)>,
    /// Share of the grip that remains, from a time in seconds.
    slip: Option<(f64, f64)>,
    #[serde(rename = "box")]
    thing: Option<Thing>,
}

/// A box that can be pushed; metres, degrees, kilograms.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Thing {
    pose_m_deg: [f64; 3],
    size_m: [f64; 2],
    mass_kg: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).ok_or("give the file of the manoeuvres")?;
    let manoeuvres: Vec<Manoeuvre> = serde_json::from_str(&std::fs::read_to_string(file)?)?;
    for manoeuvre in &manoeuvres {
        drive(manoeuvre)?;
    }
    Ok(())
}

fn drive(manoeuvre: &Manoeuvre) -> Result<(), Box<dyn Error>> {
    let mut sim = Simulation::new(&world(manoeuvre)?, 1)?;
    if let Some((from, grip)) = manoeuvre.slip {
        sim.inject(Fault::WheelsSlip { share: grip }, at(from), Duration::MAX);
    }
    let mut end = 0.0;
    let mut ticks = 0_u32;
    print(&manoeuvre.name, &sim);
    for (seconds, speed, turn) in &manoeuvre.drive {
        end += seconds;
        while sim.now() < at(end) {
            let now = sim.now();
            sim.drive(Speed::from_si(*speed), AngularSpeed::from_si(*turn), now);
            sim.advance_to(now + TICK);
            ticks += 1;
            if ticks.is_multiple_of(2) {
                print(&manoeuvre.name, &sim);
            }
        }
    }
    Ok(())
}

/// The robot at the origin, looking along x, and the box if there is one.
fn world(manoeuvre: &Manoeuvre) -> Result<World, Box<dyn Error>> {
    let mut text = "version = 1\n[robot]\npose_m_deg = [0.0, 0.0, 0.0]\n".to_owned();
    if let Some(Thing { pose_m_deg, size_m, mass_kg }) = &manoeuvre.thing {
        text += &format!(
            "[[box]]\npose_m_deg = {pose_m_deg:?}\nsize_m = {size_m:?}\nmass_kg = {mass_kg:?}\nheight_m = 0.3\n"
        );
    }
    Ok(World::parse(&text)?)
}

fn at(seconds: f64) -> Instant {
    Instant::ZERO + Duration::from_millis((seconds * 1000.0).round() as u64)
}

fn print(name: &str, sim: &Simulation) {
    let (time, pose) = (sim.now().as_secs_f64(), sim.truth().pose());
    let robot = [pose.x, pose.y, pose.heading];
    let line =
        serde_json::json!({ "name": name, "t": time, "robot": robot, "box": sim.outline(0) });
    println!("{line}");
}
