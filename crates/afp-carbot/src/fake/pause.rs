//! Runs of actors that are suspended in the middle.

use super::Fake;
use crate::devices::Rotator;
use afp_core::quantity::{Angle, Length};
use afp_core::{ActorTemplate, Duration, Fault, Poll, Resumable};
use core::mem::discriminant;
use std::format;
use std::string::String;
use std::vec::Vec;

/// The longest run without the pauses, milliseconds.
const LONGEST: u64 = 30_000;
/// Length of a pause, milliseconds: longer than any patience.
const AWAY: u64 = 10_000;

/// Ticks after a pause in which the drive must be commanded gently.
const FRESH: u64 = 20;

/// The suspensions of a run.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pauses {
    /// Polled time before each, milliseconds.
    pub(crate) at: Vec<u64>,
    /// How far the robot is moved to the left during each, metres.
    pub(crate) moved: f64,
    /// Whether the run ends while the actor is suspended.
    pub(crate) abandoned: bool,
}

impl Fake {
    /// Runs an actor with suspensions; returns which state it reaches, `-` for none. Checks that
    /// a suspended actor commands nothing, and that it starts from a standstill afterwards.
    pub(crate) fn run_paused<'a, T: ActorTemplate, A: Resumable<T, Fake>>(
        &mut self,
        inputs: T::Inputs<'_>,
        live: impl Fn() -> T::Live<'a>,
        pauses: &Pauses,
    ) -> Result<String, Fault> {
        let mut actor = A::start(inputs, self, self.now)?;
        let mut fresh = 0;
        for polled in 0..=LONGEST / 10 {
            if pauses.at.contains(&(polled * 10)) {
                actor.suspend(self, self.now)?;
                self.pause(pauses.moved);
                if pauses.abandoned {
                    break;
                }
                let before = (self.command, self.target, self.signals.len());
                actor.resume(self, self.now, Duration::from_millis(AWAY))?;
                assert_eq!(before, (self.command, self.target, self.signals.len()), "T5");
                (self.gains, fresh) = ((0.0, 0.0), FRESH);
            }
            self.tick();
            fresh = fresh.saturating_sub(1);
            if fresh > 0 {
                self.check_gains(pauses.moved);
            }
            if let Poll::Ready(state) = actor.poll(live(), self, self.now)? {
                return Ok(format!("{:?}", discriminant(&state)));
            }
        }
        actor.interrupt(self, self.now)?;
        self.check_silence();
        Ok("-".into())
    }

    /// Time without the actor, in which something else points the range sensor and finishes the
    /// job of the planner.
    fn pause(&mut self, moved: f64) {
        self.search = None;
        for tick in 0..AWAY / 10 {
            self.check_silence();
            self.tick();
            if tick == AWAY / 20 {
                self.point(Angle::from_deg(45.0), self.now);
            }
        }
        self.motion.y = self.motion.y + Length::from_si(moved);
    }

    fn check_silence(&self) {
        assert_eq!(self.command, (0.0, 0.0), "T1: it drives");
        assert!(self.signals.last().is_none_or(|last| *last == (false, None)), "T1: it signals");
    }

    /// Checks that the drive is not commanded suddenly. Steering may react at once.
    fn check_gains(&self, moved: f64) {
        let steers = self.command.0 != 0.0 || moved != 0.0;
        let gentle = self.gains.0 < 0.02 && (steers || self.gains.1 < 0.1);
        assert!(gentle, "T3: {:?}", self.gains);
    }
}
