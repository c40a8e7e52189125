//! What all components of a run share: the robot, which they have while they are called, and what they raised.

use std::mem;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use afp_core::{Fault, Instant, Reason};
use afp_sim::Simulation;
use pyo3::exceptions::{PyBaseException, PyException};
use pyo3::prelude::*;
use pyo3::{PyTraverseError, PyVisit};

use super::depth::inside;
use super::handles::PyHandles;
use crate::robot::Robot;

/// What a plan sees of an exception.
const RAISED: Fault = Fault::new(&Reason {
    code: "python-exception",
    text: "a component written in Python raised an exception",
});

/// An exception of a component.
pub struct Failure {
    pub at: Instant,
    pub template: String,
    pub error: Py<PyBaseException>,
}

/// What the components of a run share.
pub struct Host {
    pub robot: Py<Robot>,
    /// What else the plan holds of Python.
    pub handles: Arc<PyHandles>,
    failures: Mutex<Vec<Failure>>,
    /// What ends the whole run: Ctrl-C and the like, which no `Error` edge shall catch.
    abort: Mutex<Option<Py<PyBaseException>>>,
}

impl Host {
    /// For a run whose components get this robot.
    pub fn new(robot: Py<Robot>) -> Host {
        Host { robot, handles: Arc::default(), failures: Mutex::default(), abort: Mutex::default() }
    }

    /// Calls Python, which may use the robot meanwhile.
    ///
    /// # Errors
    /// [`RAISED`] for an exception, which is kept.
    pub fn call_with_robot<T>(
        &self,
        env: &mut Simulation,
        template: &str,
        call: impl FnOnce(Python<'_>) -> PyResult<T>,
    ) -> Result<T, Fault> {
        let now = env.now();
        Python::attach(|py| {
            let robot = self.robot.get();
            robot.exchange(env, true);
            let done = inside(|| call(py));
            robot.exchange(env, false);
            done.map_err(|error| self.fail(py, now, template, error))
        })
    }

    /// Calls Python without a robot.
    ///
    /// # Errors
    /// As [`Host::call_with_robot`].
    pub fn call<T>(
        &self,
        template: &str,
        call: impl FnOnce(Python<'_>) -> PyResult<T>,
    ) -> Result<T, Fault> {
        Python::attach(|py| {
            inside(|| call(py)).map_err(|error| self.fail(py, Instant::ZERO, template, error))
        })
    }

    fn fail(&self, py: Python<'_>, at: Instant, template: &str, error: PyErr) -> Fault {
        let ordinary = error.is_instance_of::<PyException>(py);
        let error = error.into_value(py);
        if ordinary {
            lock(&self.failures).push(Failure { at, template: template.to_owned(), error });
        } else {
            lock(&self.abort).get_or_insert(error);
        }
        RAISED
    }

    /// Whether something was raised that ends the run.
    pub fn is_aborted(&self) -> bool {
        lock(&self.abort).is_some()
    }

    /// What was raised that ends the run.
    pub fn aborted(&self, py: Python<'_>) -> Option<PyErr> {
        let raised = lock(&self.abort).take()?;
        Some(PyErr::from_value(raised.into_bound(py).into_any()))
    }

    /// Shows what is held of Python to the garbage collector.
    ///
    /// # Errors
    /// Those of the collector.
    pub fn traverse(&self, visit: &PyVisit<'_>) -> Result<(), PyTraverseError> {
        self.handles.traverse(visit)?;
        lock(&self.failures).iter().try_for_each(|failure| visit.call(&failure.error))?;
        visit.call(&*lock(&self.abort))
    }

    /// Lets go of it.
    pub fn clear(&self) {
        self.handles.clear();
        drop(self.failures());
        let raised = lock(&self.abort).take();
        drop(raised);
    }

    /// What was raised since this was last asked.
    pub fn failures(&self) -> Vec<Failure> {
        mem::take(&mut *lock(&self.failures))
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // Lists are pushed to as a whole: a panic leaves nothing half done.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
