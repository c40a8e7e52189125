//! Components in Python: the slots that a loaded plan polls, and what they share.
//!
//! What implements a template is an object with a `poll` and, for an actor, an `interrupt`; the package makes it of
//! classes, functions and coroutines. The [`Robot`] has the simulation for the time of a call.

mod actor;
mod call;
mod components;
mod computation;
mod depth;
mod handles;
mod host;
mod registry;
mod supervisor;

use std::sync::Arc;

use pyo3::prelude::*;

use crate::toolbox::Toolbox;
use call::PyTemplate;
pub use components::Components;
pub use depth::{may_run, may_sweep};
use handles::PyHandle;
pub use host::{ENDED_ALL, Host, RAISED};
pub use registry::AnyRegistry;

/// An object of a plan: whatever Python put there.
pub type Object = Arc<PyHandle>;

/// Adds the implementations of a toolbox to a registry.
///
/// # Errors
/// The toolbox can no longer be read.
fn register(
    py: Python<'_>,
    toolbox: &Toolbox,
    host: &Arc<Host>,
    registry: &mut dyn AnyRegistry,
) -> PyResult<()> {
    let declared = toolbox.declared()?;
    for object in &declared.objects {
        registry.add_object(&declared.name, &object.name);
    }
    for (name, maker) in toolbox.makers(py) {
        let index = declared.templates.iter().position(|template| template.name == name);
        let Some(index) = index else { continue };
        let template = PyTemplate::new(host, &declared, index, maker);
        registry.add(&declared.name, &name, declared.templates[index].kind, template);
    }
    Ok(())
}
