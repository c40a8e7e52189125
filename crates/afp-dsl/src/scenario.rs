//! Scenarios: tests of a plan, checked and resolved.
//!
//! A scenario puts the robot into a world, lets things happen at instants, and says what is expected.
//! Everything is resolved as in the static graph: components and entries go by the numbers of
//! [`crate::unfold`], values are in SI units, times in nanoseconds. What is pressed, fails or signals is the
//! robot's: it goes by the names that toolboxes declare.

use std::fmt;
use std::sync::Arc;

use crate::graph::{Goal, Graph};
use crate::toolbox::SignalType;
use crate::types::Constant;
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::source::Span;

pub use afp_types::Comparison;

/// How long a scenario lasts unless it says otherwise, nanoseconds.
pub const DEFAULT_UNTIL: u64 = 60_000_000_000;

#[derive(Clone, Debug)]
pub struct Scenario {
    /// Its name; where it is over several seeds or worlds, with those of this run behind it.
    pub name: String,
    /// The name in the text.
    pub span: Span,
    /// The plan that it is for, as the one that runs.
    pub graph: Arc<Graph>,
    /// The file with the plan, as it was read.
    pub plan_file: String,
    /// The file of the world, as written; without one it is that of the plan.
    pub world: Option<String>,
    /// Where the robot starts, unless it is where the world says.
    pub robot: Option<Start>,
    /// The seed of all noise.
    pub seed: u64,
    /// Values of `in` entries, by position.
    pub set: Vec<(u16, Constant)>,
    /// Instants that are known once they have come, those that others count from before them.
    pub moments: Vec<Moment>,
    /// What happens, in order of time from the start or from one moment; at one instant as written.
    pub stimuli: Vec<Stimulus>,
    /// What is expected, as written.
    pub expectations: Vec<Expectation>,
    /// When it ends at the latest, nanoseconds.
    pub until: u64,
}

impl Scenario {
    /// A run of a plan in its own world in which nothing happens and nothing is expected, for so
    /// many nanoseconds.
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

/// A scenario that cannot be run as it is written, or as its plan is now.
#[derive(Clone, Debug)]
pub struct InvalidScenario {
    pub name: String,
    /// The name in the text.
    pub span: Span,
    /// The name of the plan that it is for, as written.
    pub plan: String,
    /// What is wrong with it, at least one error.
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

/// An instant of a run by what holds or happens then for the first time.
#[derive(Clone, Debug)]
pub struct Moment {
    pub claim: Claim,
    /// From when on: the start of the run, or another moment.
    pub from: Option<MomentId>,
    /// How long after it the run ends at the latest, nanoseconds.
    pub until: Option<u64>,
    /// The line as written, without those that count from it.
    pub text: String,
    /// The claim in the text.
    pub span: Span,
}

/// A moment by its position in its scenario.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MomentId(pub u16);

/// Something that happens.
#[derive(Clone, Debug)]
pub struct Stimulus {
    /// What its time counts from; the start of the run without one.
    pub from: Option<MomentId>,
    /// When, nanoseconds.
    pub at: u64,
    pub action: Action,
    pub text: String,
    /// The line in the text.
    pub span: Span,
}

/// What happens.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// An entry is written from outside.
    Set(u16, Constant),
    /// A control is held down, for so many nanoseconds or for as long as the robot's own
    /// presses last.
    Press(Part, Option<u64>),
    /// It is let go.
    Release(Part),
    /// A device fails, for so many nanoseconds or for good.
    Fail(Failure, Option<u64>),
    /// A supervisor reports an event, or an element reaches a state, without a reason.
    Inject(Injection),
    /// An actor, those of a sub-plan, or all of them do nothing from their next start on.
    Idle(Option<u32>),
}

/// A control, a fault or a signal of a device, by names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    pub device: String,
    pub name: String,
}

/// A fault, and how much of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    pub fault: Part,
    /// In SI units; without it as much as the declaration says.
    pub amount: Option<f64>,
}

/// A part of a signal that is no single value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Field {
    /// Of a pose: metres.
    X,
    /// Of a pose: metres.
    Y,
    /// Of a pose: radians.
    Heading,
    /// Of a range: metres; without an echo there is none.
    Distance,
}

/// An outcome that does not come from its component.
#[derive(Clone, Debug, PartialEq)]
pub struct Injection {
    pub component: u32,
    /// Its event or state; the special one is `Error` of an actor, `DeadlineMissed` of a supervisor.
    pub outcome: Outcome,
    /// The outputs that come with it, by position among the template's, each of its port's type.
    pub outputs: Vec<(u16, Constant)>,
}

#[derive(Clone, Debug)]
pub struct Expectation {
    pub claim: Claim,
    /// How often it has to hold.
    pub wanted: Wanted,
    /// What its window counts from; the start of the run without one.
    pub from: Option<MomentId>,
    pub window: Window,
    pub text: String,
    /// The line in the text.
    pub span: Span,
}

/// How often a claim has to hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// At some instant of the window.
    Once,
    /// At every instant of the window.
    Always,
    /// At no instant of the window.
    Never,
    /// So often in the window; for what happens at an instant.
    Times(u32),
}

/// A stretch of time, nanoseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// Its first instant.
    pub from: u64,
    /// Its last instant.
    pub to: u64,
}

/// What may hold or happen.
#[derive(Clone, Debug, PartialEq)]
pub enum Claim {
    /// An edge is taken.
    Transition {
        /// The element that is left.
        from: u32,
        /// Where the edge leads.
        to: Goal,
        /// The state or event that it belongs to.
        by: Option<Cause>,
    },
    /// A state is reached or an event is taken.
    Happens(Cause),
    /// An element or sub-plan is active.
    Active(u32),
    /// Something compares so with something of its type; an unset entry, or a signal that measured nothing, with
    /// nothing.
    Compare {
        left: Subject,
        comparison: Comparison,
        right: Operand,
    },
    /// The plan has not ended.
    Running,
    End(Option<EndCause>),
    /// An actor or sub-plan is interrupted.
    Interrupt(u32),
    Commit {
        /// The entry; any without one.
        of: Option<u32>,
        /// The element, supervisor or plan that writes it; anybody without one.
        by: Option<u32>,
    },
}

/// What changes while a plan runs and can be compared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Subject {
    Entry(u32),
    /// A signal of the robot, or a part of one.
    Signal(Part, Option<Field>),
}

/// What something is compared with.
#[derive(Clone, Debug, PartialEq)]
pub enum Operand {
    Value(Constant),
    /// What another one is at that time.
    Subject(Subject),
}

/// A component, or one of its outcomes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cause {
    pub component: u32,
    /// Its state or event; any without one.
    pub outcome: Option<Outcome>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// One of the template, by position.
    Declared(u16),
    /// `Error` of an element, `DeadlineMissed` of a supervisor.
    Special,
}

/// What ends a plan, or how it ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EndCause {
    /// The outcome whose edge leads to `terminate`, or the `Error` that leads nowhere.
    Cause(Cause),
    /// `OK`
    Ok,
    /// `Interrupted`
    Interrupted,
    /// `Error`
    Error,
}

impl Part {
    /// Something of a device.
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
    /// The parts of signals of a type.
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
    /// The same so much later.
    #[must_use]
    pub fn behind(self, by: u64) -> Window {
        Window { from: self.from.saturating_add(by), to: self.to.saturating_add(by) }
    }

    /// Whether an instant lies in it.
    pub fn contains(self, at: u64) -> bool {
        (self.from..=self.to).contains(&at)
    }
}

impl Claim {
    /// Whether it happens at an instant rather than holds for a while.
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
