//! Report once, after a time.

use afp_core::{Duration, Events, Fault, Instant, OnReturn, Supervisor};

use crate::since::Since;
use crate::templates;
use crate::templates::after::{Event, Inputs, Live};

const ELAPSED: u16 = 0;

/// Reports at the first poll after its time, once for each start.
#[derive(Clone, Copy, Debug)]
pub struct After {
    since: Since,
    /// The start for which the time is over.
    over: Option<Instant>,
}

impl<E: ?Sized> Supervisor<templates::After, E> for After {
    fn start(_: Inputs, _: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(After { since: Since::new(now), over: None })
    }

    fn poll(
        &mut self,
        live: Live,
        wanted: Events,
        _: &mut E,
        now: Instant,
    ) -> Result<Option<Event>, Fault> {
        let start = self.since.start(live.restart, now);
        if self.over == Some(start) || now < start + live.duration.duration() {
            return Ok(None);
        }
        self.over = Some(start);
        Ok(wanted.contains(ELAPSED).then_some(Event::Elapsed))
    }

    fn resume(&mut self, _: &mut E, _: Instant, away: Duration) -> Result<OnReturn, Fault> {
        self.since.shift(away);
        self.over = self.over.map(|over| over + away);
        Ok(OnReturn::Continues)
    }
}

#[cfg(test)]
mod tests {
    use super::{After, Duration, Event, Events, Inputs, Instant, Live, OnReturn, Supervisor};
    use afp_core::quantity::Time;

    #[test]
    fn each_start_is_reported_once() {
        let mut watch: After = Supervisor::start(Inputs {}, &mut (), Instant::ZERO).unwrap();
        let mut at = |ms, restart| {
            let now = Instant::ZERO + Duration::from_millis(ms);
            let live = Live { duration: Time::from_si(2.0), restart };
            watch.poll(live, Events::from_bits(1), &mut (), now) == Ok(Some(Event::Elapsed))
        };
        let polls = [(0, 7), (1999, 7), (2000, 7), (2010, 7), (2500, 8), (4490, 8), (4500, 8)];
        let reports = polls.map(|(ms, restart)| at(ms, restart));
        assert_eq!(reports, [false, false, true, false, false, false, true]);
        assert!(!at(9000, 8));
    }

    #[test]
    fn a_suspension_neither_counts_nor_repeats_the_report() {
        let mut watch: After = Supervisor::start(Inputs {}, &mut (), Instant::ZERO).unwrap();
        let mut at = |ms, away| {
            let now = Instant::ZERO + Duration::from_millis(ms);
            let returned = watch.resume(&mut (), now, Duration::from_millis(away));
            assert_eq!(returned, Ok(OnReturn::Continues));
            let live = Live { duration: Time::from_si(2.0), restart: 0 };
            watch.poll(live, Events::from_bits(1), &mut (), now) == Ok(Some(Event::Elapsed))
        };
        assert_eq!(
            [at(0, 0), at(11_990, 10_000), at(12_000, 0), at(40_000, 20_000)],
            [false, false, true, false]
        );
    }

    #[test]
    fn an_ignored_report_is_lost() {
        let mut watch: After = Supervisor::start(Inputs {}, &mut (), Instant::ZERO).unwrap();
        for wanted in [0, 1] {
            let live = Live { duration: Time::from_si(0.0), restart: 0 };
            let wanted = Events::from_bits(wanted);
            assert_eq!(watch.poll(live, wanted, &mut (), Instant::ZERO), Ok(None));
        }
    }
}
