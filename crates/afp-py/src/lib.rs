//! The Python face of AFP: the native half of the package `afp` under python/.
//!
//! What needs the compiler, the scheduler or the simulator is here, one Python type a file; what can be said in
//! Python is said there. Nothing here borrows from a simulation: arrays and values are copies that outlive it.
//! While a plan runs, the interpreter's lock is free for other threads.

mod carbot;
mod component;
mod errors;
mod log;
mod pause;
mod plan;
mod robot;
mod scenario;
mod simulation;
mod sweep;
mod toolbox;
mod value;
mod world;

use pyo3::prelude::*;

/// The native half of the package `afp`.
#[pymodule]
mod _afp {
    #[pymodule_export]
    use crate::carbot::Carbot;
    #[pymodule_export]
    use crate::errors::{AfpError, PlanError};
    #[pymodule_export]
    use crate::log::read_log;
    #[pymodule_export]
    use crate::plan::{Diagnostic, Plan};
    #[pymodule_export]
    use crate::robot::Robot;
    #[pymodule_export]
    use crate::scenario::{Broken, Scenario, Verdict};
    #[pymodule_export]
    use crate::simulation::{Event, Runner, faults};
    #[pymodule_export]
    use crate::sweep::Sweeper;
    #[pymodule_export]
    use crate::toolbox::Toolbox;
    #[pymodule_export]
    use crate::world::World;

    /// Says which version this is.
    #[pymodule_init]
    fn init(module: &pyo3::Bound<'_, pyo3::types::PyModule>) -> pyo3::PyResult<()> {
        use pyo3::types::PyModuleMethods;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
