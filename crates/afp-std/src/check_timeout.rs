//! Limit the time of an action.

use afp_core::{Duration, Events, Fault, Instant, OnReturn, Supervisor};

use crate::templates;
use crate::templates::check_timeout::{Event, Inputs, Live};

const TIMED_OUT: u16 = 0;

/// Reports at every poll after its time is over.
#[derive(Clone, Copy, Debug)]
pub struct CheckTimeout {
    until: Instant,
}

impl<E: ?Sized> Supervisor<templates::CheckTimeout, E> for CheckTimeout {
    fn start(inputs: Inputs, _: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(CheckTimeout { until: now + inputs.duration.duration() })
    }

    fn poll(
        &mut self,
        _: Live,
        wanted: Events,
        _: &mut E,
        now: Instant,
    ) -> Result<Option<Event>, Fault> {
        let over = now >= self.until && wanted.contains(TIMED_OUT);
        Ok(over.then_some(Event::TimedOut))
    }

    fn resume(&mut self, _: &mut E, _: Instant, away: Duration) -> Result<OnReturn, Fault> {
        self.until += away;
        Ok(OnReturn::Continues)
    }
}

#[cfg(test)]
mod tests {
    use super::{
        CheckTimeout, Duration, Event, Events, Inputs, Instant, Live, OnReturn, Supervisor,
    };
    use afp_core::quantity::Time;

    fn started() -> CheckTimeout {
        let inputs = Inputs { duration: Time::from_si(2.0) };
        Supervisor::start(inputs, &mut (), Instant::ZERO).unwrap()
    }

    #[test]
    fn it_reports_after_the_time_and_not_before() {
        let mut watch = started();
        let at = |ms| Instant::ZERO + Duration::from_millis(ms);
        assert_eq!(watch.poll(Live {}, Events::from_bits(1), &mut (), at(1999)), Ok(None));
        assert_eq!(
            watch.poll(Live {}, Events::from_bits(1), &mut (), at(2000)),
            Ok(Some(Event::TimedOut))
        );
    }

    #[test]
    fn the_time_of_a_suspension_does_not_count() {
        let mut watch = started();
        let at = |ms| Instant::ZERO + Duration::from_millis(ms);
        let away = Duration::from_secs(60);
        assert_eq!(watch.resume(&mut (), at(61_000), away), Ok(OnReturn::Continues));
        assert_eq!(watch.poll(Live {}, Events::from_bits(1), &mut (), at(61_999)), Ok(None));
        let event = watch.poll(Live {}, Events::from_bits(1), &mut (), at(62_000));
        assert_eq!(event, Ok(Some(Event::TimedOut)));
    }

    #[test]
    fn an_ignored_event_is_not_reported() {
        assert_eq!(started().poll(Live {}, Events::from_bits(0), &mut (), Instant::MAX), Ok(None));
    }
}
