//! `Robot` of the Carbot for components in Python, with its own names for devices.

use afp_carbot::devices::{Navigator, Rotator};
use afp_core::quantity::{Angle, AngularSpeed, Speed};
use afp_sim::Simulation;
use pyo3::PyClassInitializer;
use pyo3::prelude::*;

use crate::robot::Robot;
use crate::value::measured;

/// The robot of a component: devices and time, without ground truth.
///
/// Use it only while a component is being called.
#[pyclass(module = "afp", name = "Robot", frozen, extends = Robot)]
pub struct CarbotRobot;

impl CarbotRobot {
    /// Wraps a robot with these names.
    pub fn around(py: Python<'_>, robot: Robot) -> PyResult<Py<Robot>> {
        let robot = Bound::new(py, PyClassInitializer::from(robot).add_subclass(CarbotRobot))?;
        Ok(robot.into_super().unbind())
    }
}

/// Commands a device, without calling Python in between.
fn command(
    robot: &Bound<'_, CarbotRobot>,
    device: &str,
    use_it: impl FnOnce(&mut Simulation),
) -> PyResult<()> {
    robot.as_super().get().command(device, use_it)
}

fn sensed<'py>(robot: &Bound<'py, CarbotRobot>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    robot.as_super().get().sensed(robot.py(), name)
}

#[pymethods]
impl CarbotRobot {
    /// Request a speed (m/s) and a turn rate (rad/s, to the left). It holds for at most a fifth of
    /// a second, so repeat it.
    #[pyo3(signature = (speed, turn=None), text_signature = "($self, speed, turn=0.0)")]
    fn drive(
        slf: &Bound<'_, Self>,
        speed: &Bound<'_, PyAny>,
        turn: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let speed = finite(measured("speed", speed, "m/s")?)?;
        let turn = turn.map_or(Ok(0.0), |turn| finite(measured("turn", turn, "rad/s")?))?;
        command(slf, "navigator", |sim| {
            let now = sim.now();
            Navigator::drive(sim, Speed::from_si(speed), AngularSpeed::from_si(turn), now);
        })
    }

    /// Point the range sensor, in radians to the left of the heading.
    fn point(slf: &Bound<'_, Self>, bearing: &Bound<'_, PyAny>) -> PyResult<()> {
        let bearing = finite(measured("bearing", bearing, "rad")?)?;
        command(slf, "rotator", |sim| {
            let now = sim.now();
            sim.point(Angle::from_si(bearing), now);
        })
    }

    /// The distance to the nearest object ahead of the range sensor, in metres. It is infinite
    /// without an echo, and `None` before the first ping or if the sensor cannot measure it.
    #[getter]
    fn distance<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        sensed(slf, "distance")
    }

    /// The bearing of the range sensor, in radians to the left of the heading.
    #[getter]
    fn bearing<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        sensed(slf, "bearing")
    }

    /// The odometry: x and y in metres and heading in radians, relative to the start, speed, turn
    /// rate.
    #[getter]
    fn odometry<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        sensed(slf, "odometry")
    }

    /// Whether the bumper is pressed.
    #[getter]
    fn touched<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        sensed(slf, "touched")
    }

    /// Whether the escape button is held.
    #[getter]
    fn escape<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        sensed(slf, "escape")
    }

    /// The battery's voltage, and the remaining share of its charge.
    #[getter]
    fn battery<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        sensed(slf, "battery")
    }

    /// Red, green and blue of the floor, from 0 to 1; `None` before the first measurement.
    #[getter]
    fn color<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        sensed(slf, "color")
    }

    /// Bearing (radians) and strength of the brightest infrared source; `None` without a source.
    #[getter]
    fn glow<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        sensed(slf, "glow")
    }

    /// A copy of the latest picture, rows x columns x 3; `None` before the first one.
    #[getter]
    fn camera<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        sensed(slf, "camera")
    }
}

fn finite(value: f64) -> PyResult<f64> {
    match value.is_finite() {
        true => Ok(value),
        false => Err(pyo3::exceptions::PyValueError::new_err("a command must be a finite number")),
    }
}
