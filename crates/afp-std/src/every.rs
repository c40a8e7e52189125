//! Report after each period.

use afp_core::{Duration, Events, Fault, Instant, OnReturn, Supervisor};

use crate::templates;
use crate::templates::every::{Event, Inputs, Live};

const DUE: u16 = 0;

/// Reports at the first poll after each whole period since its start; missed periods count once.
#[derive(Clone, Copy, Debug)]
pub struct Every {
    next: Instant,
    period: Duration,
}

impl<E: ?Sized> Supervisor<templates::Every, E> for Every {
    fn start(inputs: Inputs, _: &mut E, now: Instant) -> Result<Self, Fault> {
        let period = inputs.period.duration();
        Ok(Every { next: now + period, period })
    }

    fn poll(
        &mut self,
        _: Live,
        wanted: Events,
        _: &mut E,
        now: Instant,
    ) -> Result<Option<Event>, Fault> {
        if now < self.next {
            return Ok(None);
        }
        let (late, period) = (now.since(self.next).as_nanos(), self.period.as_nanos());
        let rest = late.checked_rem(period).unwrap_or(0);
        self.next = now + Duration::from_nanos(period - rest);
        Ok(wanted.contains(DUE).then_some(Event::Due))
    }

    fn resume(&mut self, _: &mut E, _: Instant, away: Duration) -> Result<OnReturn, Fault> {
        self.next += away;
        Ok(OnReturn::Continues)
    }
}

#[cfg(test)]
mod tests {
    use super::{Duration, Event, Events, Every, Inputs, Instant, Live, Supervisor};
    use afp_core::quantity::Time;

    #[test]
    fn each_period_is_reported_once_and_missed_periods_together() {
        let inputs = Inputs { period: Time::from_si(2.0) };
        let mut watch: Every = Supervisor::start(inputs, &mut (), Instant::ZERO).unwrap();
        let mut at = |ms| {
            let now = Instant::ZERO + Duration::from_millis(ms);
            watch.poll(Live {}, Events::from_bits(1), &mut (), now) == Ok(Some(Event::Due))
        };
        let quiet = [0, 1999, 2010, 4000 - 1, 6000 - 1, 13_999, 14_001];
        let due = [2000, 4010, 6000, 12_500, 14_000];
        let mut instants = [0; 12];
        instants[..7].copy_from_slice(&quiet);
        instants[7..].copy_from_slice(&due);
        instants.sort_unstable();
        for ms in instants {
            assert_eq!(at(ms), due.contains(&ms), "{ms} ms");
        }
    }
}
