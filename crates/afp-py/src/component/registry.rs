//! Registries for components in Python, independent of the robot's type.

use afp::load::Registry;
use afp_dsl::toolbox::TemplateKind;
use afp_session::Simulated;

use super::Object;
use super::actor::PyActor;
use super::call::PyTemplate;
use super::computation::PyComputation;
use super::supervisor::PySupervisor;

/// A registry of templates.
pub trait AnyRegistry {
    /// Adds a type of objects.
    fn add_object(&mut self, toolbox: &str, name: &str);

    /// Adds the implementation of a template.
    fn add(&mut self, toolbox: &str, name: &str, kind: TemplateKind, template: PyTemplate);
}

impl<R: Simulated> AnyRegistry for Registry<R> {
    fn add_object(&mut self, toolbox: &str, name: &str) {
        Registry::add_object::<Object>(self, toolbox, name);
    }

    fn add(&mut self, toolbox: &str, name: &str, kind: TemplateKind, template: PyTemplate) {
        match kind {
            TemplateKind::Actor => {
                self.add_actor(toolbox, name, move || {
                    Box::new(PyActor::new(template.clone())) as _
                });
            }
            TemplateKind::Supervisor => {
                self.add_supervisor(toolbox, name, move || {
                    Box::new(PySupervisor::new(template.clone())) as _
                });
            }
            TemplateKind::Computation => {
                self.add_computation(toolbox, name, move || {
                    Box::new(PyComputation::new(template.clone())) as _
                });
            }
        }
    }
}
