//! Which process this is, among those that were forked from one another.
//!
//! Python tells of its forks. Asking the system takes longer than a step of most plans.

use std::sync::atomic::{AtomicU32, Ordering};

use pyo3::prelude::*;
use pyo3::types::PyDict;
use pyo3::wrap_pyfunction;

static FORKS: AtomicU32 = AtomicU32::new(0);

/// How many forks lie between the process that loaded the package and this one.
pub fn process() -> u32 {
    FORKS.load(Ordering::Relaxed)
}

/// Lets Python tell.
///
/// # Errors
/// Those of Python.
pub fn listen(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    // There is no fork on Windows.
    if let Some(register) = py.import("os")?.getattr_opt("register_at_fork")? {
        let told = PyDict::new(py);
        told.set_item("after_in_child", wrap_pyfunction!(forked, module)?)?;
        register.call((), Some(&told))?;
    }
    Ok(())
}

#[pyfunction]
fn forked() {
    FORKS.fetch_add(1, Ordering::Relaxed);
}
