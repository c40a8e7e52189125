//! The Carbot, the wheel's robot. Only this module of the crate knows it.

mod alone;
mod learn;
mod robot;
mod sense;

use afp::load::Registry;
use afp_sim::Simulation;
use pyo3::prelude::*;
use pyo3::wrap_pyfunction;

use crate::link::Link;
pub use alone::Carbot;
pub use robot::CarbotRobot;

/// An empty room.
const EMPTY: &str = "version = 1\nname = \"nowhere\"\n[robot]\npose_m_deg = [0, 0, 0]\n";

/// The Carbot with the built-in and additional toolboxes: their names and registrations.
pub fn carbot(
    toolboxes: &'static [&'static str],
    more: impl Fn(&mut Registry<Simulation>) + Send + Sync + 'static,
) -> Link<Simulation> {
    let register = move |registry: &mut Registry<Simulation>| {
        afp_std::templates::register(registry);
        afp_carbot::templates::register(registry);
        more(registry);
    };
    Link::built_in(
        toolboxes,
        register,
        (EMPTY, (&sense::SENSORS, sense::named)),
        CarbotRobot::around,
    )
}

/// Adds the Carbot's classes.
///
/// # Errors
/// Python has no memory.
pub fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Carbot>()?;
    module.add_class::<learn::Courses>()?;
    module.add_class::<learn::Judge>()?;
    module.add_class::<learn::Moment>()?;
    module.add_function(wrap_pyfunction!(learn::target, module)?)?;
    module.add_class::<CarbotRobot>()
}
