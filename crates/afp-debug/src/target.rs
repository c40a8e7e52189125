//! The interface between the adapter and a run: inspect it, let it go on, change it.

use std::sync::Arc;

use afp_core::devices::DeviceRow;
use afp_core::trace::{ComponentId, TraceHash};
use afp_core::{Duration, Instant};
use afp_session::{Figures, Pose2, Request, RunEvent, Stimulus};

use crate::program::Program;
use crate::sensed::Sensed;
use crate::state::State;
use crate::text::Line;

/// A plan that runs, or that ran.
pub trait Target {
    fn program(&self) -> &Arc<Program>;

    /// What is the case.
    fn state(&self) -> &State;

    fn now(&self) -> Instant;

    /// How many steps the scheduler has made.
    fn steps(&self) -> u64;

    /// Whether all of it is over, so that it can be looked at and not changed.
    fn is_recorded(&self) -> bool {
        false
    }

    /// What is strange about the run, to be said before it begins.
    fn warnings(&self) -> &[String] {
        &[]
    }

    /// Whether going back begins at a copy of the run; else it begins at the start.
    fn is_kept(&self) -> bool {
        true
    }

    /// Lets time pass up to the next instant at which something is done, but not beyond `limit`, and tells what
    /// happened, in order, with what is the case then.
    ///
    /// # Errors
    /// The plan cannot start: why, and what to do.
    fn advance(
        &mut self,
        limit: Instant,
        report: &mut dyn FnMut(&Happened, &State),
    ) -> Result<Advance, String>;

    /// Goes back or ahead: what was asked for in the meantime is done again, and the trace is the same.
    ///
    /// # Errors
    /// It cannot be done: why.
    fn seek(&mut self, to: Position) -> Result<(), String>;

    /// What was the case after all that was done up to an instant that is over; the run stays where it is.
    ///
    /// # Errors
    /// It cannot be told: why.
    fn past(&mut self, at: Instant) -> Result<State, String>;

    /// What the robot touches, empty where only that it touches something is known; none where it touches nothing, or
    /// does not signal that.
    fn contact(&self) -> Option<String> {
        None
    }

    /// Where the robot is, for pictures; none where it does not signal that.
    fn pose(&self) -> Option<Pose2> {
        None
    }

    /// Outlines of what moves in the robot's world, by the ids of a scene; none where the robot does not signal that.
    fn moving(&self) -> Vec<(String, Vec<[f64; 2]>)> {
        Vec::new()
    }

    /// What the robot's signals say now that a plan may know, in the order of its devices, without pictures.
    fn sensed(&self) -> Vec<Sensed> {
        Vec::new()
    }

    /// The last picture of the robot's camera, where it has one: width, height, and a byte for each of red, green and blue.
    fn picture(&self) -> Option<(u32, u32, Vec<u8>)> {
        None
    }

    /// What the run came to so far; nothing where that is not known.
    fn figures(&self) -> Figures {
        Figures::default()
    }

    /// How many deadlines were missed so far.
    fn misses(&self) -> u64 {
        0
    }

    /// The hash of the trace so far, as `afpc run` gives it; none of a log.
    fn trace(&self) -> Option<TraceHash> {
        None
    }

    /// What came from outside so far, and what is to come, with the instants.
    fn requests(&self) -> Vec<(Instant, Stimulus)> {
        Vec::new()
    }

    /// Writes an entry of the outermost plan as people write it; gives the value.
    ///
    /// # Errors
    /// Why it cannot be written.
    fn set(&mut self, entry: &str, text: &str) -> Result<String, String>;

    /// The devices of the robot.
    fn devices(&self) -> &'static [DeviceRow];

    /// Asks for something so much later than now; gives the instant at which it comes, which is the next one where the
    /// step of that is over. What was asked for later than now before a step back is forgotten.
    ///
    /// # Errors
    /// Why it cannot be.
    fn ask(&mut self, later: Duration, request: Request) -> Result<Instant, String>;

    /// Makes a component report a state or an event at its next poll.
    ///
    /// # Errors
    /// Why it cannot.
    fn fire(&mut self, component: ComponentId, outcome: &str) -> Result<(), String>;

    /// Makes the plan end here and now, and the robot stop.
    fn stop(&mut self, report: &mut dyn FnMut(&Happened, &State));
}

/// Something that happened.
#[derive(Clone, Debug)]
pub struct Happened {
    pub event: RunEvent,
    /// The same as a line of the trace, without its time; empty for what comes from outside.
    pub text: String,
}

impl Happened {
    /// Something that happened, with its line.
    pub fn new(event: RunEvent) -> Happened {
        let text = Line(&event).to_string();
        Happened { event, text }
    }
}

/// How far time has passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Advance {
    /// The run goes on.
    On,
    /// The limit has been reached.
    Limit,
    Ended,
}

/// Where a run can be taken to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Position {
    /// Right after so many steps of the scheduler.
    Step(u64),
    /// After all that is done up to an instant.
    At(Instant),
}
