//! The Carbot: the robot of the wheel. What is said of it here nobody else in this crate knows.

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

/// A room in which nothing is.
const EMPTY: &str = "version = 1\nname = \"nowhere\"\n[robot]\npose_m_deg = [0, 0, 0]\n";

/// The Carbot with the built-in toolboxes and others: their names, and what registers their templates.
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

/// Adds the classes that only the Carbot has.
///
/// # Errors
/// Python has no memory.
pub fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Carbot>()?;
    module.add_class::<learn::Courses>()?;
    module.add_class::<learn::Judge>()?;
    module.add_function(wrap_pyfunction!(learn::target, module)?)?;
    module.add_class::<CarbotRobot>()
}
