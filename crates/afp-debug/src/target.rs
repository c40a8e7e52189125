//! The interface between the adapter and a run: inspect, advance and change it.

use std::sync::Arc;

use afp_core::devices::DeviceRow;
use afp_core::trace::{ComponentId, TraceHash};
use afp_core::{Duration, Instant};
use afp_session::{Figures, Pose2, Request, RunEvent, Stimulus, Tripwire};

use crate::program::Program;
use crate::sensed::Sensed;
use crate::state::State;
use crate::text::Line;

/// A running or recorded plan.
pub trait Target {
    fn program(&self) -> &Arc<Program>;

    fn state(&self) -> &State;

    fn now(&self) -> Instant;

    /// The number of scheduler steps so far.
    fn steps(&self) -> u64;

    /// Whether the run is a recording, which cannot change.
    fn is_recorded(&self) -> bool {
        false
    }

    /// Whether time passes by itself: a robot drives, and it is held instead of paused.
    fn is_live(&self) -> bool {
        false
    }

    /// Replaces the places where a live run is held.
    ///
    /// # Errors
    /// The reason.
    fn watch(&mut self, tripwire: Option<Box<dyn Tripwire>>) -> Result<(), String> {
        let _ = tripwire;
        Ok(())
    }

    /// Warnings to show before the run.
    fn warnings(&self) -> &[String] {
        &[]
    }

    /// Whether going back starts at a copy of the run, and not at its beginning.
    fn is_kept(&self) -> bool {
        true
    }

    /// Advances to the next instant with activity, but not beyond `limit`, and reports the events
    /// in order, each with its state.
    ///
    /// # Errors
    /// The reason and an action if the plan cannot start.
    fn advance(
        &mut self,
        limit: Instant,
        report: &mut dyn FnMut(&Happened, &State),
    ) -> Result<Advance, String>;

    /// Goes back or ahead. Requests in between are repeated, and the trace is the same.
    ///
    /// # Errors
    /// The reason.
    fn seek(&mut self, to: Position) -> Result<(), String>;

    /// Returns the state after an earlier instant; the run keeps its position.
    ///
    /// # Errors
    /// The reason.
    fn past(&mut self, at: Instant) -> Result<State, String>;

    /// The object that the robot touches. An empty string means an unknown object; `None` means no
    /// contact, or no such signal.
    fn contact(&self) -> Option<String> {
        None
    }

    /// The robot's pose for pictures; `None` if it has no such signal.
    fn pose(&self) -> Option<Pose2> {
        None
    }

    /// Outlines of moving things, by the ids of a scene; `None` without such a signal.
    fn moving(&self) -> Vec<(String, Vec<[f64; 2]>)> {
        Vec::new()
    }

    /// The current signals that a plan may use, in device order and without pictures.
    fn sensed(&self) -> Vec<Sensed> {
        Vec::new()
    }

    /// The last camera picture: width, height, and a byte for each of red, green and blue.
    fn picture(&self) -> Option<(u32, u32, Vec<u8>)> {
        None
    }

    /// The results of the run so far; empty if unknown.
    fn figures(&self) -> Figures {
        Figures::default()
    }

    /// The number of missed deadlines so far.
    fn misses(&self) -> u64 {
        0
    }

    /// The hash of the trace so far, as in `afpc run`; `None` for a log.
    fn trace(&self) -> Option<TraceHash> {
        None
    }

    /// Past and future requests, with their instants.
    fn requests(&self) -> Vec<(Instant, Stimulus)> {
        Vec::new()
    }

    /// Writes an entry of the outermost plan, given with its unit, and returns the value.
    ///
    /// # Errors
    /// The reason.
    fn set(&mut self, entry: &str, text: &str) -> Result<String, String>;

    fn devices(&self) -> &'static [DeviceRow];

    /// Requests a stimulus after a delay and returns its instant. This is the next instant if the
    /// current step is complete. A step back forgets later requests.
    ///
    /// # Errors
    /// The reason.
    fn ask(&mut self, later: Duration, request: Request) -> Result<Instant, String>;

    /// Repeats a stimulus of another run of the plan at its instant.
    ///
    /// # Errors
    /// The reason.
    fn repeat(&mut self, at: Instant, what: &Stimulus) -> Result<(), String>;

    /// Makes a component report a state or event at its next poll.
    ///
    /// # Errors
    /// The reason.
    fn fire(&mut self, component: ComponentId, outcome: &str) -> Result<(), String>;

    /// Ends the plan now, and stops the robot.
    fn stop(&mut self, report: &mut dyn FnMut(&Happened, &State));
}

/// An event of a run.
#[derive(Clone, Debug)]
pub struct Happened {
    pub event: RunEvent,
    /// The trace line without its time; empty for a stimulus.
    pub text: String,
}

impl Happened {
    /// Makes an event with its trace line.
    pub fn new(event: RunEvent) -> Happened {
        let text = Line(&event).to_string();
        Happened { event, text }
    }
}

/// How far time has advanced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Advance {
    /// The run continues.
    On,
    /// The limit has been reached.
    Limit,
    Ended,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Position {
    /// After this number of scheduler steps.
    Step(u64),
    /// After all activity up to an instant.
    At(Instant),
}
