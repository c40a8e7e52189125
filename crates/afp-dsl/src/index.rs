//! What every name of a compilation means: the one answer to "where is this declared", "who uses
//! it", "what is this" and "what did you mean".
//!
//! The check records what a name means at the moment at which it resolves it; nothing here resolves
//! anything. So the index knows as much about a broken text as the check does: a name that means
//! nothing is in it as [`Meaning::Unknown`], one in text that could not even be read as
//! [`Meaning::Unread`].
//!
//! It covers plan files and the toolboxes that the compilation could use. Places are spans of
//! [`Compiled::sources`](crate::Compiled::sources), from which the texts of names come.

mod build;
mod declare;
mod record;
mod unread;

use crate::graph::EntryKind;
use crate::outline::ComponentKind;
use crate::toolbox::TemplateKind;
use afp_syntax::source::Span;

pub(crate) use build::build;
pub(crate) use declare::{Declared, of_template, of_toolbox};
pub(crate) use record::{Found, Lookup, Meanings, Recorder};
pub(crate) use unread::unread;

/// What names mean, where things are declared, and who refers to them.
#[derive(Clone, Debug, Default)]
pub struct Index {
    /// All names in the order of their places.
    names: Vec<Name>,
    /// In the order of the places of their names.
    definitions: Vec<Definition>,
    /// Places in `names`: the references to the first definition, those to the second one, and so on.
    uses: Vec<u32>,
    /// Where in `uses` those of each definition begin, and behind them its end.
    first_uses: Vec<u32>,
    /// What ambiguous names may mean.
    several: Vec<Vec<DefinitionId>>,
}

/// A definition of an [`Index`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct DefinitionId(pub u32);

/// A name as it stands in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Name {
    /// Its place; of a file behind `use` with the quotes.
    pub span: Span,
    pub meaning: Meaning,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
// A tag as wide as what it carries: copies are of whole words.
#[repr(u32)]
pub enum Meaning {
    Declares(DefinitionId),
    /// It refers to that definition.
    Refers(DefinitionId),
    /// It is a binding by itself, `goal` for `goal = goal`: the entry and the port of that name.
    Both {
        /// The entry that is read or written.
        entry: DefinitionId,
        /// The port that it is bound to.
        port: DefinitionId,
    },
    /// It may mean any of several definitions, see [`Index::candidates`].
    Ambiguous(Candidates),
    /// A file that is used.
    File(u16),
    /// It needs no declaration.
    Word(Word),
    /// Nothing that is known here.
    Unknown,
    /// It stands in text that could not be read.
    Unread,
}

/// What an ambiguous name may mean, see [`Index::candidates`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Candidates(u32);

/// Something that has a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Definition {
    pub kind: DefinitionKind,
    /// Its own name.
    pub name: Span,
    /// The whole of it, without comments around it.
    pub span: Span,
    /// What it is declared in: the plan of an element, the element of a local supervisor, the enum of
    /// a value, the table of a column, the template of a port, the toolbox of a template. `None` for what stands in a plan
    /// file itself.
    pub owner: Option<DefinitionId>,
    /// What it is made from: the template or plan of an element or supervisor, the toolbox behind a
    /// short name, the plan of a scenario, the enum or object type of an entry or port.
    pub made_from: Option<DefinitionId>,
    /// Its `///` lines.
    pub doc: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DefinitionKind {
    Toolbox,
    /// A short name of a toolbox, behind `as`.
    Alias,
    /// A template of a toolbox.
    Template(TemplateKind),
    /// An input port of a template.
    Input,
    /// An output port of a template.
    Output,
    /// A state of a template.
    State,
    /// An event of a template.
    Event,
    /// An object type of a toolbox.
    Object,
    /// A device of a toolbox; the robot as a whole is named by the word `robot`.
    Device,
    /// A control of a device.
    Control,
    /// A fault of a device.
    Fault,
    /// How much there is of a fault.
    Amount,
    /// A signal of a device.
    Signal,
    Enum,
    /// A value of an enum.
    Value,
    Table,
    /// A column of a table, which is an output of what reads it.
    Column,
    Plan,
    /// An entry of a plan; `in` and `out` entries are the ports of its uses as a sub-plan.
    Entry(EntryKind),
    /// An element or supervisor of a plan.
    Component(ComponentKind),
    /// A scenario; its name is a text.
    Scenario,
}

/// A name that needs no declaration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Word {
    /// The state `OK` of a sub-plan or plan.
    Ok,
    /// The state `Interrupted` of a sub-plan or plan.
    Interrupted,
    /// The edge `Error` of an element, or the end of a plan.
    Error,
    /// The edge `DeadlineMissed` of a supervisor.
    DeadlineMissed,
    /// The target `terminate`.
    Terminate,
    /// The target `fail`.
    Fail,
    /// The target `ignore`.
    Ignore,
    /// The target `resume`.
    Resume,
    /// A built-in type, such as `length`.
    Type,
    /// `true` or `false`
    Truth,
    /// A function of formulas, such as `min`.
    Function,
    /// What a template commands, behind `uses`, where its toolbox declares no such device.
    Resource,
    /// A fault that every sensor has, such as `frozen`, in a scenario.
    Fault,
    /// How much there is of such a fault, such as `time`.
    Amount,
    /// A part of a signal that has several, such as `x` of a pose.
    Field,
    /// Every actor, behind `idle`.
    All,
    /// The supervisor that reports the second of two exclusive events.
    Other,
}

impl DefinitionId {
    /// The index, to be used on [`Index::definitions`].
    pub fn index(self) -> usize {
        self.0 as usize
    }

    fn new(index: usize) -> DefinitionId {
        DefinitionId(u32::try_from(index).unwrap_or(u32::MAX))
    }
}

impl Meaning {
    /// The definition that is declared or referred to; of a binding that is a name alone the entry.
    pub fn definition(self) -> Option<DefinitionId> {
        match self {
            Meaning::Declares(id) | Meaning::Refers(id) | Meaning::Both { entry: id, .. } => {
                Some(id)
            }
            _ => None,
        }
    }

    /// All definitions that are referred to.
    fn referred(self) -> impl Iterator<Item = DefinitionId> {
        let (first, second) = match self {
            Meaning::Refers(id) => (Some(id), None),
            Meaning::Both { entry, port } => (Some(entry), Some(port)),
            _ => (None, None),
        };
        first.into_iter().chain(second)
    }
}

impl Index {
    /// The name that covers a byte of a file; between two names that touch, the second one.
    pub fn at(&self, file: u16, offset: u32) -> Option<Name> {
        let behind =
            self.names.partition_point(|name| (name.span.file, name.span.start) <= (file, offset));
        let name = *self.names.get(behind.checked_sub(1)?)?;
        (name.span.file == file && offset <= name.span.end).then_some(name)
    }

    /// The name that stands exactly there.
    pub fn name(&self, span: Span) -> Option<Name> {
        let index = self.names.binary_search_by_key(&span, |name| name.span).ok()?;
        Some(self.names[index])
    }

    /// The names of a file in order.
    pub fn names_in(&self, file: u16) -> &[Name] {
        let first = self.names.partition_point(|name| name.span.file < file);
        let end = self.names.partition_point(|name| name.span.file <= file);
        &self.names[first..end]
    }

    /// A definition; ids come from the same index.
    pub fn definition(&self, id: DefinitionId) -> &Definition {
        &self.definitions[id.index()]
    }

    /// The definition whose own name stands there.
    pub fn declared_at(&self, name: Span) -> Option<DefinitionId> {
        let found = self.definitions.binary_search_by_key(&name, |known| known.name).ok()?;
        Some(DefinitionId::new(found))
    }

    /// All definitions, in the order of the places of their names, with their ids.
    pub fn definitions(&self) -> impl Iterator<Item = (DefinitionId, &Definition)> {
        (0..).map(DefinitionId).zip(&self.definitions)
    }

    /// The definitions of a file in order.
    pub fn definitions_in(&self, file: u16) -> impl Iterator<Item = (DefinitionId, &Definition)> {
        let first = self.definitions.partition_point(|known| known.name.file < file);
        let end = self.definitions.partition_point(|known| known.name.file <= file);
        (first..end).map(DefinitionId::new).zip(&self.definitions[first..end])
    }

    /// What is declared directly in a definition, in order.
    pub fn members(
        &self,
        owner: DefinitionId,
    ) -> impl Iterator<Item = (DefinitionId, &Definition)> {
        let home = self.definition(owner);
        // In a broken file, items may stand above the toolbox's own line.
        let first = self.definitions.partition_point(|known| match home.kind {
            DefinitionKind::Toolbox => known.name.file < home.name.file,
            _ => known.name <= home.name,
        });
        let all = (first..).map(DefinitionId::new).zip(&self.definitions[first..]);
        // A toolbox owns the whole file, everything else what lies within.
        let within = move |known: &Definition| match home.kind {
            DefinitionKind::Toolbox => known.name.file == home.name.file,
            _ => home.span.contains(known.name),
        };
        all.take_while(move |(_, known)| within(known))
            .filter(move |(_, known)| known.owner == Some(owner))
    }

    /// The places that refer to a definition, in order, its declaration not among them.
    pub fn references(&self, id: DefinitionId) -> impl Iterator<Item = Span> {
        let [first, end] = [0, 1].map(|next| self.first_uses[id.index() + next] as usize);
        self.uses[first..end].iter().map(|name| self.names[*name as usize].span)
    }

    /// What of some kinds can be named at a place of a plan file, in the order of the definitions: plans, enums and
    /// tables of the file and of those that it uses, what its toolboxes declare, and in a plan or its
    /// scenario the entries, elements and global supervisors.
    pub fn visible(
        &self,
        file: u16,
        offset: u32,
        fits: impl Fn(DefinitionKind) -> bool,
    ) -> Vec<DefinitionId> {
        let mut visible = Vec::new();
        let mut add = |id, known: &Definition| {
            if fits(known.kind) {
                visible.push(id);
            }
        };
        let mut files = vec![file];
        for name in self.names_in(file) {
            match name.meaning {
                Meaning::File(used) => files.push(used),
                Meaning::Refers(id) if self.definition(id).kind == DefinitionKind::Toolbox => {
                    self.members(id).for_each(|(member, known)| add(member, known));
                }
                _ => {}
            }
        }
        let is_outer = |kind| {
            use DefinitionKind::{Enum, Plan, Table, Template};
            matches!(kind, Plan | Enum | Table | Template(_))
        };
        for (id, known) in files.iter().flat_map(|seen| self.definitions_in(*seen)) {
            if known.owner.is_none() && is_outer(known.kind) {
                add(id, known);
            }
        }
        let place = Span { file, start: offset, end: offset };
        let around = self.definitions_in(file).filter(|(_, known)| known.span.contains(place));
        for (id, known) in around {
            let plan = match known.kind {
                DefinitionKind::Plan => Some(id),
                DefinitionKind::Scenario => known.made_from,
                _ => None,
            };
            let members = plan.into_iter().flat_map(|plan| self.members(plan));
            members.for_each(|(member, known)| add(member, known));
        }
        visible.sort_unstable();
        visible.dedup();
        visible
    }

    /// What an ambiguous name may mean.
    pub fn candidates(&self, candidates: Candidates) -> &[DefinitionId] {
        self.several.get(candidates.0 as usize).map_or(&[], Vec::as_slice)
    }
}
