//! A large world with many walls and moving things, compared with real time.

use std::fmt::Write;
use std::hint::black_box;

use afp_carbot::devices::{Navigator, Ultrasonic};
use afp_core::quantity::{AngularSpeed, Speed};
use afp_core::{Duration, Instant};
use afp_sim::{Simulation, World};

use crate::measure::Race;
use crate::report::{Report, Row};

/// The rows of the grid of walls; one wall of this number has a moving object next to it.
const ROWS: usize = 40;
const COLUMNS: usize = 50;
const WALLS_A_MOVER: usize = ROWS * COLUMNS / 50;
/// The simulated seconds of one operation.
const SECONDS: u64 = 5;
/// The smallest speed of the simulator as a multiple of real time.
const OF_REAL_TIME: f64 = 50.0;

/// Measures a robot that drives in circles among 2,000 walls and 50 moving things.
pub(super) fn run(rounds: u32, report: &mut Report) {
    let world = World::parse(&text()).unwrap_or_else(|why| panic!("{why:?}"));
    let mut sim = Simulation::new(&world, 1).unwrap_or_else(|why| panic!("{why:?}"));
    let mut race = Race::default();
    race.add("2000 walls, 50 movers", |count| (0..count).for_each(|_| circle(&mut sim)));
    for case in race.run(rounds.div_ceil(100)) {
        let speed = SECONDS as f64 * 1e9 / case.median;
        let row = Row::new(format!("simulated second/{}, speed", case.name), speed, "x");
        let row = row.against("real time", speed);
        report.add(row.limit(format!(">= {OF_REAL_TIME}"), speed >= OF_REAL_TIME));
    }
}

/// Drives for some seconds.
fn circle(sim: &mut Simulation) {
    let end = sim.now() + Duration::from_secs(SECONDS);
    while sim.now() < end {
        let now: Instant = sim.now();
        sim.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.5), now);
        sim.advance_to(now + Duration::from_millis(10));
        black_box(sim.echo());
    }
}

/// Short walls on a grid of two metres, with the robot in the middle.
fn text() -> String {
    let mut text = "version = 1\n[robot]\npose_m_deg = [1.0, 1.0, 0.0]\n".to_owned();
    for n in 0..ROWS * COLUMNS {
        let x = (n % COLUMNS) as f64 * 2.0 - COLUMNS as f64;
        let y = (n / COLUMNS) as f64 * 2.0 - ROWS as f64;
        // Writing to a String cannot fail.
        let _ = writeln!(text, "[[wall]]\npoints_m = [[{x}, {y}], [{}, {y}]]", x + 0.8);
        if n % WALLS_A_MOVER == 0 {
            let _ = writeln!(
                text,
                "[[box]]\npose_m_deg = [{}, {}, 0]\nsize_m = [0.3, 0.3]\nheight_m = 1.7\n\
                 path = {{ by_m = [[0.5, 0.5]], speed_m_s = 0.4 }}",
                x + 0.3,
                y + 0.5
            );
        }
    }
    text
}
