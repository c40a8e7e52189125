//! Blink and beep while other components drive.

use crate::devices::Signals;
use crate::templates;
use crate::templates::blink::{Event, Inputs, Live};
use afp_core::quantity::Frequency;
use afp_core::{Events, Fault, Instant, Supervisor};

/// Switches the lamp and the tone by the time since its start.
#[derive(Clone, Debug)]
pub struct Blink {
    start: Instant,
    /// The last command.
    shown: (bool, Option<Frequency>),
}

impl<E: Signals + ?Sized> Supervisor<templates::Blink, E> for Blink {
    fn start(_: Inputs, _: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(Blink { start: now, shown: (false, None) })
    }

    fn poll(
        &mut self,
        live: Live,
        wanted: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<Event>, Fault> {
        let period = live.period.duration().as_nanos();
        let phase = now.since(self.start).as_nanos().checked_rem(period).unwrap_or(0);
        let on = phase < period / 2;
        let show = (on && live.light, Some(live.tone).filter(|_| on && live.sound));
        if show == self.shown {
            return Ok(None);
        }
        self.shown = show;
        env.signal(show.0, show.1, now);
        let on = show.0 || show.1.is_some();
        Ok(wanted.contains(0).then_some(Event::Switched { on }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;
    use afp_core::quantity::Time;

    #[test]
    fn light_and_tone_are_on_for_half_of_each_period() {
        let mut robot = Fake::new(&[]);
        let live = || Live {
            light: true,
            sound: true,
            tone: Frequency::from_si(440.0),
            period: Time::from_si(0.2),
        };
        let reported = robot.watch::<templates::Blink, Blink>(Inputs {}, live, 0, 450);
        assert_eq!(reported, Ok(None), "an ignored event is not reported");
        let (on, off) = ((true, Some(Frequency::from_si(440.0))), (false, None));
        assert_eq!(robot.signals, [on, off, on, off, on]);
    }
}
