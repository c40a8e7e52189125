//! The meaning of every name of a compilation: where it is declared, who uses it, and its
//! likely meanings.
//!
//! The check records the meaning of a name when it resolves the name; this module resolves nothing.
//! So the index covers invalid files as far as the check does. A name without a meaning is
//! [`Meaning::Unknown`]; a name in unreadable text is [`Meaning::Unread`].
//!
//! The index covers plan files and the toolboxes that the compilation could use. Places are spans
//! of [`Compiled::sources`](crate::Compiled::sources), which have the texts of the names.

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

/// The meanings of names, the places of declarations, and their uses.
#[derive(Clone, Debug, Default)]
pub struct Index {
    /// All names, in the order of their places.
    names: Vec<Name>,
    /// In the order of the places of their names.
    definitions: Vec<Definition>,
    /// Indices into `names`: the references to the first definition, then those to the second, and
    /// so on.
    uses: Vec<u32>,
    /// The index in `uses` of each definition's first reference, then the length of `uses`.
    first_uses: Vec<u32>,
    /// The candidates of ambiguous names.
    several: Vec<Vec<DefinitionId>>,
}

/// A definition of an [`Index`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct DefinitionId(pub u32);

/// A name in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Name {
    /// Its place. The path of a used file includes the quotes.
    pub span: Span,
    pub meaning: Meaning,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
// The tag is as wide as its content, so that copies are whole words.
#[repr(u32)]
pub enum Meaning {
    Declares(DefinitionId),
    /// A reference to a definition.
    Refers(DefinitionId),
    /// A short binding, `goal` for `goal = goal`: the entry and the port of that name.
    Both {
        /// The entry that is read or written.
        entry: DefinitionId,
        /// The port that it is bound to.
        port: DefinitionId,
    },
    /// One of several definitions, see [`Index::candidates`].
    Ambiguous(Candidates),
    /// A used file.
    File(u16),
    /// A built-in name.
    Word(Word),
    /// An unknown name.
    Unknown,
    /// A name in unreadable text.
    Unread,
}

/// The candidates of an ambiguous name, see [`Index::candidates`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Candidates(u32);

/// Something that has a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Definition {
    pub kind: DefinitionKind,
    pub name: Span,
    /// Its span, without surrounding comments.
    pub span: Span,
    /// Its owner: the plan of an element, the element of a local supervisor, the enum of a value,
    /// the table of a column, the template of a port, the toolbox of a template. `None` for the
    /// items of a plan file.
    pub owner: Option<DefinitionId>,
    /// Its source: the template or plan of an element or supervisor, the toolbox of a short name,
    /// the plan of a scenario, the enum or object type of an entry or port.
    pub made_from: Option<DefinitionId>,
    /// Its `///` lines.
    pub doc: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DefinitionKind {
    Toolbox,
    /// A short name of a toolbox, after `as`.
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
    /// A device of a toolbox. The word `robot` names the whole robot.
    Device,
    /// A control of a device.
    Control,
    /// A fault of a device.
    Fault,
    /// The amount of a fault.
    Amount,
    /// A signal of a device.
    Signal,
    Enum,
    Value,
    Table,
    /// A column of a table, an output of the computations that read it.
    Column,
    Plan,
    /// An entry of a plan. `in` and `out` entries are the ports of a sub-plan.
    Entry(EntryKind),
    /// An element or supervisor of a plan.
    Component(ComponentKind),
    /// A scenario, named by a string.
    Scenario,
}

/// A built-in name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Word {
    /// The state `OK` of a sub-plan or plan.
    Ok,
    /// The state `Interrupted` of a sub-plan or plan.
    Interrupted,
    /// The `Error` edge of an element, or the end of a plan in `Error`.
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
    /// The word `suspend` before the name of a handler.
    Suspend,
    /// The target `return`.
    Return,
    /// A built-in type, such as `length`.
    Type,
    /// `true` or `false`
    Truth,
    /// A function of formulas, such as `min`.
    Function,
    /// A resource after `uses` that is not a device of its toolbox.
    Resource,
    /// A fault that every sensor has, such as `frozen`, in a scenario.
    Fault,
    /// The amount of such a fault, such as `time`.
    Amount,
    /// A part of a signal, such as `x` of a pose.
    Field,
    /// Every actor, after `idle`.
    All,
    /// The supervisor that reports the second of two exclusive events.
    Other,
}

impl DefinitionId {
    /// The index into [`Index::definitions`].
    pub fn index(self) -> usize {
        self.0 as usize
    }

    fn new(index: usize) -> DefinitionId {
        DefinitionId(u32::try_from(index).unwrap_or(u32::MAX))
    }
}

impl Meaning {
    /// The declared or referenced definition; for a short binding, the entry.
    pub fn definition(self) -> Option<DefinitionId> {
        match self {
            Meaning::Declares(id) | Meaning::Refers(id) | Meaning::Both { entry: id, .. } => {
                Some(id)
            }
            _ => None,
        }
    }

    /// All referenced definitions.
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
    /// The name that covers a byte of a file. If two names touch, the second one.
    pub fn at(&self, file: u16, offset: u32) -> Option<Name> {
        let behind =
            self.names.partition_point(|name| (name.span.file, name.span.start) <= (file, offset));
        let name = *self.names.get(behind.checked_sub(1)?)?;
        (name.span.file == file && offset <= name.span.end).then_some(name)
    }

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

    /// A definition; the id must come from this index.
    pub fn definition(&self, id: DefinitionId) -> &Definition {
        &self.definitions[id.index()]
    }

    /// The definition whose name has this span.
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

    /// The definitions directly in a definition, in order.
    pub fn members(
        &self,
        owner: DefinitionId,
    ) -> impl Iterator<Item = (DefinitionId, &Definition)> {
        let home = self.definition(owner);
        // In a broken file, items may precede the line of the toolbox.
        let first = self.definitions.partition_point(|known| match home.kind {
            DefinitionKind::Toolbox => known.name.file < home.name.file,
            _ => known.name <= home.name,
        });
        let all = (first..).map(DefinitionId::new).zip(&self.definitions[first..]);
        // A toolbox owns the whole file; other definitions own their span.
        let within = move |known: &Definition| match home.kind {
            DefinitionKind::Toolbox => known.name.file == home.name.file,
            _ => home.span.contains(known.name),
        };
        all.take_while(move |(_, known)| within(known))
            .filter(move |(_, known)| known.owner == Some(owner))
    }

    /// The places that refer to a definition, in order, without its declaration.
    pub fn references(&self, id: DefinitionId) -> impl Iterator<Item = Span> {
        let [first, end] = [0, 1].map(|next| self.first_uses[id.index() + next] as usize);
        self.uses[first..end].iter().map(|name| self.names[*name as usize].span)
    }

    /// The definitions of some kinds that a place of a plan file can name, in order: plans, enums
    /// and tables of the file and of the files that it uses, and the declarations of its toolboxes.
    /// In a plan or its scenario also the entries, elements and global supervisors.
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

    /// The candidates of an ambiguous name.
    pub fn candidates(&self, candidates: Candidates) -> &[DefinitionId] {
        self.several.get(candidates.0 as usize).map_or(&[], Vec::as_slice)
    }
}
