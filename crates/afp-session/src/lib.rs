//! Drives a plan on any robot.
//!
//! A [`Session`] drives one plan on one [`Platform`](afp_core::Platform). All programs that run
//! plans use a session. They differ in the [`Gate`] (may time pass?), the [`Observer`]s (what
//! happened?) and the [`Request`]s (input from outside), but the course of a run is always the
//! same. A session is compiled for its plan and robot; its interface is a `dyn` [`AnySession`],
//! with one virtual call for each instant.
//!
//! At an instant:
//!
//! 1. The platform has advanced to it.
//! 2. Samples, for measures and observers, on a separate grid; they cannot affect the plan.
//! 3. Requests that are due, by time and then by order of creation; before the start too. Faults
//!    are a set: after each begin or end, the robot gets the complete set. A control is pressed
//!    until the last hold ends, or until a release ends all holds.
//! 4. The step, if it is due.
//! 5. Its records in order to measures, observers and the hash; then [`Observer::after_step`].
//!
//! Time passes up to the earliest of: the plan's next step (not before the platform is ready for
//! it), the next request, the next sample, the limit, the end of the rest that follows an ending.
//!
//! This crate uses no wall clock, file, thread or terminal.
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod any;
mod counts;
mod datum;
mod event;
mod faults;
mod figures;
mod hardware;
mod holds;
mod loop_times;
mod not_set;
mod observer;
mod opened;
mod queue;
mod recipe;
mod record;
mod remote;
mod request;
mod robot;
mod robots;
mod sample;
mod sampling;
mod session;
mod stimulus;
mod track;
mod units;
mod watch;
mod world;

pub use any::AnySession;
pub use counts::{Counts, Usage};
pub use datum::{Datum, Holder};
pub use event::{
    Done, EndingKind, EventAt, EventKind, Facts, FaultText, Miss, NamedComponent, NamedOutcome,
    OUTSIDE, Requested, RunEvent, author,
};
pub use faults::{Active, Faults};
pub use figures::{Figure, FigureValue, Figures, Span};
pub use hardware::{Hardware, LastResort, NoWorld, STALL, Settings};
pub use loop_times::{Histogram, LoopTimes};
pub use not_set::{NotSet, refusal, what_it_takes};
pub use observer::{Applied, Gate, Go, NamedRecord, Next, Observer, Open, Sampling, View};
pub use opened::Opened;
#[cfg(feature = "load")]
pub use opened::{Opener, hardware, only_hardware};
pub use queue::{QueueReader, QueueWriter, queue};
pub use recipe::{Build, Recipe, RecipeError, TextFile};
pub use record::{Keep, Kept, OwnedRecord};
pub use remote::{Asked, Busy, Remote, Steering, Tripwire, Wire, remote};
pub use request::{
    ByIds, DEFAULT_UNTIL, HOLD, Held, Put, Request, RequestError, RequestId, RequestOf,
};
pub use robot::{ControlOf, Droppable, FaultOf, Measure, Refused, Robot, Simulated, read_signal};
pub use robots::{AnyRobot, Kind, SessionError, kind};
#[cfg(feature = "load")]
pub use robots::{Loader, simulated};
pub use sample::{FILM, Image, OwnedSample, Pose2, Ranging, SampleRef, Shape, Transform, frames};
pub use sampling::Samples;
pub use session::{SAMPLE, Session};
pub use stimulus::{ByNames, NameWithUnit, Report, Stimulus};
pub use track::{Mark, Track, Waypoint};
pub use units::some_units;
pub use watch::Watch;
pub use world::{AnyWorld, Drawing, Outlines, Patch, Thing, World, WorldError};

/// Names that macros use in other crates.
#[doc(hidden)]
pub mod __private {
    pub use afp_core;
}
