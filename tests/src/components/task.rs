//! The smallest actor.

use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};

use crate::platform::{Life, Platform};
use crate::script::Phase;
use crate::templates::{self, task};

/// Acts until the script reports its state.
#[derive(Clone, Debug)]
pub struct Task {
    life: Life,
}

impl Actor<templates::Task, Platform> for Task {
    fn start(inputs: task::Inputs<'_>, env: &mut Platform, now: Instant) -> Result<Self, Fault> {
        Ok(Task { life: env.begin(inputs.name, now)? })
    }

    fn poll(
        &mut self,
        _: task::Live,
        env: &mut Platform,
        now: Instant,
    ) -> Result<Poll<task::State>, Fault> {
        env.act(&self.life, Phase::Poll, now)?;
        let done = env.outcomes(self.life.name(), now).next().is_some();
        if !done {
            return Ok(Poll::Pending);
        }
        env.end(&self.life);
        Ok(Poll::Ready(task::State::Done))
    }

    fn interrupt(&mut self, env: &mut Platform, now: Instant) -> Result<(), Fault> {
        env.act(&self.life, Phase::Interrupt, now)
    }
}

impl Resumable<templates::Task, Platform> for Task {
    fn suspend(&mut self, env: &mut Platform, now: Instant) -> Result<(), Fault> {
        env.act(&self.life, Phase::Suspend, now)
    }

    fn resume(&mut self, env: &mut Platform, now: Instant, _: Duration) -> Result<(), Fault> {
        env.act(&self.life, Phase::Resume, now)
    }
}
