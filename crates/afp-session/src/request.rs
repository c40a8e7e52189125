//! What comes from outside while a plan runs: writes, presses, faults, and what only tests ask for.

use std::collections::BTreeMap;

use afp_core::devices::{ControlId, FaultId};
use afp_core::trace::{ComponentId, Outcome};
use afp_core::{Duration, EntryId, Instant, Value, WriteError};

use crate::sample::Pose2;

/// How long `afpc run` lets a plan run in virtual time by default.
pub const DEFAULT_UNTIL: Duration = Duration::from_secs(60);

/// How long something is held down unless anybody says otherwise.
pub const HOLD: Duration = Duration::from_millis(200);

/// Something that comes from outside. Ids or names in it are held as `H` says.
#[derive(Clone, Debug, PartialEq)]
pub enum RequestOf<H: Held> {
    /// An entry is written: before the start an `in` entry at once, later with the next step.
    Write(H::Entry, H::Value),
    /// A control is held down until it is let go, or let go, whoever holds it.
    Press(H::Control, bool),
    /// A control is held down for a while, and then for as long as somebody else holds it.
    Hold(H::Control, Duration),
    /// Something breaks for a while, [`Duration::MAX`] for good: by that amount in SI units, or by as much as the robot's
    /// devices declare.
    Break(H::Fault, Option<f64>, Duration),
    /// A component of a loaded plan reports an outcome at its next poll, whatever it sees. The outputs that come with it
    /// have positions among the template's.
    Inject(H::Component, H::Outcome, Vec<(u16, H::Value)>),
    /// An actor, those of a sub-plan, or all of them do nothing from their next start on.
    Idle(Option<H::Component>),
    /// Something of a simulated world is put somewhere by hand: metres, radians.
    Put(Put, Pose2),
    /// The plan ends as interrupted.
    Stop,
}

/// How a request holds what it is about.
pub trait Held {
    /// An entry of the plan itself.
    type Entry;
    /// A value of an entry or of an output.
    type Value;
    /// A control of a device.
    type Control;
    /// A fault of a device.
    type Fault;
    /// A component of the plan.
    type Component;
    /// A state or event of a component.
    type Outcome;
}

/// By ids of a session.
#[derive(Clone, Debug, PartialEq)]
pub struct ByIds;

impl Held for ByIds {
    type Entry = EntryId;
    type Value = Value;
    type Control = ControlId;
    type Fault = FaultId;
    type Component = ComponentId;
    type Outcome = Outcome;
}

/// A request that a session takes.
pub type Request = RequestOf<ByIds>;

/// What is put somewhere by hand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Put {
    /// The robot.
    Robot,
    /// A thing of the world, by its name.
    Thing(String),
    /// Something that was not there: its shape, of those that the robot's kind knows.
    New(String),
}

/// The number of a request of a session, in the order in which they were made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RequestId(pub u64);

/// Why a request cannot be met.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RequestError {
    /// Its instant is over.
    #[error("{} s is over: it is {} s", .at.as_secs_f64(), .now.as_secs_f64())]
    Over {
        /// The instant.
        at: Instant,
        /// The time now.
        now: Instant,
    },
    /// The plan has ended.
    #[error("the plan has ended")]
    Ended,
    /// There is no such control.
    #[error("the robot has no such control")]
    NoControl,
    /// There is no such fault.
    #[error("the robot has no such fault")]
    NoFault,
    /// There cannot be so much of a fault.
    #[error("{0} is out of range")]
    Amount(f64),
    /// The robot's devices declare it, but this robot has it not.
    #[error("this robot has no '{0}'")]
    Lacks(&'static str),
    /// The robot does not do that.
    #[error("the robot does not do that")]
    Refused,
    /// There is no thing of that name in the world, or it cannot be moved.
    #[error("nothing called '{0}' can be moved")]
    NoThing(String),
    /// There is nothing of that shape to put somewhere.
    #[error("nothing has the shape '{0}'")]
    NoShape(String),
    /// So many things were dropped already, as many as can be.
    #[error("{0} things were dropped, and no more can be; move one of them here")]
    Full(usize),
    /// There is no room at that place: what stands there.
    #[error("'{0}' stands there")]
    Occupied(String),
    /// That place is none.
    #[error("that place is not in the world")]
    Nowhere,
    /// The entry does not take the value.
    #[error("{0}")]
    Write(#[source] WriteError),
    /// A component of that path is not being polled, so it cannot report anything.
    #[error("'{0}' is not active")]
    NotActive(String),
    /// A component of that path has not yet reported what it was made to report before.
    #[error("'{0}' already has something to report")]
    Reports(String),
    /// There is no such actor or sub-plan.
    #[error("there is no such actor")]
    NoElement,
    /// The plan has no such entry, or its entry has no such value.
    #[error("the plan has no such entry '{0}'")]
    NoEntry(String),
    /// There is no such state or event.
    #[error("there is no '{0}'")]
    NoOutcome(String),
    /// The plan was compiled into the program: its components report what they see, and nothing else.
    #[error("the plan was compiled in; only a loaded one can be made to report")]
    Compiled,
}

/// What is still to come, by time; at one time as it was made.
#[derive(Clone, Debug)]
pub(crate) struct Requests {
    waiting: BTreeMap<(Instant, RequestId), Waiting>,
    made: u64,
    /// When the next one is due.
    next: Instant,
}

/// A request that has not been reported to observers.
#[derive(Clone, Debug)]
pub(crate) struct Waiting {
    pub(crate) request: Request,
    /// Whether it has been done already.
    pub(crate) done: bool,
}

impl Default for Requests {
    fn default() -> Self {
        Requests { waiting: BTreeMap::new(), made: 0, next: Instant::MAX }
    }
}

impl Requests {
    pub(crate) fn add(&mut self, at: Instant, request: Request) -> RequestId {
        self.insert(at, Waiting { request, done: false })
    }

    /// Adds one that is done already, to be reported to observers.
    pub(crate) fn add_done(&mut self, at: Instant, request: Request) {
        self.insert(at, Waiting { request, done: true });
    }

    fn insert(&mut self, at: Instant, waiting: Waiting) -> RequestId {
        let id = RequestId(self.made);
        self.made += 1;
        self.waiting.insert((at, id), waiting);
        self.next = self.next.min(at);
        id
    }

    /// What is still to come, in order.
    pub(crate) fn pending(&self) -> impl Iterator<Item = (Instant, RequestId, &Request)> {
        self.waiting.iter().map(|((at, id), waiting)| (*at, *id, &waiting.request))
    }

    #[inline]
    pub(crate) fn next(&self) -> Instant {
        self.next
    }

    pub(crate) fn take_due(&mut self, now: Instant) -> Option<(Instant, RequestId, Waiting)> {
        let first = self.waiting.first_entry().filter(|first| first.key().0 <= now)?;
        let ((at, id), waiting) = first.remove_entry();
        self.next = self.waiting.keys().next().map_or(Instant::MAX, |(at, _)| *at);
        Some((at, id, waiting))
    }
}
