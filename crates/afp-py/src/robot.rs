//! `Robot`: the robot of a project, or the Carbot's common part, for components in Python.

use std::any::Any;
use std::mem;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use afp_core::Instant;
use afp_session::Simulated;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::sensed::Sensed;
use crate::value::no_pickle;

/// The robot of a component: devices and time, without ground truth.
///
/// Use it only while a component is being called.
#[pyclass(module = "afp", frozen, subclass)]
pub struct Robot {
    slot: Mutex<Slot>,
    sense: Sense,
}

/// Reads a sensor of a robot by name.
pub type Sense = fn(&dyn Any, &str) -> PyResult<Sensed>;

/// The robot during a call, or its stand-in.
struct Slot {
    robot: Box<dyn Held>,
    caller: Option<Arc<Caller>>,
}

/// A Python template whose component uses the robot during a call.
#[derive(Debug)]
pub struct Caller {
    /// Its name.
    pub name: String,
    /// The devices that it may command.
    pub uses: Vec<String>,
}

/// A simulated robot of any type.
pub trait Held: Send {
    fn time(&self) -> Instant;
    fn halt(&mut self);
    fn as_any(&self) -> &dyn Any;
    fn as_any_mut(&mut self) -> &mut dyn Any;
}

impl<R: Simulated> Held for R {
    fn time(&self) -> Instant {
        self.now()
    }

    fn halt(&mut self) {
        let now = self.now();
        self.stop(now);
    }

    fn as_any(&self) -> &dyn Any {
        self
    }

    fn as_any_mut(&mut self) -> &mut dyn Any {
        self
    }
}

/// The error outside of calls.
const NO_CALL: &str = "the robot can be used only while a component is being called";

impl Robot {
    /// A robot object with a stand-in.
    pub fn new(stand_in: Box<dyn Held>, sense: Sense) -> Robot {
        Robot { slot: Mutex::new(Slot { robot: stand_in, caller: None }), sense }
    }

    /// Swaps in the robot for a caller, or swaps it out without one.
    pub fn exchange<R: Simulated>(&self, env: &mut R, caller: Option<&Arc<Caller>>) {
        let mut slot = self.lock();
        if let Some(held) = slot.robot.as_any_mut().downcast_mut::<R>() {
            mem::swap(env, held);
            slot.caller = caller.cloned();
        }
    }

    fn lock(&self) -> MutexGuard<'_, Slot> {
        self.slot.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Uses the robot, without calling Python in between.
    fn with<T>(&self, use_it: impl FnOnce(&mut dyn Held) -> T) -> PyResult<T> {
        let mut slot = self.lock();
        match slot.caller {
            Some(_) => Ok(use_it(&mut *slot.robot)),
            None => Err(PyRuntimeError::new_err(NO_CALL)),
        }
    }

    /// Commands a device of a robot with a known type; the template must declare its use.
    #[cfg(feature = "carbot")]
    pub(crate) fn command<R: Simulated, T>(
        &self,
        device: &str,
        use_it: impl FnOnce(&mut R) -> T,
    ) -> PyResult<T> {
        if let Some(caller) = &self.lock().caller
            && !caller.uses.iter().any(|used| used == device)
        {
            let name = &caller.name;
            return Err(PyRuntimeError::new_err(format!(
                "'{name}' commands '{device}' without saying so: an actor says uses=[\"{device}\"]; supervisors command nothing"
            )));
        }
        let used = self.with(|robot| robot.as_any_mut().downcast_mut::<R>().map(use_it))?;
        used.ok_or_else(|| crate::errors::error("the robot is of another kind"))
    }

    /// The value of a sensor.
    pub(crate) fn sensed<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let sensed = self.with(|robot| (self.sense)(robot.as_any(), name))?;
        sensed?.into_bound(py)
    }
}

#[pymethods]
impl Robot {
    /// The time of this step, in seconds since the start.
    #[getter]
    fn time(&self) -> PyResult<f64> {
        self.with(|robot| robot.time().as_secs_f64())
    }

    /// Request a stop.
    fn stop(&self) -> PyResult<()> {
        self.with(|robot| robot.halt())
    }

    /// The value of a signal, by device and name: `robot.sense("bumper.left")`. `None` before its
    /// first value.
    fn sense<'py>(&self, py: Python<'py>, signal: &str) -> PyResult<Bound<'py, PyAny>> {
        self.sensed(py, signal)
    }

    fn __repr__(&self) -> String {
        match self.time() {
            Ok(time) => format!("<Robot, {time:.3} s>"),
            Err(_) => "<Robot, outside of a call>".to_owned(),
        }
    }

    fn __reduce__(&self) -> PyResult<()> {
        Err(no_pickle("Robot", "use it with its simulation"))
    }
}
