//! An actor without a state.

use afp_core::{Actor, Fault, Instant, Poll, Text};

use crate::platform::Platform;
use crate::script::Phase;
use crate::templates::{self, stay};

/// Acts until it is interrupted or the script makes it fail.
#[derive(Clone, Debug)]
pub struct Stay {
    name: Text,
}

impl Actor<templates::Stay, Platform> for Stay {
    fn start(inputs: stay::Inputs<'_>, env: &mut Platform, now: Instant) -> Result<Self, Fault> {
        env.call(inputs.name, Phase::Start, now)?;
        Ok(Stay { name: Text::try_from(inputs.name)? })
    }

    fn poll(
        &mut self,
        _: stay::Live,
        env: &mut Platform,
        now: Instant,
    ) -> Result<Poll<stay::State>, Fault> {
        env.call(self.name.as_str(), Phase::Poll, now)?;
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, env: &mut Platform, now: Instant) -> Result<(), Fault> {
        env.call(self.name.as_str(), Phase::Interrupt, now)
    }
}
