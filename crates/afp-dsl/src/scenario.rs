//! Scenarios: tests of a plan, checked and resolved.
//!
//! A scenario puts the robot into a world, applies stimuli at instants, and states expectations.
//! Everything is resolved as in the static graph: components and entries have the numbers of
//! [`crate::unfold`], values are in SI units, times in nanoseconds. Controls, faults and signals
//! have the names of their toolboxes.

use std::fmt;
use std::sync::Arc;

use crate::graph::{Goal, Graph};
use crate::toolbox::SignalType;
use crate::types::Constant;
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::source::Span;

pub use afp_types::Comparison;

/// Default duration of a scenario, nanoseconds.
pub const DEFAULT_UNTIL: u64 = 60_000_000_000;

#[derive(Clone, Debug)]
pub struct Scenario {
    /// Its name; for one of several seeds or worlds, with these appended.
    pub name: String,
    pub span: Span,
    /// Its plan as the main plan.
    pub graph: Arc<Graph>,
    pub plan_file: String,
    /// The file of the world, as written; `None` for the plan's world.
    pub world: Option<String>,
    /// The robot's start, if it differs from the world's.
    pub robot: Option<Start>,
    /// The noise seed.
    pub seed: u64,
    /// Values of `in` entries, by position.
    pub set: Vec<(u16, Constant)>,
    /// Instants known at run time, each after the moment that it is relative to.
    pub moments: Vec<Moment>,
    /// Stimuli in order of time from the start or from a moment; at one instant in source order.
    pub stimuli: Vec<Stimulus>,
    /// Expectations in source order.
    pub expectations: Vec<Expectation>,
    /// Time limit, nanoseconds.
    pub until: u64,
}

impl Scenario {
    /// A run of a plan in its own world without stimuli and expectations, for a duration in
    /// nanoseconds.
    pub fn quiet(
        name: impl Into<String>,
        graph: Arc<Graph>,
        plan_file: impl Into<String>,
        until: u64,
    ) -> Scenario {
        Scenario {
            name: name.into(),
            span: graph.main().span,
            graph,
            plan_file: plan_file.into(),
            world: None,
            robot: None,
            seed: 0,
            set: Vec::new(),
            moments: Vec::new(),
            stimuli: Vec::new(),
            expectations: Vec::new(),
            until,
        }
    }
}

/// A scenario with errors, or with an invalid plan.
#[derive(Clone, Debug)]
pub struct InvalidScenario {
    pub name: String,
    pub span: Span,
    /// The name of its plan, as written.
    pub plan: String,
    /// The errors, at least one.
    pub errors: Diagnostics,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// Metres.
    pub x: f64,
    /// Metres.
    pub y: f64,
    /// Radians.
    pub heading: f64,
}

/// An instant of a run, defined by the first time of a claim.
#[derive(Clone, Debug)]
pub struct Moment {
    pub claim: Claim,
    /// The moment from which it counts; the run's start if `None`.
    pub from: Option<MomentId>,
    /// Time limit of the run after it, nanoseconds.
    pub until: Option<u64>,
    /// The line as written, without its relative lines.
    pub text: String,
    pub span: Span,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MomentId(pub u16);

#[derive(Clone, Debug)]
pub struct Stimulus {
    /// The origin of its time; the run's start if `None`.
    pub from: Option<MomentId>,
    /// Its time, nanoseconds.
    pub at: u64,
    pub action: Action,
    pub text: String,
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Writes an entry from outside.
    Set(u16, Constant),
    /// Holds a control down, for this many nanoseconds or for the robot's default.
    Press(Part, Option<u64>),
    /// Releases a control.
    Release(Part),
    /// Injects a fault, for this many nanoseconds or permanently.
    Fail(Failure, Option<u64>),
    /// Injects an event of a supervisor or a state of an element.
    Inject(Injection),
    /// Makes an actor, those of a sub-plan, or all of them idle from their next start on.
    Idle(Option<u32>),
}

/// A control, a fault or a signal of a device, by names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    pub device: String,
    pub name: String,
}

/// A fault with its amount.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    pub fault: Part,
    /// In SI units; defaults to the declaration's.
    pub amount: Option<f64>,
}

/// A part of a composite signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Field {
    /// Of a pose: metres.
    X,
    /// Of a pose: metres.
    Y,
    /// Of a pose: radians.
    Heading,
    /// Of a range: metres; missing without an echo.
    Distance,
}

/// An injected outcome.
#[derive(Clone, Debug, PartialEq)]
pub struct Injection {
    pub component: u32,
    /// Its event or state; the special one is `Error` of an actor, `DeadlineMissed` of a
    /// supervisor.
    pub outcome: Outcome,
    /// Its outputs, by position in the template, each of its port's type.
    pub outputs: Vec<(u16, Constant)>,
}

#[derive(Clone, Debug)]
pub struct Expectation {
    pub claim: Claim,
    pub wanted: Wanted,
    /// The origin of its window; the run's start if `None`.
    pub from: Option<MomentId>,
    pub window: Window,
    pub text: String,
    pub span: Span,
}

/// How often a claim must hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// At some instant of the window.
    Once,
    /// At every instant of the window.
    Always,
    /// At no instant of the window.
    Never,
    /// This often in the window; for momentary claims.
    Times(u32),
}

/// A time interval, nanoseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// Its first instant.
    pub from: u64,
    /// Its last instant.
    pub to: u64,
}

/// A condition or event.
#[derive(Clone, Debug, PartialEq)]
pub enum Claim {
    Transition {
        /// The left element.
        from: u32,
        /// The target.
        to: Goal,
        /// The state or event of the edge.
        by: Option<Cause>,
    },
    /// A state is reached or an event is taken.
    Happens(Cause),
    Active(u32),
    /// The element is set aside, and a handler runs.
    Suspended(u32),
    /// A comparison of values of one type; an unset entry, or a signal without a measurement,
    /// equals nothing.
    Compare {
        left: Subject,
        comparison: Comparison,
        right: Operand,
    },
    /// The plan has not ended.
    Running,
    End(Option<EndCause>),
    Interrupt(u32),
    Commit {
        /// The entry; any if `None`.
        of: Option<u32>,
        /// The writing element, supervisor or plan; any if `None`.
        by: Option<u32>,
    },
}

/// A changing value that can be compared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Subject {
    Entry(u32),
    /// A signal of the robot, or a part of it.
    Signal(Part, Option<Field>),
}

#[derive(Clone, Debug, PartialEq)]
pub enum Operand {
    Value(Constant),
    /// The value of another subject at that time.
    Subject(Subject),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cause {
    pub component: u32,
    /// Its state or event; any if `None`.
    pub outcome: Option<Outcome>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Of the template, by position.
    Declared(u16),
    /// `Error` of an element, `DeadlineMissed` of a supervisor.
    Special,
}

/// The cause or the kind of a plan's end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EndCause {
    /// The outcome whose edge leads to `terminate`, or an unconnected `Error`.
    Cause(Cause),
    /// `OK`
    Ok,
    /// `Interrupted`
    Interrupted,
    /// `Error`
    Error,
}

impl Part {
    pub(crate) fn new(device: &str, name: &str) -> Part {
        Part { device: device.to_owned(), name: name.to_owned() }
    }
}

/// `wheels.slip`
impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.device, self.name)
    }
}

impl Field {
    pub fn of(ty: SignalType) -> &'static [Field] {
        match ty {
            SignalType::Pose => &[Field::X, Field::Y, Field::Heading],
            SignalType::Range => &[Field::Distance],
            _ => &[],
        }
    }

    pub fn word(self) -> &'static str {
        match self {
            Field::X => "x",
            Field::Y => "y",
            Field::Heading => "heading",
            Field::Distance => "distance",
        }
    }
}

impl MomentId {
    pub fn index(self) -> usize {
        usize::from(self.0)
    }
}

impl Window {
    /// The window shifted by a time.
    #[must_use]
    pub fn behind(self, by: u64) -> Window {
        Window { from: self.from.saturating_add(by), to: self.to.saturating_add(by) }
    }

    pub fn contains(self, at: u64) -> bool {
        (self.from..=self.to).contains(&at)
    }
}

impl Claim {
    /// Whether it is momentary.
    pub fn is_event(&self) -> bool {
        matches!(
            self,
            Claim::Transition { .. }
                | Claim::Happens(_)
                | Claim::End(_)
                | Claim::Interrupt(_)
                | Claim::Commit { .. }
        )
    }
}
