//! `Driven`: the base of `afp.Simulation`.

use std::sync::OnceLock;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use pyo3::{PyTraverseError, PyVisit};

use super::Runner;

/// A driver of a run. It contains `step`, because a Python wrapper would cost a twentieth of a
/// step.
#[pyclass(module = "afp", frozen, subclass)]
pub struct Driven {
    runner: OnceLock<Py<Runner>>,
}

#[pymethods]
impl Driven {
    #[new]
    #[pyo3(signature = (*_args, **_named))]
    fn new(_args: &Bound<'_, PyTuple>, _named: Option<&Bound<'_, PyDict>>) -> Driven {
        Driven { runner: OnceLock::new() }
    }

    /// The driven run.
    #[getter(_runner)]
    fn run(&self, py: Python<'_>) -> PyResult<Py<Runner>> {
        self.runner.get().map(|runner| runner.clone_ref(py)).ok_or_else(not_made)
    }

    #[setter(_runner)]
    fn set_run(&self, runner: Py<Runner>) -> PyResult<()> {
        let set = self.runner.set(runner);
        set.map_err(|_| {
            PyRuntimeError::new_err("a simulation cannot be initialized twice; make a new one")
        })
    }

    /// Make the next step of the plan, which may be later; return whether it is still running.
    fn step(&self, py: Python<'_>) -> PyResult<bool> {
        self.runner.get().ok_or_else(not_made)?.get().step(py)
    }

    fn __traverse__(&self, visit: PyVisit<'_>) -> Result<(), PyTraverseError> {
        visit.call(self.runner.get())
    }
}

#[cold]
fn not_made() -> PyErr {
    PyRuntimeError::new_err("the simulation has not been made: call __init__ of afp.Simulation")
}
