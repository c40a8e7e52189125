//! The ids of a running plan's components and entries, the outcomes that edges start from, and the names of all.

use core::fmt;

use afp_types::{ComponentKind, EntryId, EntryKind, Measured, Quantity};

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
    pub fn range_text(&self) -> Option<impl fmt::Display + use<'a>> {
        self.range.map(|(least, greatest)| Range { least, greatest, unit: self.unit })
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

/// The range of an entry.
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

/// A bound beside another one, as people write it; to the last digit where that is not all of it.
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
