//! Drives through a random room and saves the camera's pictures as a film strip: `cargo run
//! --package afp-sim --example film -- SEED FILE.png`.

use afp_carbot::devices::{Camera, Navigator, Ultrasonic};
use afp_core::Duration;
use afp_core::quantity::{AngularSpeed, Speed};
use afp_sim::{Film, Simulation, World};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (Some(seed), Some(file)) = (arguments.next(), arguments.next()) else {
        return Err("give a seed and the name of the picture".into());
    };
    let mut sim = Simulation::new(&World::random(seed.parse()?), 0)?;
    let mut film = Film::default();
    for tick in 0..2400 {
        let now = sim.now();
        let near = sim
            .echo()
            .value
            .is_ok_and(|echo| echo.distance.is_some_and(|distance| distance.si() < 0.7));
        let (speed, turn) = if near { (0.0, 0.6) } else { (0.25, 0.1) };
        sim.drive(Speed::from_si(speed), AngularSpeed::from_si(turn), now);
        sim.advance_to(now + Duration::from_millis(10));
        if tick % 100 == 99
            && let Ok(frame) = sim.frame().value
        {
            film.add(&frame);
        }
    }
    std::fs::write(file, film.png(6)?)?;
    Ok(())
}
