//! Ids of components and entries, outcomes, and their names.

use core::fmt;

use afp_types::{ComponentKind, EntryId, EntryKind, Measured, Quantity};

/// A component of a running plan with its sub-plans: 0 is the outermost plan, then its elements and
/// supervisors, then those of its sub-plans.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ComponentId(pub u32);

/// An entry of a running plan with its sub-plans.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TraceEntryId(pub u32);

impl From<EntryId> for TraceEntryId {
    /// The outermost plan's entries come first.
    fn from(entry: EntryId) -> Self {
        TraceEntryId(entry.0.into())
    }
}

/// The start of an edge: a declared state or event, or the implicit outcome of every element or
/// supervisor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Outcome {
    /// A state or event that the template declares, by position. For a sub-plan 0 is `OK` and 1
    /// `Interrupted`.
    Declared(u16),
    /// The `Error` of an element.
    Error,
    /// The `DeadlineMissed` of a supervisor.
    DeadlineMissed,
}

impl Outcome {
    /// The number of the outcome in logs.
    pub const fn number(self) -> u16 {
        match self {
            Outcome::Declared(position) => position,
            Outcome::Error => u16::MAX - 1,
            Outcome::DeadlineMissed => u16::MAX,
        }
    }

    /// The inverse of [`Outcome::number`].
    pub const fn from_number(number: u16) -> Self {
        match number {
            u16::MAX => Outcome::DeadlineMissed,
            position if position == Outcome::Error.number() => Outcome::Error,
            position => Outcome::Declared(position),
        }
    }
}

/// The declared states or events of a component, with their names.
pub fn declared<N: Names + ?Sized>(
    names: &N,
    id: ComponentId,
) -> impl Iterator<Item = (Outcome, &str)> {
    let outcomes = (0..u16::MAX).map(Outcome::Declared);
    let named = outcomes.map(move |outcome| (outcome, names.outcome(id, outcome)));
    named.take_while(|(_, name)| !name.is_empty())
}

/// Names of a component, from the source.
#[derive(Clone, Copy, Debug)]
pub struct ComponentName<'a> {
    /// Dotted path from the outermost plan (`patrol.avoid.turnLeft.touch`); for id 0 the plan's
    /// name.
    pub path: &'a str,
    /// The kind.
    pub kind: ComponentKind,
    /// Name of its template, or of its plan for a sub-plan.
    pub template: &'a str,
}

/// Names of an entry, from the source.
#[derive(Clone, Copy, Debug)]
pub struct EntryName<'a> {
    /// Dotted path from the outermost plan.
    pub path: &'a str,
    /// The kind, which decides its writers.
    pub kind: EntryKind,
    /// Its type in the source (`length`, `int`, `Side`).
    pub ty: &'a str,
    /// The SI unit; empty for plain numbers and other types.
    pub unit: &'a str,
    /// Minimum and maximum in SI units, if it has a range.
    pub range: Option<(f64, f64)>,
}

/// A port of a component, with its binding.
#[derive(Clone, Copy, Debug, Default)]
pub struct PortName<'a> {
    /// Its name.
    pub name: &'a str,
    /// Name of an enum or object type; otherwise empty.
    pub ty: &'a str,
    /// The SI unit; empty for plain numbers and other types.
    pub unit: &'a str,
    /// Minimum and maximum in SI units, if it has a range; for an output, the range of its entry.
    pub range: Option<(f64, f64)>,
    /// Dotted path of the entry that an output is bound to.
    pub entry: Option<&'a str>,
    /// Source position of the binding; `None` if nothing is written.
    pub place: Option<TextPlace<'a>>,
}

/// A position in a source file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextPlace<'a> {
    /// The file, relative to the folder of the main plan's file.
    pub file: &'a str,
    /// The line, from 1.
    pub line: u32,
    /// The column in characters, from 1.
    pub column: u32,
}

/// An edge of an element that overrides an edge of a global supervisor while the element is active
/// or being entered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reaction<'a> {
    /// The supervisor.
    pub supervisor: ComponentId,
    /// The event.
    pub outcome: Outcome,
    /// The target, as in [`Names::target`].
    pub target: &'a str,
}

impl<'a> Reaction<'a> {
    /// A row of a generated plan: an event by position, or `None` for a missed deadline.
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
    /// The name of an unknown id.
    pub const NONE: ComponentName<'static> =
        ComponentName { path: "", kind: ComponentKind::Actor, template: "" };
}

impl EntryName<'_> {
    /// The name of an unknown id.
    pub const NONE: EntryName<'static> =
        EntryName { path: "", kind: EntryKind::Var, ty: "", unit: "", range: None };
}

impl<'a> EntryName<'a> {
    /// Formats the range, if any: `from 0 m/s to 1 m/s`.
    pub fn range_text(&self) -> Option<impl fmt::Display + use<'a>> {
        self.range.map(|(least, greatest)| Range { least, greatest, unit: self.unit })
    }
}

/// Names of a plan's ids. Unknown ids have empty names.
pub trait Names {
    /// Number of components.
    fn components(&self) -> u32;
    /// A component.
    fn component(&self, id: ComponentId) -> ComponentName<'_>;
    /// A state or event of a component.
    fn outcome(&self, id: ComponentId, outcome: Outcome) -> &str;
    /// The target of an outcome: an element's name, `terminate`, `fail`, `ignore`, `resume`; empty
    /// if unconnected. Elements may override targets of global supervisors, see
    /// [`Names::target_at`].
    fn target(&self, id: ComponentId, outcome: Outcome) -> &str;
    /// The `n`-th edge of an element that overrides an edge of a global supervisor; `None` after
    /// the last.
    fn reaction(&self, element: ComponentId, n: u16) -> Option<Reaction<'_>>;
    /// The target of an outcome while an element of the same plan is active or being entered.
    fn target_at(&self, id: ComponentId, outcome: Outcome, element: ComponentId) -> &str {
        let mut reactions = (0..u16::MAX).map_while(|n| self.reaction(element, n));
        let here = reactions.find(|each| (each.supervisor, each.outcome) == (id, outcome));
        here.map_or_else(|| self.target(id, outcome), |reaction| reaction.target)
    }
    /// An input port of a component.
    fn input(&self, id: ComponentId, port: u16) -> &str;
    /// An input port with its range, if known.
    fn input_port(&self, id: ComponentId, port: u16) -> PortName<'_> {
        PortName { name: self.input(id, port), ..PortName::default() }
    }
    /// The name of an enum value of an input port; empty for other types.
    fn input_choice(&self, _: ComponentId, _: u16, _: u16) -> &str {
        ""
    }
    /// An output port, with the range of its entry.
    fn output_port(&self, _: ComponentId, _: u16) -> PortName<'_> {
        PortName::default()
    }
    /// The position of the last bound output port plus one.
    fn outputs(&self, _: ComponentId) -> u16 {
        0
    }
    /// Source position of an entry's initial value.
    fn initial(&self, _: TraceEntryId) -> Option<TextPlace<'_>> {
        None
    }
    /// Source position of a state of a declared computation whose formulas can fail.
    fn state(&self, _: ComponentId, _: u16) -> Option<TextPlace<'_>> {
        None
    }
    /// Number of entries.
    fn entries(&self) -> u32;
    /// An entry.
    fn entry(&self, id: TraceEntryId) -> EntryName<'_>;
    /// Whether an entry holds an object, which no string represents: of the types that are not
    /// built in, only enums have strings.
    fn holds_object(&self, id: TraceEntryId) -> bool {
        let EntryName { ty, unit, .. } = self.entry(id);
        let built_in = matches!(ty, "" | "bool" | "int" | "float" | "string") || !unit.is_empty();
        !built_in && self.choice(id, 0).is_empty()
    }
    /// The name of an enum entry's value; empty for other entries.
    fn choice(&self, id: TraceEntryId, value: u16) -> &str;
}

struct Range<'a> {
    least: f64,
    greatest: f64,
    unit: &'a str,
}

impl fmt::Display for Range<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bound = |value, other| Bound { value, other, unit: self.unit };
        let [least, greatest] = [self.least, self.greatest];
        write!(f, "from {} to {}", bound(least, greatest), bound(greatest, least))
    }
}

/// A bound next to the other bound; prints every digit if the short form is inexact.
struct Bound<'a> {
    value: f64,
    other: f64,
    unit: &'a str,
}

impl fmt::Display for Bound<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Bound { value, other, unit } = *self;
        match Measured::exact(value, unit) {
            Some(shown) => shown.beside(Measured::new(other, unit)).fmt(f),
            None => Quantity { value, unit }.fmt(f),
        }
    }
}
