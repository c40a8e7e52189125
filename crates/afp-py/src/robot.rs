//! `Robot`: the devices of the robot, for components in Python.

mod sense;

use std::mem;
use std::sync::{Mutex, MutexGuard, PoisonError};

use afp_carbot::devices::{Navigator, Rotator};
use afp_core::Environment;
use afp_core::quantity::{Angle, AngularSpeed, Speed};
use afp_sim::{Simulation, World};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::errors::error;
use crate::value::no_pickle;
pub use sense::sense;

/// The robot as a component in Python has it: devices and time, not the truth.
///
/// It can be used while a component is being called and not between calls.
#[pyclass(module = "afp", frozen)]
pub struct Robot {
    slot: Mutex<Slot>,
}

/// The simulation while a component is called; an empty one otherwise.
struct Slot {
    sim: Simulation,
    in_call: bool,
}

impl Robot {
    /// A robot without a simulation.
    pub fn new() -> PyResult<Robot> {
        let empty = World::parse(EMPTY).map_err(|why| error(why.message))?;
        let sim = Simulation::new(&empty, 0).map_err(|why| error(why.message))?;
        Ok(Robot { slot: Mutex::new(Slot { sim, in_call: false }) })
    }

    /// Takes the simulation or gives it back.
    pub fn exchange(&self, env: &mut Simulation, in_call: bool) {
        let mut slot = self.lock();
        mem::swap(env, &mut slot.sim);
        slot.in_call = in_call;
    }

    fn lock(&self) -> MutexGuard<'_, Slot> {
        self.slot.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What a sensor says.
    fn sensed<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let sensed = self.with(|sim| sense(sim, name))?;
        sensed?.into_bound(py)
    }

    /// Uses the simulation, without a call of Python meanwhile.
    fn with<T>(&self, use_it: impl FnOnce(&mut Simulation) -> T) -> PyResult<T> {
        let mut slot = self.lock();
        match slot.in_call {
            true => Ok(use_it(&mut slot.sim)),
            false => Err(PyRuntimeError::new_err(
                "the robot can be used only while a component is being called",
            )),
        }
    }
}

/// A room in which nothing is.
const EMPTY: &str = "version = 1\nname = \"nowhere\"\n[robot]\npose_m_deg = [0, 0, 0]\n";

#[pymethods]
impl Robot {
    /// The time of this step, seconds since the start.
    #[getter]
    fn time(&self) -> PyResult<f64> {
        self.with(|sim| sim.now().as_secs_f64())
    }

    /// Asks for a speed ahead (m/s) and a turn rate (rad/s, to the left), for half a second at most: ask again.
    #[pyo3(signature = (speed, turn=0.0))]
    fn drive(&self, speed: f64, turn: f64) -> PyResult<()> {
        let (speed, turn) = (finite(speed)?, finite(turn)?);
        self.with(|sim| {
            let now = sim.now();
            Navigator::drive(sim, Speed::from_si(speed), AngularSpeed::from_si(turn), now);
        })
    }

    /// Asks for a standstill.
    fn stop(&self) -> PyResult<()> {
        self.with(|sim| {
            let now = sim.now();
            sim.stop(now);
        })
    }

    /// Points the range sensor, radians to the left of the heading.
    fn point(&self, bearing: f64) -> PyResult<()> {
        let bearing = finite(bearing)?;
        self.with(|sim| {
            let now = sim.now();
            sim.point(Angle::from_si(bearing), now);
        })
    }

    /// How far it is to the nearest thing ahead of the range sensor, metres; infinity for silence; `None` before the
    /// first echo and for one that the sensor cannot measure.
    #[getter]
    fn distance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.sensed(py, "distance")
    }

    /// Where the range sensor points, radians to the left of the heading.
    #[getter]
    fn bearing<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.sensed(py, "bearing")
    }

    /// What the wheels have counted: x, y in metres and heading in radians against the start, speed, turn rate.
    #[getter]
    fn odometry<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.sensed(py, "odometry")
    }

    /// Whether the bumper is pressed.
    #[getter]
    fn touched<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.sensed(py, "touched")
    }

    /// Whether the escape button is held down.
    #[getter]
    fn escape<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.sensed(py, "escape")
    }

    /// The battery's voltage, and the share of its charge that is left.
    #[getter]
    fn battery<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.sensed(py, "battery")
    }

    /// Red, green and blue of the floor, each from 0 to 1; `None` before it was looked at.
    #[getter]
    fn color<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.sensed(py, "color")
    }

    /// Bearing (radians) and strength of the brightest infrared source; `None` where all is dark.
    #[getter]
    fn glow<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.sensed(py, "glow")
    }

    /// The latest picture, rows x columns x 3, a copy; `None` before the first one.
    #[getter]
    fn camera<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.sensed(py, "camera")
    }

    fn __reduce__(&self) -> PyResult<()> {
        Err(no_pickle("Robot", "it lives as long as its simulation"))
    }
}

fn finite(value: f64) -> PyResult<f64> {
    match value.is_finite() {
        true => Ok(value),
        false => Err(pyo3::exceptions::PyValueError::new_err("a command must be a finite number")),
    }
}
