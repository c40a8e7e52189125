//! The Python interface of AFP: the native half of the package `afp` under python/, for any robot.
//!
//! Code that needs the compiler, the scheduler or the simulator is here, one Python type per file.
//! The rest is in Python. Arrays and values are copies that outlive their simulation. While a plan
//! runs, the interpreter's lock is released for other threads.
//!
//! An extension is a crate of a few lines that calls [`fill`] with its links: `afp-py-wheel` for
//! the Carbot, or a generated crate for a project with its own robot or toolboxes.

mod attach;
mod callout;
#[cfg(feature = "carbot")]
mod carbot;
mod component;
mod errors;
mod files;
mod forks;
mod leave;
mod link;
mod log;
mod pause;
mod plan;
mod robot;
mod scenario;
mod sensed;
mod simulation;
mod sweep;
mod toolbox;
mod value;
mod world;

use pyo3::prelude::*;
use pyo3::wrap_pyfunction;

#[cfg(feature = "carbot")]
pub use carbot::carbot;
pub use errors::{error, run_error};
pub use link::{AnyLink, Link, linked};
pub use pyo3;

/// Paths that generated extensions use.
#[doc(hidden)]
pub mod __private {
    pub use afp_core;
    #[cfg(feature = "carbot")]
    pub use afp_sim::Simulation;
}

/// Fills the native half of the package `afp` with its classes, for a robot and its templates.
///
/// # Errors
/// Python has no memory.
pub fn fill(module: &Bound<'_, PyModule>, link: impl AnyLink + 'static) -> PyResult<()> {
    #[cfg(feature = "carbot")]
    let is_carbot = link.own_robot().is_none();
    let own_robot = link.own_robot();
    // An exception of a signal handler is an error here. On first use, numpy's functions would panic.
    numpy::array::get_array_module(module.py())?;
    drop(numpy::PyArray1::<f64>::zeros(module.py(), 0, false));
    link::set(link);
    forks::listen(module)?;
    leave::listen(module)?;
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("own_robot", own_robot)?;
    let py = module.py();
    module.add("AfpError", py.get_type::<errors::AfpError>())?;
    module.add("PlanError", py.get_type::<errors::PlanError>())?;
    module.add_class::<robot::Robot>()?;
    module.add_class::<plan::Diagnostic>()?;
    module.add_class::<plan::Plan>()?;
    module.add_class::<scenario::Broken>()?;
    module.add_class::<scenario::Scenario>()?;
    module.add_class::<scenario::Verdict>()?;
    module.add_class::<simulation::Driven>()?;
    module.add_class::<simulation::Event>()?;
    module.add_class::<simulation::Names>()?;
    module.add_class::<simulation::Runner>()?;
    module.add_class::<sweep::Sweeper>()?;
    module.add_class::<toolbox::Toolbox>()?;
    module.add_class::<world::World>()?;
    module.add_function(wrap_pyfunction!(files::read_text, module)?)?;
    module.add_function(wrap_pyfunction!(files::write_text, module)?)?;
    module.add_function(wrap_pyfunction!(log::draw_log, module)?)?;
    module.add_function(wrap_pyfunction!(log::pixels, module)?)?;
    module.add_function(wrap_pyfunction!(log::read_log, module)?)?;
    module.add_function(wrap_pyfunction!(log::read_recipe, module)?)?;
    module.add_function(wrap_pyfunction!(simulation::faults, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::alike, module)?)?;
    module.add_function(wrap_pyfunction!(value::number_of, module)?)?;
    // The Carbot's class replaces the common one.
    #[cfg(feature = "carbot")]
    if is_carbot {
        carbot::fill(module)?;
    }
    Ok(())
}
