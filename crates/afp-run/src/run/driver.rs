//! Drives a session to the end of its run, and does what keys, signals and those who watch ask for on the way.

use afp_core::{Duration, Instant, StartError};
use afp_session::{AnySession, Go, Observer};

use super::gate::{Halt, RunGate};
use crate::live::Live;
use crate::options::TimeKeeper;
use crate::report::StoppedBy;
use crate::requests;

/// The robot itself sleeps no longer than this before keys and signals are looked at.
const SLICE: Duration = Duration::from_millis(10);

/// How a session is driven.
pub(super) struct Driver<'a> {
    pub keeper: TimeKeeper,
    /// When the plan is stopped at the latest.
    pub end: Instant,
    pub live: Option<&'a dyn Live>,
}

impl Driver<'_> {
    /// Runs the plan to its end, or until it is stopped; says by what.
    pub fn run_to_end(
        &self,
        session: &mut dyn AnySession,
        gate: &mut RunGate<'_>,
        observers: &mut [&mut dyn Observer],
    ) -> Result<Option<StoppedBy>, StartError> {
        let itself = matches!(self.keeper, TimeKeeper::Robot);
        let stopped_by = loop {
            let went = match itself {
                true => self.slice(session, gate, observers)?,
                false => session.run(self.end, gate, observers)?,
            };
            match (gate.take_halt(), self.live) {
                // Nobody can press the robot's own buttons from here: the key stops it.
                (Some((Halt::Escape, _)), _) if itself => break StoppedBy::Signal,
                (Some((Halt::Escape, at)), _) => requests::press_stop(session, at),
                (Some((Halt::Asked, at)), Some(live)) => live.serve(session, at),
                _ if session.ending().is_some() => return Ok(None),
                _ if went == Go::Stop => break StoppedBy::Signal,
                _ if !itself || session.now() >= self.end => break StoppedBy::Until,
                _ => {}
            }
        };
        session.stop(observers);
        Ok(Some(stopped_by))
    }

    /// Keys and signals are looked at every [`SLICE`], however long the plan has nothing to do, and before each step,
    /// however late it is.
    fn slice(
        &self,
        session: &mut dyn AnySession,
        gate: &mut RunGate<'_>,
        observers: &mut [&mut dyn Observer],
    ) -> Result<Go, StartError> {
        match session.now() {
            now if now < self.end => session.tick(self.end.min(now + SLICE), gate, observers),
            _ => Ok(Go::On),
        }
    }
}
