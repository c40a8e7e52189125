//! Sensors by name, as values that own what they say.

use afp_carbot::devices::{
    Battery, Button, Buttons, Camera, ColorSensor, InfraredSensor, Invalid, Odometry, Reading,
    RotatingTelemetry, TouchSensor, Ultrasonic,
};
use afp_sim::Simulation;
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyAttributeError;
use pyo3::prelude::*;

use crate::errors::error;

/// What can be sensed.
const SENSORS: [&str; 9] =
    ["distance", "bearing", "odometry", "touched", "escape", "battery", "color", "glow", "camera"];

/// What a sensor said.
pub enum Sensed {
    Nothing,
    Truth(bool),
    Number(f64),
    Pair(f64, f64),
    /// As an array.
    Numbers(Vec<f64>),
    Picture {
        rows: usize,
        columns: usize,
        rgb: Vec<u8>,
    },
}

impl Sensed {
    /// The value as Python has it.
    pub fn into_bound(self, py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
        match self {
            Sensed::Nothing => Ok(py.None().into_bound(py)),
            Sensed::Truth(value) => value.into_bound_py_any(py),
            Sensed::Number(value) => value.into_bound_py_any(py),
            Sensed::Pair(first, second) => (first, second).into_bound_py_any(py),
            Sensed::Numbers(values) => Ok(values.into_pyarray(py).into_any()),
            Sensed::Picture { rows, columns, rgb } => {
                Ok(rgb.into_pyarray(py).reshape([rows, columns, 3])?.into_any())
            }
        }
    }
}

/// Reads a sensor. What has not been measured, yet or in the sensor's range, is nothing; a sensor that is broken is an
/// error.
///
/// # Errors
/// No such sensor, or one that is broken.
pub fn sense(sim: &Simulation, name: &str) -> PyResult<Sensed> {
    match name {
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
        _ => Err(PyAttributeError::new_err(format!(
            "the robot has no '{name}'; its sensors are: {}",
            SENSORS.join(", ")
        ))),
    }
}

fn said<T>(name: &str, reading: Reading<T>, take: impl FnOnce(T) -> Sensed) -> PyResult<Sensed> {
    match reading.value {
        Ok(value) => Ok(take(value)),
        Err(Invalid::NotYet | Invalid::OutOfRange) => Ok(Sensed::Nothing),
        Err(Invalid::NoAnswer) => Err(error(format!("the sensor of '{name}' does not answer"))),
        Err(Invalid::Frozen) => {
            Err(error(format!("the sensor of '{name}' says the same for ever")))
        }
        Err(Invalid::NotFinite) => {
            Err(error(format!("the sensor of '{name}' says what is no number")))
        }
    }
}
