//! An actor without a state.

use afp_core::{Actor, Fault, Instant, Poll};

use crate::platform::{Life, Platform};
use crate::script::Phase;
use crate::templates::{self, stay};

/// Acts until it is interrupted or the script makes it fail.
#[derive(Clone, Debug)]
pub struct Stay {
    life: Life,
}

impl Actor<templates::Stay, Platform> for Stay {
    fn start(inputs: stay::Inputs<'_>, env: &mut Platform, now: Instant) -> Result<Self, Fault> {
        Ok(Stay { life: env.begin(inputs.name, now)? })
    }

    fn poll(
        &mut self,
        _: stay::Live,
        env: &mut Platform,
        now: Instant,
    ) -> Result<Poll<stay::State>, Fault> {
        env.act(&self.life, Phase::Poll, now)?;
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, env: &mut Platform, now: Instant) -> Result<(), Fault> {
        env.act(&self.life, Phase::Interrupt, now)
    }
}
