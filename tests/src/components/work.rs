//! An actor with scripted states.

use afp_core::{Actor, Fault, Instant, Poll, Text};

use crate::platform::Platform;
use crate::script::Phase;
use crate::templates::{self, Side, work};

/// Acts until the script reports a state.
#[derive(Clone, Debug)]
pub struct Work {
    name: Text,
    label: Text,
    side: Side,
    value: f64,
    polls: i64,
}

impl Actor<templates::Work, Platform> for Work {
    fn start(inputs: work::Inputs<'_>, env: &mut Platform, now: Instant) -> Result<Self, Fault> {
        env.call(inputs.name, Phase::Start, now)?;
        Ok(Work {
            name: Text::try_from(inputs.name)?,
            label: Text::try_from(inputs.label)?,
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
        env.call(self.name.as_str(), Phase::Poll, now)?;
        self.polls += 1;
        let Some((outcome, number)) = env.outcomes(self.name.as_str(), now).next() else {
            return Ok(Poll::Pending);
        };
        let result = number.unwrap_or(self.value);
        Ok(Poll::Ready(match outcome {
            "Done" => work::State::Done { result, count: self.polls, last: live.seen },
            _ => work::State::Other { result, text: self.label.clone(), chosen: self.side },
        }))
    }

    fn interrupt(&mut self, env: &mut Platform, now: Instant) -> Result<(), Fault> {
        env.call(self.name.as_str(), Phase::Interrupt, now)
    }
}
