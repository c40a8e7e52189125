//! Components in Python: the slots that a loaded plan polls, and their shared state.
//!
//! An implementation is an object with `poll` and, for an actor, `interrupt`. The package makes it
//! from classes, functions and coroutines. The [`Robot`] holds the simulation for the duration of a
//! call.

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

use crate::toolbox::Ready;
use call::PyTemplate;
pub use components::{Components, interruption};
pub use depth::{is_inside, may_run, may_sweep};
use handles::PyHandle;
pub use host::{ENDED_ALL, Host, RAISED};
pub use registry::AnyRegistry;

/// A plan's object value: any Python object.
pub type Object = Arc<PyHandle>;

/// Adds the implementations of a toolbox to a registry.
fn register(py: Python<'_>, toolbox: &Ready, host: &Arc<Host>, registry: &mut dyn AnyRegistry) {
    let Ready { declared, makers, .. } = toolbox;
    for object in &declared.objects {
        registry.add_object(&declared.name, &object.name);
    }
    for (name, maker) in makers {
        let index = declared.templates.iter().position(|template| template.name == *name);
        let Some(index) = index else { continue };
        let template = PyTemplate::new(host, declared, index, maker.clone_ref(py));
        registry.add(&declared.name, name, declared.templates[index].kind, template);
    }
}
