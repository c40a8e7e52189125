//! The Carbot's own names for sensors.

use afp_carbot::devices::{
    Battery, Button, Buttons, Camera, ColorSensor, InfraredSensor, Invalid, Odometry, Reading,
    RotatingTelemetry, TouchSensor, Ultrasonic,
};
use afp_sim::Simulation;
use pyo3::prelude::*;

use crate::errors::error;
use crate::sensed::Sensed;

/// The names of the sensors.
pub const SENSORS: [&str; 9] =
    ["distance", "bearing", "odometry", "touched", "escape", "battery", "color", "glow", "camera"];

/// Reads a sensor. Without a measurement in its range it returns nothing; `None` means an unknown
/// name.
///
/// # Errors
/// The sensor is broken.
pub fn named(sim: &Simulation, name: &str) -> Option<PyResult<Sensed>> {
    Some(match name {
        "distance" => said(name, sim.echo(), |echo| {
            Sensed::Number(echo.distance.map_or(f64::INFINITY, |distance| distance.si()))
        }),
        "bearing" => said(name, sim.bearing(), |bearing| Sensed::Number(bearing.si())),
        "odometry" => said(name, sim.motion(), |motion| {
            let (x, y) = (motion.x.si(), motion.y.si());
            let turned = motion.heading.si();
            Sensed::Numbers(vec![x, y, turned, motion.speed.si(), motion.turn.si()])
        }),
        "touched" => said(name, sim.touched(), Sensed::Truth),
        "escape" => said(name, sim.pressed(Button::Escape), Sensed::Truth),
        "battery" => {
            said(name, sim.charge(), |charge| Sensed::Pair(charge.voltage.si(), charge.left))
        }
        "color" => said(name, sim.color(), |color| {
            Sensed::Numbers(vec![color.red, color.green, color.blue])
        }),
        "glow" => said(name, sim.glow(), |glow| {
            glow.map_or(Sensed::Nothing, |glow| Sensed::Pair(glow.bearing.si(), glow.strength))
        }),
        "camera" => said(name, sim.frame(), |frame| Sensed::Picture {
            rows: frame.height,
            columns: frame.width,
            rgb: frame.rgb.to_vec(),
        }),
        _ => return None,
    })
}

fn said<T>(name: &str, reading: Reading<T>, take: impl FnOnce(T) -> Sensed) -> PyResult<Sensed> {
    match reading.value {
        Ok(value) => Ok(take(value)),
        Err(Invalid::NotYet | Invalid::OutOfRange) => Ok(Sensed::Nothing),
        Err(Invalid::NoAnswer) => Err(error(format!("the sensor of '{name}' does not answer"))),
        Err(Invalid::Frozen) => {
            Err(error(format!("the sensor of '{name}' repeats its last value")))
        }
        Err(Invalid::NotFinite) => {
            Err(error(format!("the sensor of '{name}' returns a value that is not a number")))
        }
        Err(Invalid::Restarted) => {
            Err(error(format!("the controller of '{name}' has restarted since the run began")))
        }
    }
}
