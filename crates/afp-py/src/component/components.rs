//! Components in Python for an engine that makes many plans, each with its own robot.

use std::sync::{Arc, Mutex, PoisonError};

use afp_dsl::Compiled;
use pyo3::prelude::*;

use super::{AnyRegistry, Host, register};
use crate::attach::attached;
use crate::errors::error;
use crate::link::link;
use crate::toolbox::{Ready, Toolbox};

/// Components in Python for engines; each plan gets its own robot.
pub struct Components {
    toolboxes: Vec<Ready>,
    hosts: Mutex<Vec<Arc<Host>>>,
    broken: Mutex<Option<PyErr>>,
}

impl Components {
    /// Takes the current state of the toolboxes that plans were compiled with, for all of the
    /// plans.
    ///
    /// # Errors
    /// A toolbox has changed since the compilation, or is invalid.
    pub fn new(py: Python<'_>, toolboxes: &[Py<Toolbox>], compiled: &Compiled) -> PyResult<Self> {
        let ready = |toolbox: &Py<Toolbox>| {
            let ready = toolbox.get().ready(py)?;
            let is_known = compiled.sources.iter().any(|source| source.text == ready.text);
            if is_known { Ok(ready) } else { Err(changed(&ready.declared.name)) }
        };
        let toolboxes = toolboxes.iter().map(ready).collect::<PyResult<_>>()?;
        Ok(Components { toolboxes, hosts: Mutex::default(), broken: Mutex::default() })
    }

    /// Registers the implementations of templates for one plan.
    pub fn register(&self, registry: &mut dyn AnyRegistry) {
        if self.toolboxes.is_empty() {
            return;
        }
        let registered = attached(|py| {
            let host = Arc::new(Host::new(link().robot(py)?));
            for toolbox in &self.toolboxes {
                register(py, toolbox, &host, registry);
            }
            Ok(host)
        });
        match registered {
            Ok(host) => {
                let mut hosts = self.hosts.lock().unwrap_or_else(PoisonError::into_inner);
                // Hosts of finished plans have no more failures to report.
                hosts.retain(|host| Arc::strong_count(host) > 1 || host.is_aborted());
                hosts.push(host);
            }
            Err(why) => *self.broken.lock().unwrap_or_else(PoisonError::into_inner) = Some(why),
        }
    }

    /// The host of the only registered plan; `None` without components.
    ///
    /// # Errors
    /// As [`Components::raised`].
    pub fn host(self, py: Python<'_>) -> PyResult<Option<Arc<Host>>> {
        self.raised(py)?;
        Ok(self.hosts.into_inner().unwrap_or_else(PoisonError::into_inner).pop())
    }

    /// Whether there is an exception to raise.
    pub fn is_over(&self) -> bool {
        if self.toolboxes.is_empty() {
            return false;
        }
        let broken = self.broken.lock().unwrap_or_else(PoisonError::into_inner).is_some();
        let hosts = self.hosts.lock().unwrap_or_else(PoisonError::into_inner);
        broken || hosts.iter().any(|host| host.is_aborted())
    }

    /// Interrupts components that run in other threads.
    ///
    /// # Errors
    /// As [`Host::interrupt`].
    pub fn interrupt(&self, py: Python<'_>) -> PyResult<()> {
        let hosts = self.hosts.lock().unwrap_or_else(PoisonError::into_inner);
        hosts.iter().try_for_each(|host| host.interrupt(py))
    }

    /// Raises exceptions that cannot become outcomes: of a broken toolbox, `SystemExit` and
    /// similar.
    ///
    /// # Errors
    /// The exception.
    pub fn raised(&self, py: Python<'_>) -> PyResult<()> {
        if let Some(why) = self.broken.lock().unwrap_or_else(PoisonError::into_inner).take() {
            return Err(why);
        }
        let hosts = self.hosts.lock().unwrap_or_else(PoisonError::into_inner);
        hosts.iter().find_map(|host| host.aborted(py)).map_or(Ok(()), Err)
    }
}

/// The function that interrupts components, if they still exist.
pub fn interruption(
    components: &Arc<Components>,
) -> impl Fn(Python<'_>) -> PyResult<()> + Send + Sync + 'static {
    let components = Arc::downgrade(components);
    move |py| components.upgrade().map_or(Ok(()), |components| components.interrupt(py))
}

/// The error for a toolbox that has changed since the compilation.
fn changed(name: &str) -> PyErr {
    error(format!(
        "the toolbox '{name}' has changed since this scenario or sweep was created\n  help: take plan.scenarios again, or sweep again"
    ))
}
