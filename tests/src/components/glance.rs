//! The smallest supervisor.

use afp_core::{Duration, Events, Fault, Instant, OnReturn, Supervisor, Text};

use crate::platform::Platform;
use crate::script::Phase;
use crate::templates::{self, glance};

/// Watches until the script reports its event.
#[derive(Clone, Debug)]
pub struct Glance {
    name: Text,
}

impl Supervisor<templates::Glance, Platform> for Glance {
    fn start(inputs: glance::Inputs<'_>, env: &mut Platform, now: Instant) -> Result<Self, Fault> {
        env.call(inputs.name, Phase::Start, now)?;
        Ok(Glance { name: Text::try_from(inputs.name)? })
    }

    fn poll(
        &mut self,
        _: glance::Live,
        wanted: Events,
        env: &mut Platform,
        now: Instant,
    ) -> Result<Option<glance::Event>, Fault> {
        env.call(self.name.as_str(), Phase::Poll, now)?;
        let seen = env.outcomes(self.name.as_str(), now).next().is_some();
        Ok((seen && wanted.contains(0)).then_some(glance::Event::Seen))
    }

    fn resume(&mut self, env: &mut Platform, now: Instant, _: Duration) -> Result<OnReturn, Fault> {
        env.call(self.name.as_str(), Phase::Resume, now)?;
        Ok(OnReturn::Continues)
    }
}
