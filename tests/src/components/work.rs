//! An actor with scripted states.

use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable, Text};

use crate::platform::{Life, Platform};
use crate::script::Phase;
use crate::templates::{self, Side, work};

/// Acts until the script reports a state.
#[derive(Clone, Debug)]
pub struct Work {
    life: Life,
    label: Text,
    side: Side,
    value: f64,
    polls: i64,
}

impl Actor<templates::Work, Platform> for Work {
    fn start(inputs: work::Inputs<'_>, env: &mut Platform, now: Instant) -> Result<Self, Fault> {
        let label = Text::try_from(inputs.label)?;
        Ok(Work {
            life: env.begin(inputs.name, now)?,
            label,
            side: inputs.side,
            value: inputs.value,
            polls: 0,
        })
    }

    fn poll(
        &mut self,
        live: work::Live,
        env: &mut Platform,
        now: Instant,
    ) -> Result<Poll<work::State>, Fault> {
        env.act(&self.life, Phase::Poll, now)?;
        self.polls += 1;
        let Some((outcome, number)) = env.outcomes(self.life.name(), now).next() else {
            return Ok(Poll::Pending);
        };
        let result = number.unwrap_or(self.value);
        let state = match outcome {
            "Done" => work::State::Done { result, count: self.polls, last: live.seen },
            _ => work::State::Other { result, text: self.label.clone(), chosen: self.side },
        };
        env.end(&self.life);
        Ok(Poll::Ready(state))
    }

    fn interrupt(&mut self, env: &mut Platform, now: Instant) -> Result<(), Fault> {
        env.act(&self.life, Phase::Interrupt, now)
    }
}

impl Resumable<templates::Work, Platform> for Work {
    fn suspend(&mut self, env: &mut Platform, now: Instant) -> Result<(), Fault> {
        env.act(&self.life, Phase::Suspend, now)
    }

    fn resume(&mut self, env: &mut Platform, now: Instant, _: Duration) -> Result<(), Fault> {
        env.act(&self.life, Phase::Resume, now)
    }
}
