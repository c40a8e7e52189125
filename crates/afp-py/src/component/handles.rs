//! References of plans to Python, in one place for the garbage collector.
//!
//! A component may refer back to its simulation, by a closure or a traceback. The collector frees
//! such cycles only if it sees every reference, and it cannot look inside a plan.

use std::collections::BTreeMap;
use std::mem;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::{PyTraverseError, PyVisit};

/// The references of one simulation.
#[derive(Default)]
pub struct PyHandles {
    things: Mutex<Things>,
}

#[derive(Default)]
struct Things {
    next: u64,
    by_key: BTreeMap<u64, Py<PyAny>>,
}

/// A reference to an object during its own lifetime.
pub struct PyHandle {
    handles: Arc<PyHandles>,
    key: u64,
}

impl PyHandles {
    /// Keeps an object.
    pub fn put(self: &Arc<Self>, thing: Py<PyAny>) -> PyHandle {
        let mut things = self.lock();
        let key = things.next;
        things.next += 1;
        things.by_key.insert(key, thing);
        PyHandle { handles: Arc::clone(self), key }
    }

    /// Passes the objects to the garbage collector.
    ///
    /// # Errors
    /// Those of the collector.
    pub fn traverse(&self, visit: &PyVisit<'_>) -> Result<(), PyTraverseError> {
        // No thread waits for the interpreter while holding this lock.
        self.lock().by_key.values().try_for_each(|thing| visit.call(thing))
    }

    /// Drops all objects.
    pub fn clear(&self) {
        let things = mem::take(&mut self.lock().by_key);
        // A destructor may call back here.
        drop(things);
    }

    fn lock(&self) -> MutexGuard<'_, Things> {
        // A panic leaves no partial change.
        self.things.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl PyHandle {
    /// The object.
    ///
    /// # Errors
    /// The garbage collector has taken it.
    pub fn get<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let things = self.handles.lock();
        let gone = || PyRuntimeError::new_err("the simulation is gone");
        Ok(things.by_key.get(&self.key).ok_or_else(gone)?.bind(py).clone())
    }
}

impl Drop for PyHandle {
    fn drop(&mut self) {
        let thing = self.handles.lock().by_key.remove(&self.key);
        // As above.
        drop(thing);
    }
}
