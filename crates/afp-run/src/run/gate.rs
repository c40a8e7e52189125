//! Limits a run to real time and ends it on request.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

use afp_core::Instant;
use afp_session::{Asked, Gate, Go};

use crate::live::Live;
use crate::pace::{Pace, Waited};
use crate::report::{self, Report};
use crate::stop::StopFlag;

/// The gate of a run of the command line.
pub(super) struct RunGate<'a> {
    /// The report, which shows the progress; `None` on a real robot.
    report: Option<&'a Mutex<Report>>,
    /// Whether the report's output has failed.
    closed: Arc<AtomicBool>,
    pace: Pace,
    stop: StopFlag,
    live: Option<&'a dyn Live>,
    /// Whether a debugger has requests.
    debugger: Option<Asked>,
    /// Whether requests were handled after the last event of the run.
    served: bool,
    /// The reason and time of the last halt, until it is handled.
    halt: Option<(Halt, Instant)>,
}

/// The reason for a halt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Halt {
    /// The Escape key was pressed.
    Escape,
    /// A client has a request.
    Asked,
}

impl<'a> RunGate<'a> {
    pub(super) fn new(
        report: &'a Mutex<Report>,
        pace: Pace,
        stop: StopFlag,
        live: Option<&'a dyn Live>,
        debugger: Option<Asked>,
    ) -> Self {
        let closed = report::of(report).closed();
        // The control thread of a real robot must not wait for a lock.
        let report = (!pace.is_of_robot()).then_some(report);
        RunGate { report, closed, pace, stop, live, debugger, served: false, halt: None }
    }

    /// Seconds of real time so far.
    pub(super) fn spent(&self) -> f64 {
        self.pace.spent()
    }

    /// Takes the reason and time of the last halt.
    pub(super) fn take_halt(&mut self) -> Option<(Halt, Instant)> {
        self.halt.take()
    }

    /// Halts the run at the present simulated time by the wall clock.
    fn halt(&mut self, why: Halt, target: Instant, now: Instant) -> Go {
        let at = self.pace.simulated().unwrap_or(target).min(target);
        self.halt = Some((why, at.max(now)));
        Go::Stop
    }
}

impl Gate for RunGate<'_> {
    fn pass(&mut self, target: Instant, now: Instant) -> Go {
        if let Some(report) = self.report {
            report::of(report).pass(now);
        }
        if self.closed.load(Ordering::Relaxed) {
            return Go::Stop;
        }
        // Requests of a debugger never come between two others without a step.
        let debugger = self.debugger.as_ref().filter(|_| !self.served);
        let asked = || {
            self.live.is_some_and(|live| live.is_asked()) || debugger.is_some_and(Asked::is_asked)
        };
        let waited = self.pace.wait(target, &self.stop, &asked);
        self.served = waited == Waited::Asked;
        match waited {
            Waited::Due => Go::On,
            Waited::Escape => self.halt(Halt::Escape, target, now),
            Waited::Asked => self.halt(Halt::Asked, target, now),
            Waited::Stop => Go::Stop,
        }
    }
}
