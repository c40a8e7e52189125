//! Outcomes that tests inject.

use std::fmt;

use afp_core::Value;
use afp_core::trace::{ComponentId, Outcome};

use super::outputs::Stage;

/// An outcome to report instead of the component's own.
#[derive(Clone, Debug, PartialEq)]
pub struct Injection {
    /// The supervisor or actor.
    pub component: ComponentId,
    /// Its event or state. [`Outcome::Error`] makes an actor fail, [`Outcome::DeadlineMissed`]
    /// makes the next poll of a supervisor count as late.
    pub outcome: Outcome,
    /// Its outputs, by position in the template, each of its port's type.
    pub outputs: Vec<(u16, Value)>,
}

/// The injection for a component's next poll.
pub(super) type Injected = Option<Box<Injection>>;

/// Why an outcome cannot be injected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NotInjected {
    /// The component is not being polled.
    NotActive,
    /// An earlier injection is still pending.
    Waiting,
}

impl Injection {
    /// Stores the injection, unless another one is pending.
    pub(super) fn put(&self, place: &mut Injected) -> Result<(), NotInjected> {
        if place.is_some() {
            return Err(NotInjected::Waiting);
        }
        *place = Some(Box::new(self.clone()));
        Ok(())
    }

    pub(super) fn stage(&self, stage: &mut Stage<'_>) {
        for (port, value) in &self.outputs {
            stage.put(*port, value.clone());
        }
    }
}

impl fmt::Display for NotInjected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            NotInjected::NotActive => "the component is not active",
            NotInjected::Waiting => "the component already has something to report",
        })
    }
}

impl std::error::Error for NotInjected {}
