//! Outcomes that tests put in the place of a component's own.

use std::fmt;

use afp_core::Value;
use afp_core::trace::ComponentId;

use super::outputs::Stage;

/// An outcome to be reported in place of what a component sees.
#[derive(Clone, Debug, PartialEq)]
pub struct Injection {
    /// The supervisor or actor.
    pub component: ComponentId,
    /// Its event or state, by position in the template; [`ERROR`] makes an actor fail, [`DEADLINE_MISSED`] makes the
    /// next poll of a supervisor count as a late one.
    ///
    /// [`ERROR`]: afp_core::trace::ERROR
    /// [`DEADLINE_MISSED`]: afp_core::trace::DEADLINE_MISSED
    pub outcome: u16,
    /// The outputs that come with it, by position among the template's, each of its port's type.
    pub outputs: Vec<(u16, Value)>,
}

/// What waits for the next poll of a component.
pub(super) type Injected = Option<Box<Injection>>;

/// The component is not being polled, so it cannot report anything.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotActive;

impl Injection {
    pub(super) fn boxed(&self) -> Injected {
        Some(Box::new(self.clone()))
    }

    /// Stages the outputs.
    pub(super) fn stage(&self, stage: &mut Stage<'_>) {
        for (port, value) in &self.outputs {
            stage.put(*port, value.clone());
        }
    }
}

impl fmt::Display for NotActive {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the component is not active")
    }
}

impl std::error::Error for NotActive {}
