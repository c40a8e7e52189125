//! Do nothing for a while.

use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};

use crate::templates;
use crate::templates::wait::{Inputs, Live, State};

/// Waits until its time is over.
#[derive(Clone, Copy, Debug)]
pub struct Wait {
    until: Instant,
}

impl<E: ?Sized> Actor<templates::Wait, E> for Wait {
    fn start(inputs: Inputs, _: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(Wait { until: now + inputs.duration.duration() })
    }

    fn poll(&mut self, _: Live, _: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        Ok(if now >= self.until { Poll::Ready(State::Elapsed) } else { Poll::Pending })
    }

    fn interrupt(&mut self, _: &mut E, _: Instant) -> Result<(), Fault> {
        Ok(())
    }
}

impl<E: ?Sized> Resumable<templates::Wait, E> for Wait {
    fn suspend(&mut self, _: &mut E, _: Instant) -> Result<(), Fault> {
        Ok(())
    }

    fn resume(&mut self, _: &mut E, _: Instant, away: Duration) -> Result<(), Fault> {
        self.until += away;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{Actor, Duration, Inputs, Instant, Live, Poll, Resumable, State, Wait};
    use afp_core::quantity::Time;

    #[test]
    fn it_ends_after_the_time_and_not_before() {
        let start = Instant::from_nanos(5_000_000_000);
        let at = |ms| start + Duration::from_millis(ms);
        let inputs = Inputs { duration: Time::from_si(0.25) };
        let mut wait: Wait = Actor::start(inputs, &mut (), start).unwrap();
        assert_eq!(wait.poll(Live {}, &mut (), at(240)), Ok(Poll::Pending));
        assert_eq!(wait.poll(Live {}, &mut (), at(250)), Ok(Poll::Ready(State::Elapsed)));
        assert_eq!(wait.interrupt(&mut (), at(250)), Ok(()));
    }

    #[test]
    fn ten_seconds_paused_at_four_for_a_minute_end_at_seventy() {
        let at = |seconds| Instant::ZERO + Duration::from_secs(seconds);
        let inputs = Inputs { duration: Time::from_si(10.0) };
        let mut wait: Wait = Actor::start(inputs, &mut (), at(0)).unwrap();
        assert_eq!(wait.suspend(&mut (), at(4)), Ok(()));
        assert_eq!(wait.resume(&mut (), at(64), Duration::from_secs(60)), Ok(()));
        assert_eq!(wait.poll(Live {}, &mut (), at(69)), Ok(Poll::Pending));
        assert_eq!(wait.poll(Live {}, &mut (), at(70)), Ok(Poll::Ready(State::Elapsed)));
    }
}
