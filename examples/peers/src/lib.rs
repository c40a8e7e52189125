//! A robot for plans without implementations: its actors last until a scenario finishes them, and
//! its supervisors report events that a scenario fires. This tests a plan before its components
//! exist.

mod robot;

use afp::load::Registry;
use afp_dsl::toolbox::{TemplateKind, Toolbox};

use robot::Part;
pub use robot::{Nothing, StandIn};

/// Registers a stand-in for every actor and supervisor of a toolbox. Computations have none.
pub fn register(toolbox: &Toolbox, registry: &mut Registry<StandIn>) {
    for template in &toolbox.templates {
        let (home, name) = (&toolbox.name, &template.name);
        match template.kind {
            TemplateKind::Actor => registry.add_actor(home, name, || Box::new(Part)),
            TemplateKind::Supervisor => registry.add_supervisor(home, name, || Box::new(Part)),
            TemplateKind::Computation => {}
        }
    }
}
