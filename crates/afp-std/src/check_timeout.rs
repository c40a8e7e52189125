//! Limit the time that an action may take.

use afp_core::{Events, Fault, Instant, Supervisor};

use crate::templates;
use crate::templates::check_timeout::{Event, Inputs, Live};

/// The template's only event.
const TIMED_OUT: u16 = 0;

/// Reports that its time is over, at every poll from then on.
#[derive(Clone, Copy, Debug)]
pub struct CheckTimeout {
    until: Instant,
    wanted: Events,
}

impl<E: ?Sized> Supervisor<templates::CheckTimeout, E> for CheckTimeout {
    fn start(inputs: Inputs, wanted: Events, _: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(CheckTimeout { until: now + inputs.duration.duration(), wanted })
    }

    fn poll(&mut self, _: Live, _: &mut E, now: Instant) -> Result<Option<Event>, Fault> {
        let over = now >= self.until && self.wanted.contains(TIMED_OUT);
        Ok(over.then_some(Event::TimedOut))
    }
}

#[cfg(test)]
mod tests {
    use super::{CheckTimeout, Event, Events, Inputs, Instant, Live, Supervisor};
    use afp_core::Duration;
    use afp_core::quantity::Time;

    fn started(wanted: u64) -> CheckTimeout {
        let inputs = Inputs { duration: Time::from_si(2.0) };
        Supervisor::start(inputs, Events::from_bits(wanted), &mut (), Instant::ZERO).unwrap()
    }

    #[test]
    fn it_reports_when_the_time_is_over_and_not_before() {
        let mut watch = started(1);
        let at = |ms| Instant::ZERO + Duration::from_millis(ms);
        assert_eq!(watch.poll(Live {}, &mut (), at(1999)), Ok(None));
        assert_eq!(watch.poll(Live {}, &mut (), at(2000)), Ok(Some(Event::TimedOut)));
    }

    #[test]
    fn an_ignored_event_is_not_reported() {
        assert_eq!(started(0).poll(Live {}, &mut (), Instant::MAX), Ok(None));
    }
}
