//! `Robot` of the Carbot: its devices by names of their own, for components in Python.

use afp_carbot::devices::{Navigator, Rotator};
use afp_core::quantity::{Angle, AngularSpeed, Speed};
use afp_sim::Simulation;
use pyo3::PyClassInitializer;
use pyo3::prelude::*;

use crate::robot::Robot;
use crate::value::measured;

/// The robot as a component in Python has it: devices and time, not the truth.
///
/// It can be used while a component is being called and not between calls.
#[pyclass(module = "afp", name = "Robot", frozen, extends = Robot)]
pub struct CarbotRobot;

impl CarbotRobot {
    /// A robot with these names.
    pub fn around(py: Python<'_>, robot: Robot) -> PyResult<Py<Robot>> {
        let robot = Bound::new(py, PyClassInitializer::from(robot).add_subclass(CarbotRobot))?;
        Ok(robot.into_super().unbind())
    }
}

/// Commands a device, without a call of Python meanwhile.
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
    /// Asks for a speed ahead (m/s) and a turn rate (rad/s, to the left), for a fifth of a second at most: ask again.
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

    /// Points the range sensor, radians to the left of the heading.
    fn point(slf: &Bound<'_, Self>, bearing: &Bound<'_, PyAny>) -> PyResult<()> {
        let bearing = finite(measured("bearing", bearing, "rad")?)?;
        command(slf, "rotator", |sim| {
            let now = sim.now();
            sim.point(Angle::from_si(bearing), now);
        })
    }

    /// How far it is to the nearest thing ahead of the range sensor, metres; infinity for silence; `None` before the
    /// first echo and for one that the sensor cannot measure.
    #[getter]
    fn distance<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        sensed(slf, "distance")
    }

    /// Where the range sensor points, radians to the left of the heading.
    #[getter]
    fn bearing<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        sensed(slf, "bearing")
    }

    /// What the wheels have counted: x, y in metres and heading in radians against the start, speed, turn rate.
    #[getter]
    fn odometry<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        sensed(slf, "odometry")
    }

    /// Whether the bumper is pressed.
    #[getter]
    fn touched<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        sensed(slf, "touched")
    }

    /// Whether the escape button is held down.
    #[getter]
    fn escape<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        sensed(slf, "escape")
    }

    /// The battery's voltage, and the share of its charge that is left.
    #[getter]
    fn battery<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        sensed(slf, "battery")
    }

    /// Red, green and blue of the floor, each from 0 to 1; `None` before it was looked at.
    #[getter]
    fn color<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        sensed(slf, "color")
    }

    /// Bearing (radians) and strength of the brightest infrared source; `None` where all is dark.
    #[getter]
    fn glow<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        sensed(slf, "glow")
    }

    /// The latest picture, rows x columns x 3, a copy; `None` before the first one.
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
