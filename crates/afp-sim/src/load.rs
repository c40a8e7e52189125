//! The Carbot as a robot for plans that are loaded at run time.

use afp::load::{Library, Registry, Templates};
use afp_session::{Loader, simulated};

use crate::simulation::Simulation;

/// The simulated Carbot with the templates of `std` and `carbot`; `more` registers the templates of
/// other toolboxes.
pub fn carbot(more: impl Fn(&mut Registry<Simulation>) + Sync) -> impl Loader {
    simulated::<Simulation, _>(move |registry| {
        afp_std::templates::register(registry);
        afp_carbot::templates::register(registry);
        more(registry);
    })
}

impl Templates for Simulation {
    fn add_to(library: &mut Library<Self>) {
        library.register(afp_std::templates::register).register(afp_carbot::templates::register);
    }
}
