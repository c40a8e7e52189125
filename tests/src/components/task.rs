//! The smallest actor.

use afp_core::{Actor, Fault, Instant, Poll, Text};

use crate::platform::Platform;
use crate::script::Phase;
use crate::templates::{self, task};

/// Acts until the script reports its state.
#[derive(Clone, Debug)]
pub struct Task {
    name: Text,
}

impl Actor<templates::Task, Platform> for Task {
    fn start(inputs: task::Inputs<'_>, env: &mut Platform, now: Instant) -> Result<Self, Fault> {
        env.call(inputs.name, Phase::Start, now)?;
        Ok(Task { name: Text::try_from(inputs.name)? })
    }

    fn poll(
        &mut self,
        _: task::Live,
        env: &mut Platform,
        now: Instant,
    ) -> Result<Poll<task::State>, Fault> {
        env.call(self.name.as_str(), Phase::Poll, now)?;
        let done = env.outcomes(self.name.as_str(), now).next().is_some();
        Ok(if done { Poll::Ready(task::State::Done) } else { Poll::Pending })
    }

    fn interrupt(&mut self, env: &mut Platform, now: Instant) -> Result<(), Fault> {
        env.call(self.name.as_str(), Phase::Interrupt, now)
    }
}
