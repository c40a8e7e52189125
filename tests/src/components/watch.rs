//! A supervisor with scripted events.

use afp_core::{Events, Fault, Instant, Supervisor, Text};

use crate::platform::Platform;
use crate::script::Phase;
use crate::templates::{self, watch};

/// Watches until the script reports an event.
#[derive(Clone, Debug)]
pub struct Watch {
    name: Text,
    value: f64,
    polls: i64,
}

impl Supervisor<templates::Watch, Platform> for Watch {
    fn start(inputs: watch::Inputs<'_>, env: &mut Platform, now: Instant) -> Result<Self, Fault> {
        env.call(inputs.name, Phase::Start, now)?;
        Ok(Watch { name: Text::try_from(inputs.name)?, value: inputs.value, polls: 0 })
    }

    fn poll(
        &mut self,
        live: watch::Live,
        wanted: Events,
        env: &mut Platform,
        now: Instant,
    ) -> Result<Option<watch::Event>, Fault> {
        env.call(self.name.as_str(), Phase::Poll, now)?;
        self.polls += 1;
        let above = |number: Option<f64>| number.is_none_or(|number| number > live.limit);
        let reported = |event: &str| {
            let mut outcomes = env.outcomes(self.name.as_str(), now);
            outcomes.find(|(name, number)| *name == event && above(*number))
        };
        if !live.armed {
            return Ok(None);
        }
        for (index, name) in (0..).zip(["First", "Second", "Third"]) {
            if let (true, Some((_, number))) = (wanted.contains(index), reported(name)) {
                let result = number.unwrap_or(self.value);
                return Ok(Some(match name {
                    "First" => watch::Event::First { result },
                    "Second" => watch::Event::Second { result, count: self.polls },
                    _ => watch::Event::Third { result },
                }));
            }
        }
        Ok(None)
    }
}
