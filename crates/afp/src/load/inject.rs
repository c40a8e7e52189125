//! Outcomes that tests put in the place of a component's own.

use std::fmt;

use afp_core::Value;
use afp_core::trace::{ComponentId, Outcome};

use super::outputs::Stage;

/// An outcome to be reported in place of what a component sees.
#[derive(Clone, Debug, PartialEq)]
pub struct Injection {
    /// The supervisor or actor.
    pub component: ComponentId,
    /// Its event or state; [`Outcome::Error`] makes an actor fail, [`Outcome::DeadlineMissed`] makes the next poll of a
    /// supervisor count as a late one.
    pub outcome: Outcome,
    /// The outputs that come with it, by position among the template's, each of its port's type.
    pub outputs: Vec<(u16, Value)>,
}

/// What waits for the next poll of a component.
pub(super) type Injected = Option<Box<Injection>>;

/// Why a component cannot be made to report something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NotInjected {
    /// It is not being polled.
    NotActive,
    /// It has not yet reported what it was made to report before.
    Waiting,
}

impl Injection {
    /// Lets it wait in a place, unless another one waits there.
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
