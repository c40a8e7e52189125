//! Report the time since the start.

use afp_core::quantity::Time;
use afp_core::{Duration, Events, Fault, Instant, OnReturn, Supervisor};

use crate::since::Since;
use crate::templates;
use crate::templates::stopwatch::{Event, Inputs, Live};

const TICKED: u16 = 0;

/// Reports the time since its start at every poll.
#[derive(Clone, Copy, Debug)]
pub struct Stopwatch {
    since: Since,
}

impl<E: ?Sized> Supervisor<templates::Stopwatch, E> for Stopwatch {
    fn start(_: Inputs, _: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(Stopwatch { since: Since::new(now) })
    }

    fn poll(
        &mut self,
        live: Live,
        wanted: Events,
        _: &mut E,
        now: Instant,
    ) -> Result<Option<Event>, Fault> {
        let start = self.since.start(live.restart, now);
        let elapsed = Time::from_si(now.since(start).as_secs_f64());
        Ok(wanted.contains(TICKED).then_some(Event::Ticked { elapsed }))
    }

    fn resume(&mut self, _: &mut E, _: Instant, away: Duration) -> Result<OnReturn, Fault> {
        self.since.shift(away);
        Ok(OnReturn::Continues)
    }
}

#[cfg(test)]
mod tests {
    use super::{Duration, Event, Events, Inputs, Instant, Live, Stopwatch, Supervisor, Time};

    #[test]
    fn the_time_counts_from_the_last_start() {
        let mut watch: Stopwatch = Supervisor::start(Inputs {}, &mut (), Instant::ZERO).unwrap();
        for (ms, restart, elapsed) in [(0, 1, 0.0), (1500, 1, 1.5), (2000, 2, 0.0), (2500, 2, 0.5)]
        {
            let now = Instant::ZERO + Duration::from_millis(ms);
            let event = watch.poll(Live { restart }, Events::from_bits(1), &mut (), now);
            assert_eq!(event, Ok(Some(Event::Ticked { elapsed: Time::from_si(elapsed) })));
        }
    }
}
