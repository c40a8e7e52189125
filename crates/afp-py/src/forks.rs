//! The generation of this process among its forks.
//!
//! Python reports forks; a system call would take longer than a step of most plans.

use std::sync::atomic::{AtomicU32, Ordering};

use pyo3::prelude::*;
use pyo3::types::PyDict;
use pyo3::wrap_pyfunction;

static FORKS: AtomicU32 = AtomicU32::new(0);

/// The number of forks between the process that loaded the package and this one.
pub fn process() -> u32 {
    FORKS.load(Ordering::Relaxed)
}

/// Registers for Python's fork reports.
///
/// # Errors
/// Those of Python.
pub fn listen(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    // Windows has no fork.
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
