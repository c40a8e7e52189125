//! A robot that plays every part: its actors last until a scenario finishes them, its supervisors report what a
//! scenario fires. So a plan can be tried before anybody has written a component for it.

mod robot;

use afp::load::Registry;
use afp_dsl::toolbox::{TemplateKind, Toolbox};

use robot::Part;
pub use robot::{Nothing, StandIn};

/// Gives every actor and supervisor of a toolbox a part that does nothing by itself. What is computed nobody can play.
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
