//! What a plan tells about itself while it runs.
//!
//! A step hands each record to a [`Sink`]. Records speak in ids; [`Names`] turns them into the
//! paths that people know. With [`NoTrace`] the compiler removes all of it.

mod display;
mod hash;

use afp_types::{Duration, EntryId, Instant, ValueRef};

use crate::fault::{Detail, Fault};

pub use afp_types::{ComponentKind, EntryKind};
pub use display::Line;
pub use hash::TraceHash;

/// A component of a running plan, sub-plans unfolded: 0 is the outermost plan itself, then its
/// elements and supervisors, then those of its sub-plans.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ComponentId(pub u32);

/// An entry of a running plan, sub-plans unfolded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TraceEntryId(pub u32);

impl From<EntryId> for TraceEntryId {
    /// The entry of the outermost plan, whose entries come first.
    fn from(entry: EntryId) -> Self {
        TraceEntryId(entry.0.into())
    }
}

/// Where an edge starts: a state or event of a component, or what every element or supervisor has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Outcome {
    /// A state or event that the template declares, by position. Of a sub-plan 0 is `OK` and 1 `Interrupted`.
    Declared(u16),
    /// The `Error` of an element.
    Error,
    /// The `DeadlineMissed` of a supervisor.
    DeadlineMissed,
}

impl Outcome {
    /// The number that stands for the outcome in logs.
    pub const fn number(self) -> u16 {
        match self {
            Outcome::Declared(position) => position,
            Outcome::Error => u16::MAX - 1,
            Outcome::DeadlineMissed => u16::MAX,
        }
    }

    /// The outcome of a number from [`Outcome::number`].
    pub const fn from_number(number: u16) -> Self {
        match number {
            u16::MAX => Outcome::DeadlineMissed,
            position if position == Outcome::Error.number() => Outcome::Error,
            position => Outcome::Declared(position),
        }
    }
}

/// The states or events that a component's template declares, with their names.
pub fn declared<N: Names + ?Sized>(
    names: &N,
    id: ComponentId,
) -> impl Iterator<Item = (Outcome, &str)> {
    let outcomes = (0..u16::MAX).map(Outcome::Declared);
    let named = outcomes.map(move |outcome| (outcome, names.outcome(id, outcome)));
    named.take_while(|(_, name)| !name.is_empty())
}

/// How a plan ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// By a state or a computation.
    Ok,
    /// By an event, a missed deadline or a stop request.
    Interrupted,
    /// By a fault.
    Error(Fault),
}

/// Who wrote or stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Author {
    /// A component that ended the activity.
    Component(ComponentId),
    /// Whoever runs the plan.
    Outside,
}

/// What a supervisor's poll said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Nothing.
    Clear,
    /// This event.
    Event(Outcome),
    /// It failed.
    Fault(Fault),
}

/// Why a deadline was missed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The poll began too late to keep it.
    LateRelease,
    /// The poll took too long.
    LongPoll,
}

/// One thing that happened. The order within a step is fixed: outside commit; for each polled
/// supervisor its poll and its miss, and where its event may resume, event, commits and computations
/// until resumed; event; interrupts, innermost first; commits, inner first; starts of supervisors;
/// diverted or started.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Record<'a> {
    /// A step was asked for an earlier time than the one before; it ran at the time of that one.
    ClockWentBack {
        /// The time asked for.
        asked: Instant,
    },
    /// Somebody asked the plan to stop.
    StopRequested,
    /// A component is about to report an outcome that is not its own: whoever tests the plan put it
    /// there.
    Injected {
        /// The supervisor or actor.
        component: ComponentId,
        /// The event or state.
        outcome: Outcome,
    },
    /// A supervisor was polled.
    Polled {
        /// The supervisor.
        supervisor: ComponentId,
        /// What it said.
        verdict: Verdict,
    },
    /// A supervisor's poll ended after its deadline, or releases passed without a poll.
    Missed {
        /// The supervisor.
        supervisor: ComponentId,
        /// Time after the deadline; zero when only earlier releases were skipped.
        lateness: Duration,
        /// Why.
        cause: Cause,
        /// Releases that passed entirely.
        skipped: u64,
    },
    /// An event was taken.
    Event {
        /// The supervisor.
        supervisor: ComponentId,
        /// The event.
        event: Outcome,
        /// The element of the same plan that is active or being entered, which decides where the event leads.
        element: ComponentId,
    },
    /// An event was not taken, because it leads to the element that is already active or being
    /// entered.
    AlreadyThere {
        /// The supervisor.
        supervisor: ComponentId,
        /// The event.
        event: Outcome,
        /// That element.
        element: ComponentId,
    },
    /// An actor or sub-plan was interrupted.
    Interrupted {
        /// The element.
        element: ComponentId,
    },
    /// An element reached a state; for a sub-plan 0 is `OK` and 1 `Interrupted`.
    Finished {
        /// The element.
        element: ComponentId,
        /// The state.
        state: Outcome,
    },
    /// An entry changed; all entries of one commit follow one another.
    Committed {
        /// Who wrote it.
        author: Author,
        /// The entry.
        entry: TraceEntryId,
        /// Its value before.
        old: ValueRef<'a>,
        /// Its value now.
        new: ValueRef<'a>,
    },
    /// An input that a component is about to start with.
    Input {
        /// The component.
        component: ComponentId,
        /// The port, by position among the template's input ports.
        port: u16,
        /// What it reads.
        value: ValueRef<'a>,
    },
    /// A component started.
    Started {
        /// The component.
        component: ComponentId,
    },
    /// An event taken in the look replaced the start of an element.
    Diverted {
        /// The element that did not start.
        element: ComponentId,
        /// The supervisor that saw a reason.
        supervisor: ComponentId,
        /// The event.
        event: Outcome,
    },
    /// An element goes on after an event that led to `resume`.
    Resumed {
        /// The element, active or being entered.
        element: ComponentId,
        /// The supervisor whose event it was.
        supervisor: ComponentId,
    },
    /// A component failed.
    Faulted {
        /// The component.
        component: ComponentId,
        /// Why.
        fault: Fault,
        /// The value that it is about, where it is about one.
        detail: Option<Detail>,
    },
    /// A plan ended; a sub-plan goes by the id of its element.
    Ended {
        /// The plan.
        plan: ComponentId,
        /// How.
        ending: Ending,
    },
}

/// Receives records. Called within a step: it must neither block nor allocate where the step
/// must not.
///
/// ```
/// use afp_core::Instant;
/// use afp_core::trace::{Record, Sink};
///
/// /// Counts the faults of components.
/// struct Faults(u32);
///
/// impl Sink for Faults {
///     fn record(&mut self, _: Instant, record: &Record<'_>) {
///         self.0 += u32::from(matches!(record, Record::Faulted { .. }));
///     }
/// }
/// # let mut faults = Faults(0);
/// # faults.record(Instant::ZERO, &Record::StopRequested);
/// # assert_eq!(faults.0, 0);
/// ```
pub trait Sink {
    /// Whether records are wanted at all; `false` removes the code that makes them.
    const ENABLED: bool = true;

    /// Takes one record; `at` is the time of the step.
    fn record(&mut self, at: Instant, record: &Record<'_>);
}

/// No trace, no cost.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoTrace;

impl Sink for NoTrace {
    const ENABLED: bool = false;

    fn record(&mut self, _: Instant, _: &Record<'_>) {}
}

/// Hands each record to a function.
///
/// ```
/// use afp_core::Instant;
/// use afp_core::trace::{Observe, Record};
/// let mut starts = 0;
/// let sink = Observe(|_: Instant, record: &Record<'_>| {
///     starts += u32::from(matches!(record, Record::Started { .. }));
/// });
/// # let _ = sink;
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Observe<F>(
    /// The function: time of the step, record.
    pub F,
);

impl<F: FnMut(Instant, &Record<'_>)> Sink for Observe<F> {
    fn record(&mut self, at: Instant, record: &Record<'_>) {
        (self.0)(at, record);
    }
}

impl<S: Sink + ?Sized> Sink for &mut S {
    const ENABLED: bool = S::ENABLED;

    fn record(&mut self, at: Instant, record: &Record<'_>) {
        (**self).record(at, record);
    }
}

/// Each record goes to both.
impl<A: Sink, B: Sink> Sink for (A, B) {
    const ENABLED: bool = A::ENABLED || B::ENABLED;

    fn record(&mut self, at: Instant, record: &Record<'_>) {
        self.0.record(at, record);
        self.1.record(at, record);
    }
}

/// A component as people know it. All names are those of the text.
#[derive(Clone, Copy, Debug)]
pub struct ComponentName<'a> {
    /// Dotted path from the outermost plan (`patrol.avoid.turnLeft.touch`); the plan's own name
    /// for id 0.
    pub path: &'a str,
    /// What it is.
    pub kind: ComponentKind,
    /// Name of its template, of its plan for a sub-plan.
    pub template: &'a str,
}

/// An entry as people know it.
#[derive(Clone, Copy, Debug)]
pub struct EntryName<'a> {
    /// Dotted path from the outermost plan.
    pub path: &'a str,
    /// Who may set it.
    pub kind: EntryKind,
    /// Its type as in the text (`length`, `int`, `Side`).
    pub ty: &'a str,
    /// The SI unit of its values, empty for plain numbers and everything else.
    pub unit: &'a str,
    /// Least and greatest value in SI units, where it has a range.
    pub range: Option<(f64, f64)>,
}

/// A port of a component as people know it, with what is bound to it.
#[derive(Clone, Copy, Debug, Default)]
pub struct PortName<'a> {
    /// Its name.
    pub name: &'a str,
    /// The name of its type where that is an enum or an object type; empty else.
    pub ty: &'a str,
    /// The SI unit of its values, empty for plain numbers and everything else.
    pub unit: &'a str,
    /// Least and greatest value in SI units, where it has a range; of an output that of its entry.
    pub range: Option<(f64, f64)>,
    /// The entry that an output is bound to, by its dotted path.
    pub entry: Option<&'a str>,
    /// Where what is bound stands in the text; `None` where nothing is written.
    pub place: Option<TextPlace<'a>>,
}

/// A place in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextPlace<'a> {
    /// The file, seen from the folder of the main plan's file.
    pub file: &'a str,
    /// The line, from 1.
    pub line: u32,
    /// The column in characters, from 1.
    pub column: u32,
}

/// An edge of an element that holds, while that is active or being entered, instead of one of a global supervisor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reaction<'a> {
    /// The supervisor.
    pub supervisor: ComponentId,
    /// The event.
    pub outcome: Outcome,
    /// Where it leads, as [`Names::target`] says it.
    pub target: &'a str,
}

impl<'a> Reaction<'a> {
    /// A row of a generated plan: an event by position, none for a missed deadline.
    #[doc(hidden)]
    pub const fn new(supervisor: ComponentId, event: Option<u16>, target: &'a str) -> Self {
        let outcome = match event {
            Some(position) => Outcome::Declared(position),
            None => Outcome::DeadlineMissed,
        };
        Reaction { supervisor, outcome, target }
    }
}

impl ComponentName<'_> {
    /// What an unknown id is called.
    pub const NONE: ComponentName<'static> =
        ComponentName { path: "", kind: ComponentKind::Actor, template: "" };
}

impl EntryName<'_> {
    /// What an unknown id is called.
    pub const NONE: EntryName<'static> =
        EntryName { path: "", kind: EntryKind::Var, ty: "", unit: "", range: None };
}

impl<'a> EntryName<'a> {
    /// Its range as text, where it has one: `from 0 m/s to 1 m/s`.
    pub fn range_text(&self) -> Option<impl core::fmt::Display + use<'a>> {
        self.range.map(|(least, greatest)| display::Range { least, greatest, unit: self.unit })
    }
}

/// The names behind the ids of a plan. Unknown ids have empty names.
pub trait Names {
    /// How many components there are.
    fn components(&self) -> u32;
    /// A component.
    fn component(&self, id: ComponentId) -> ComponentName<'_>;
    /// A state or event of a component.
    fn outcome(&self, id: ComponentId, outcome: Outcome) -> &str;
    /// Where an outcome leads: an element's name, `terminate`, `fail`, `ignore`, `resume`; empty where unconnected.
    /// Elements may lead events of global supervisors elsewhere, see [`Names::target_at`].
    fn target(&self, id: ComponentId, outcome: Outcome) -> &str;
    /// The `n`-th edge of an element that holds instead of one of a global supervisor; `None` behind the last.
    fn reaction(&self, element: ComponentId, n: u16) -> Option<Reaction<'_>>;
    /// Where an outcome leads while an element of the same plan is active or being entered.
    fn target_at(&self, id: ComponentId, outcome: Outcome, element: ComponentId) -> &str {
        let mut reactions = (0..u16::MAX).map_while(|n| self.reaction(element, n));
        let here = reactions.find(|each| (each.supervisor, each.outcome) == (id, outcome));
        here.map_or_else(|| self.target(id, outcome), |reaction| reaction.target)
    }
    /// An input port of a component.
    fn input(&self, id: ComponentId, port: u16) -> &str;
    /// An input port of a component with its bounds; without them where nobody knows.
    fn input_port(&self, id: ComponentId, port: u16) -> PortName<'_> {
        PortName { name: self.input(id, port), ..PortName::default() }
    }
    /// The text of a value of an input port whose type is an enum; empty for others.
    fn input_choice(&self, _: ComponentId, _: u16, _: u16) -> &str {
        ""
    }
    /// An output port of a component, with the bounds of the entry that it is bound to.
    fn output_port(&self, _: ComponentId, _: u16) -> PortName<'_> {
        PortName::default()
    }
    /// One more than the position of the last output port that is bound.
    fn outputs(&self, _: ComponentId) -> u16 {
        0
    }
    /// Where the initial value of an entry stands in the text.
    fn initial(&self, _: TraceEntryId) -> Option<TextPlace<'_>> {
        None
    }
    /// How many entries there are.
    fn entries(&self) -> u32;
    /// An entry.
    fn entry(&self, id: TraceEntryId) -> EntryName<'_>;
    /// Whether an entry holds an object, which no text says: of all that is no built-in type enums alone have texts.
    fn holds_object(&self, id: TraceEntryId) -> bool {
        let EntryName { ty, unit, .. } = self.entry(id);
        let built_in = matches!(ty, "" | "bool" | "int" | "float" | "string") || !unit.is_empty();
        !built_in && self.choice(id, 0).is_empty()
    }
    /// The text of an enum entry's value; empty for other entries.
    fn choice(&self, id: TraceEntryId, value: u16) -> &str;
}
