//! Components in Python: the slots that a loaded plan polls, and what they share.
//!
//! What implements a template is an object with a `poll` and, for an actor, an `interrupt`; the package makes it of
//! classes, functions and coroutines. The [`Robot`] has the simulation for the time of a call.

mod actor;
mod call;
mod computation;
mod depth;
mod handles;
mod host;
mod supervisor;

use std::sync::Arc;

use afp::load::Registry;
use afp_dsl::toolbox::TemplateKind;
use afp_sim::Simulation;
use pyo3::prelude::*;

use crate::toolbox::Toolbox;
use actor::PyActor;
use call::PyTemplate;
use computation::PyComputation;
pub use depth::{may_run, may_sweep};
use handles::PyHandle;
pub use host::{Host, RAISED};
use supervisor::PySupervisor;

/// An object of a plan: whatever Python put there.
pub type Object = Arc<PyHandle>;

/// Adds the implementations of a toolbox to a registry.
///
/// # Errors
/// The toolbox can no longer be read.
pub fn register(
    py: Python<'_>,
    toolbox: &Toolbox,
    host: &Arc<Host>,
    registry: &mut Registry<Simulation>,
) -> PyResult<()> {
    let declared = toolbox.declared()?;
    let name_of_toolbox = declared.name.as_str();
    for object in &declared.objects {
        registry.add_object::<Object>(name_of_toolbox, &object.name);
    }
    for (name, maker) in toolbox.makers(py) {
        let index = declared.templates.iter().position(|template| template.name == name);
        let Some(index) = index else { continue };
        let kind = declared.templates[index].kind;
        let template = PyTemplate::new(host, &declared, index, maker);
        match kind {
            TemplateKind::Actor => {
                let new = move || Box::new(PyActor::new(template.clone())) as _;
                registry.add_actor(name_of_toolbox, &name, new);
            }
            TemplateKind::Supervisor => {
                let new = move || Box::new(PySupervisor::new(template.clone())) as _;
                registry.add_supervisor(name_of_toolbox, &name, new);
            }
            TemplateKind::Computation => {
                let new = move || Box::new(PyComputation::new(template.clone())) as _;
                registry.add_computation(name_of_toolbox, &name, new);
            }
        }
    }
    Ok(())
}
