//! The nesting depth of components: a component may run another simulation, which may call
//! components.
//!
//! Each level uses stack of the thread that Python does not count.

use std::cell::Cell;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// The most levels; half a megabyte of stack is enough for them.
const MOST: u32 = 8;

thread_local! {
    static DEPTH: Cell<u32> = const { Cell::new(0) };
}

/// Calls a component.
pub fn inside<T>(call: impl FnOnce() -> T) -> T {
    struct Left;
    impl Drop for Left {
        fn drop(&mut self) {
            DEPTH.set(DEPTH.get().saturating_sub(1));
        }
    }
    DEPTH.set(DEPTH.get() + 1);
    let _left = Left;
    call()
}

/// Whether a component is being called in this thread.
pub fn is_inside() -> bool {
    DEPTH.get() > 0
}

/// Checks that this thread may run another simulation.
///
/// # Errors
/// The nesting is too deep.
pub fn may_run() -> PyResult<()> {
    match DEPTH.get() < MOST {
        true => Ok(()),
        false => Err(PyRuntimeError::new_err(format!(
            "{MOST} simulations already run inside one another's components"
        ))),
    }
}

/// Checks that this thread may run a sweep.
///
/// # Errors
/// A component is being called.
pub fn may_sweep() -> PyResult<()> {
    match is_inside() {
        false => Ok(()),
        true => Err(PyRuntimeError::new_err("a component cannot run a sweep")),
    }
}
