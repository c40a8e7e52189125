//! What holds a run back to real time, and what can end it.

use std::cell::RefCell;

use afp_core::Instant;
use afp_session::{Gate, Go};

use crate::live::Live;
use crate::pace::{Pace, Waited};
use crate::report::Report;
use crate::stop::StopFlag;

/// The gate of a run of the command line.
pub(super) struct RunGate<'a> {
    report: &'a RefCell<Report>,
    pace: Pace,
    stop: StopFlag,
    live: Option<&'a dyn Live>,
    /// Why the run was halted and when, until somebody does something about it.
    halt: Option<(Halt, Instant)>,
}

/// Why a run is halted for a moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Halt {
    /// The Escape key was pressed.
    Escape,
    /// Somebody who watches asks for something.
    Asked,
}

impl<'a> RunGate<'a> {
    pub(super) fn new(
        report: &'a RefCell<Report>,
        pace: Pace,
        stop: StopFlag,
        live: Option<&'a dyn Live>,
    ) -> Self {
        RunGate { report, pace, stop, live, halt: None }
    }

    /// Seconds of real time so far.
    pub(super) fn spent(&self) -> f64 {
        self.pace.spent()
    }

    /// Why the run was halted and when, since this was last asked for.
    pub(super) fn take_halt(&mut self) -> Option<(Halt, Instant)> {
        self.halt.take()
    }

    /// Halts the run where time stands by the wall clock.
    fn halt(&mut self, why: Halt, target: Instant, now: Instant) -> Go {
        let at = self.pace.simulated().unwrap_or(target).min(target);
        self.halt = Some((why, at.max(now)));
        Go::Stop
    }
}

impl Gate for RunGate<'_> {
    fn pass(&mut self, target: Instant, now: Instant) -> Go {
        let mut report = self.report.borrow_mut();
        report.pass(now);
        if report.is_closed() {
            return Go::Stop;
        }
        drop(report);
        let asked = || self.live.is_some_and(|live| live.is_asked());
        match self.pace.wait(target, &self.stop, &asked) {
            Waited::Due => Go::On,
            Waited::Escape => self.halt(Halt::Escape, target, now),
            Waited::Asked => self.halt(Halt::Asked, target, now),
            Waited::Stop => Go::Stop,
        }
    }
}
