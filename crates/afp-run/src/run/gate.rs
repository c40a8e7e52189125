//! What holds a run back to real time, and what can end it.

use std::cell::RefCell;

use afp_core::Instant;
use afp_session::{Gate, Go};

use crate::pace::{Pace, Waited};
use crate::report::Report;
use crate::stop::StopFlag;

/// The gate of a run of the command line.
pub(super) struct RunGate<'a> {
    report: &'a RefCell<Report>,
    pace: Pace,
    stop: StopFlag,
    /// When the Escape key was pressed, until somebody does something about it.
    escape: Option<Instant>,
}

impl<'a> RunGate<'a> {
    pub(super) fn new(report: &'a RefCell<Report>, pace: Pace, stop: StopFlag) -> Self {
        RunGate { report, pace, stop, escape: None }
    }

    /// Seconds of real time so far.
    pub(super) fn spent(&self) -> f64 {
        self.pace.spent()
    }

    /// When the Escape key was pressed, since this was last asked for: the run was halted for it.
    pub(super) fn take_escape(&mut self) -> Option<Instant> {
        self.escape.take()
    }
}

impl Gate for RunGate<'_> {
    fn pass(&mut self, target: Instant, now: Instant) -> Go {
        let mut report = self.report.borrow_mut();
        report.pass(now);
        if report.is_closed() {
            return Go::Stop;
        }
        match self.pace.wait(target, &self.stop) {
            Waited::Due => Go::On,
            Waited::Escape => {
                let at = self.pace.simulated().unwrap_or(target).min(target);
                self.escape = Some(at.max(now));
                Go::Stop
            }
            Waited::Stop => Go::Stop,
        }
    }
}
