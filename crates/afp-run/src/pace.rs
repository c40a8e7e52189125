//! Limits simulated time to a multiple of real time, and watches keys and signals for all time
//! keepers.

use std::cell::Cell;
use std::io;
use std::thread;
use std::time::{Duration as Span, Instant as Wall};

use afp_core::Instant;

use crate::keys::{KeyWatch, Keys};
use crate::options::TimeKeeper;
use crate::stop::StopFlag;

/// The interval of checks for keys and signals during a wait.
const SLICE: Span = Span::from_millis(10);
/// The limit for lateness: beyond it (after a suspension or a slow step) the lost time is skipped.
const LATE: Span = Span::from_millis(250);

/// The result of a wait.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Waited {
    Due,
    /// The Escape key was pressed first.
    Escape,
    /// A client made a request first.
    Asked,
    /// A stop was requested first.
    Stop,
}

/// Limits the speed of simulated time.
pub(crate) struct Pace {
    begun: Wall,
    /// The total time for which simulated time stood still.
    stood: Cell<Span>,
    keeper: TimeKeeper,
    /// Says whether Escape was pressed; none without a terminal.
    escape: Option<Box<dyn Fn() -> bool>>,
}

impl Pace {
    /// # Errors
    /// There is no thread for the keys of a real robot.
    pub(crate) fn new(keeper: TimeKeeper) -> io::Result<Self> {
        let escape: Option<Box<dyn Fn() -> bool>> = match keeper {
            TimeKeeper::Nobody => None,
            TimeKeeper::Gate(_) => match Keys::take(true) {
                Some(keys) => Some(Box::new(move || keys.escape_pressed())),
                None => None,
            },
            TimeKeeper::Robot => match KeyWatch::start()? {
                Some(keys) => Some(Box::new(move || keys.escape_pressed())),
                None => None,
            },
        };
        Ok(Pace { begun: Wall::now(), stood: Cell::default(), keeper, escape })
    }

    /// Whether the robot keeps the time.
    pub(crate) fn is_of_robot(&self) -> bool {
        self.keeper == TimeKeeper::Robot
    }

    /// Seconds of real time so far.
    pub(crate) fn spent(&self) -> f64 {
        self.begun.elapsed().as_secs_f64()
    }

    /// The present simulated time by the wall clock, if the wall clock limits it.
    pub(crate) fn simulated(&self) -> Option<Instant> {
        match self.keeper {
            TimeKeeper::Nobody | TimeKeeper::Robot => None,
            TimeKeeper::Gate(times) => {
                let went = self.begun.elapsed().saturating_sub(self.stood.get());
                Some(Instant::from_nanos((went.as_nanos() as f64 * times) as u64))
            }
        }
    }

    /// Waits for simulated time `at`, or for an earlier reason to return.
    pub(crate) fn wait(&self, at: Instant, stop: &StopFlag, asked: &dyn Fn() -> bool) -> Waited {
        loop {
            if stop.is_raised() {
                return Waited::Stop;
            }
            if asked() {
                return Waited::Asked;
            }
            if self.escape.as_ref().is_some_and(|pressed| pressed()) {
                return Waited::Escape;
            }
            let TimeKeeper::Gate(times) = self.keeper else { return Waited::Due };
            let takes = Span::from_secs_f64((at.as_secs_f64() / times).min(1e9));
            let due = self.begun + takes + self.stood.get();
            let left = due.saturating_duration_since(Wall::now());
            if left.is_zero() {
                let late = due.elapsed();
                if late > LATE {
                    self.stood.set(self.stood.get() + late);
                }
                return Waited::Due;
            }
            thread::sleep(left.min(SLICE));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missed_time_is_not_caught_up() {
        let pace = Pace::new(TimeKeeper::Gate(1.0)).unwrap();
        let pace = Pace { begun: Wall::now() - Span::from_secs(5), ..pace };
        let (stop, at) =
            (StopFlag::default(), |millis: u64| Instant::from_nanos(millis * 1_000_000));
        assert_eq!(pace.wait(at(1000), &stop, &|| false), Waited::Due);
        let (begun, now) = (Wall::now(), pace.simulated().unwrap());
        assert!(now >= at(1000) && now < at(1500), "{now:?}");
        assert_eq!(pace.wait(at(1100), &stop, &|| false), Waited::Due);
        assert!(begun.elapsed() > Span::from_millis(50), "{:?}", begun.elapsed());
    }
}
