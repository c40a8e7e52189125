//! Requests from outside to a running plan: writes, presses, faults, and some for tests only.

use std::collections::BTreeMap;

use afp_core::devices::{ControlId, FaultId};
use afp_core::trace::{ComponentId, Outcome};
use afp_core::{Duration, EntryId, Instant, Release, Value, WriteError};

use crate::sample::Pose2;

/// The default limit of `afpc run`, in virtual time.
pub const DEFAULT_UNTIL: Duration = Duration::from_secs(60);

/// The default duration of a hold.
pub const HOLD: Duration = Duration::from_millis(200);

/// A request from outside, with ids or names as `H` says.
#[derive(Clone, Debug, PartialEq)]
pub enum RequestOf<H: Held> {
    /// Writes an entry: an `in` entry at once before the start, later any entry with the next step.
    Write(H::Entry, H::Value),
    /// Presses a control until it is released, or releases it for all that hold it.
    Press(H::Control, bool),
    /// Presses a control for a duration; other holds of it may last longer.
    Hold(H::Control, Duration),
    /// Activates a fault for a duration ([`Duration::MAX`]: without end), by an amount in SI units
    /// or by the default of the devices.
    Break(H::Fault, Option<f64>, Duration),
    /// Makes a component of a loaded plan report an outcome at its next poll. The outputs have the
    /// positions of the template's outputs.
    Inject(H::Component, H::Outcome, Vec<(u16, H::Value)>),
    /// Makes an actor, the actors of a sub-plan, or all actors do nothing from their next start on.
    Idle(Option<H::Component>),
    /// Places an object of a simulated world: metres, radians.
    Put(Put, Pose2),
    /// Holds the plan: its active element is suspended, or interrupted, until the release.
    Pause,
    /// Releases a held plan.
    Release(Release),
    /// Ends the plan as interrupted.
    Stop,
}

/// The form in which a request refers to its objects.
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

/// References by ids of a session.
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

/// A request for a session.
pub type Request = RequestOf<ByIds>;

/// An object to place in the world.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Put {
    /// The robot.
    Robot,
    /// A thing of the world, by name.
    Thing(String),
    /// A new thing, by a shape that the kind of robot offers.
    New(String),
}

/// The number of a request in a session, in order of creation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RequestId(pub u64);

/// The reason why a session refuses a request.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RequestError {
    /// Its time has passed.
    #[error("{} s is in the past: the time is {} s", .at.as_secs_f64(), .now.as_secs_f64())]
    Over {
        /// The time of the request.
        at: Instant,
        /// The present time.
        now: Instant,
    },
    /// The plan has ended.
    #[error("the plan has ended")]
    Ended,
    /// The control does not exist.
    #[error("the robot has no such control")]
    NoControl,
    /// The fault does not exist.
    #[error("the robot has no such fault")]
    NoFault,
    /// The amount of the fault is out of range.
    #[error("{0} is out of range")]
    Amount(f64),
    /// The devices declare it, but this robot lacks it.
    #[error("this robot has no '{0}'")]
    Lacks(&'static str),
    /// The robot does not support it.
    #[error("the robot does not support that")]
    Refused,
    /// The world has no movable thing of that name.
    #[error("nothing called '{0}' can be moved")]
    NoThing(String),
    /// The shape does not exist.
    #[error("nothing has the shape '{0}'")]
    NoShape(String),
    /// The number of new things has reached its limit.
    #[error("{0} objects were dropped, which is the limit; move one of them here")]
    Full(usize),
    /// The place is occupied, by the thing of that name.
    #[error("'{0}' is at that place")]
    Occupied(String),
    /// The pose is not finite or is outside the world.
    #[error("that place is outside of the world")]
    Nowhere,
    /// The entry refuses the value.
    #[error("{0}")]
    Write(#[source] WriteError),
    /// The component of that path is not polled now, so it cannot report.
    #[error("'{0}' is not active")]
    NotActive(String),
    /// The component of that path has not yet reported the previous injected outcome.
    #[error("'{0}' already has something to report")]
    Reports(String),
    /// The actor or sub-plan does not exist.
    #[error("there is no such actor")]
    NoElement,
    /// The plan has no such entry, or the entry no such value.
    #[error("the plan has no such entry '{0}'")]
    NoEntry(String),
    /// The state or event does not exist.
    #[error("there is no '{0}'")]
    NoOutcome(String),
    /// The plan was compiled into the program, so no outcome can be injected.
    #[error(
        "only the components of a loaded plan can be made to report, and this plan is compiled"
    )]
    Compiled,
    /// The plan was compiled into the program, so a debugger cannot hold it.
    #[error("a compiled plan cannot be held; 'afpc run' interprets the plan and can hold it")]
    NotHeld,
}

/// Pending requests, by time and then by order of creation.
#[derive(Clone, Debug)]
pub(crate) struct Requests {
    waiting: BTreeMap<(Instant, RequestId), Waiting>,
    made: u64,
    /// The time of the next one.
    next: Instant,
}

/// A request that observers have not seen yet.
#[derive(Clone, Debug)]
pub(crate) struct Waiting {
    pub(crate) request: Request,
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

    /// Adds a request that is already done, for the report to observers.
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

    /// Pending requests, in order.
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
