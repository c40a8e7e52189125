//! The names of a plan as static rows, and plans that can be addressed by name.

use afp_types::{
    EntryId, Text, Unit, Value, parse_bool, parse_choice, parse_float, parse_int, parse_quantity,
};

use crate::fault::Fault;
use crate::rt::state::PlanState;
use crate::trace::{
    ComponentId, ComponentKind, ComponentName, EntryKind, EntryName, Names, Outcome, PortName,
    Reaction, TextPlace, TraceEntryId,
};

/// The names of a generated plan, sub-plans unfolded.
#[derive(Clone, Copy, Debug)]
pub struct NameTable {
    /// The components, by id.
    pub components: &'static [ComponentRow],
    /// The entries, by id.
    pub entries: &'static [EntryRow],
}

/// The names of one component.
#[derive(Clone, Copy, Debug)]
pub struct ComponentRow {
    /// Path, kind and template.
    pub name: ComponentName<'static>,
    /// States or events, each with where it leads.
    pub outcomes: &'static [(&'static str, &'static str)],
    /// Where `Error` or `DeadlineMissed` leads.
    pub special: &'static str,
    /// The input ports.
    pub inputs: &'static [PortRow],
    /// The outputs that are bound.
    pub outputs: &'static [PortRow],
    /// The edges of an element that hold instead of those of global supervisors.
    pub reactions: &'static [Reaction<'static>],
}

/// The names of one entry.
#[derive(Clone, Copy, Debug)]
pub struct EntryRow {
    /// Path, kind, type and unit.
    pub name: EntryName<'static>,
    /// The values of an enum.
    pub choices: &'static [&'static str],
    /// Where its initial value stands in the text.
    pub initial: Option<TextPlace<'static>>,
}

/// The name of one port.
#[derive(Clone, Copy, Debug)]
pub struct PortRow {
    /// Name, type, unit, range and place.
    pub name: PortName<'static>,
    /// The values of an enum.
    pub choices: &'static [&'static str],
    /// Its position in the template, where not all ports have a row.
    pub position: u16,
}

impl PortRow {
    /// An input port.
    pub const fn new(name: &'static str, unit: &'static str) -> Self {
        let name = PortName { name, ty: "", unit, range: None, entry: None, place: None };
        PortRow { name, choices: &[], position: 0 }
    }

    /// The row of a port that takes an enum with those values, or an object without any.
    #[must_use]
    pub const fn of(mut self, ty: &'static str, choices: &'static [&'static str]) -> Self {
        self.name.ty = ty;
        self.choices = choices;
        self
    }

    /// An output port, by position in the template, that is bound to an entry.
    #[must_use]
    pub const fn into(mut self, position: u16, entry: &'static str) -> Self {
        self.position = position;
        self.name.entry = Some(entry);
        self
    }

    /// The row of a port with a range, in SI units.
    #[must_use]
    pub const fn within(mut self, least: f64, greatest: f64) -> Self {
        self.name.range = Some((least, greatest));
        self
    }

    /// The row of a port to which something is bound there.
    #[must_use]
    pub const fn at(mut self, file: &'static str, line: u32, column: u32) -> Self {
        self.name.place = Some(TextPlace { file, line, column });
        self
    }
}

impl ComponentRow {
    /// A row.
    pub const fn new(
        path: &'static str,
        kind: ComponentKind,
        template: &'static str,
        outcomes: &'static [(&'static str, &'static str)],
        special: &'static str,
        inputs: &'static [PortRow],
    ) -> Self {
        let name = ComponentName { path, kind, template };
        ComponentRow { name, outcomes, special, inputs, outputs: &[], reactions: &[] }
    }

    /// The row of a component whose outputs are bound.
    #[must_use]
    pub const fn writing(mut self, outputs: &'static [PortRow]) -> Self {
        self.outputs = outputs;
        self
    }

    /// The row of an element with edges of its own for events of global supervisors.
    #[must_use]
    pub const fn reacting(mut self, reactions: &'static [Reaction<'static>]) -> Self {
        self.reactions = reactions;
        self
    }
}

impl EntryRow {
    /// A row.
    pub const fn new(
        path: &'static str,
        kind: EntryKind,
        ty: &'static str,
        unit: &'static str,
        choices: &'static [&'static str],
    ) -> Self {
        EntryRow { name: EntryName { path, kind, ty, unit, range: None }, choices, initial: None }
    }

    /// The row of an entry with a range, in SI units.
    #[must_use]
    pub const fn within(mut self, least: f64, greatest: f64) -> Self {
        self.name.range = Some((least, greatest));
        self
    }

    /// The row of an entry whose initial value stands there.
    #[must_use]
    pub const fn at(mut self, file: &'static str, line: u32, column: u32) -> Self {
        self.initial = Some(TextPlace { file, line, column });
        self
    }
}

/// A plan that people address by name: generated or loaded.
pub trait NamedPlan: PlanState {
    /// The names behind its ids.
    type Names: Names + Send + 'static;

    /// The names, to be kept apart from the running plan.
    fn names(&self) -> Self::Names;

    /// Reads a value for an entry as it would stand in the plan: `35 cm`, `true`,
    /// `Side.left`; texts without quotes. Only [`NamedPlan::units`] are understood.
    ///
    /// # Errors
    /// [`Fault::CONVERSION`]; [`Fault::TOO_LONG`] for a text.
    fn read(&self, entry: EntryId, text: &str) -> Result<Value, Fault> {
        let names = self.names();
        let id = entry.into();
        let EntryName { ty, unit, .. } = names.entry(id);
        let value = match ty {
            "bool" => parse_bool(text).map(Value::Bool),
            "int" => parse_int(text).map(Value::Int),
            "float" => parse_float(text).map(Value::Float),
            "string" => Text::try_from(text).map(Value::Text),
            _ if !unit.is_empty() => parse_quantity(text, self.units(entry.0)).map(Value::Float),
            ty => {
                let name = text.trim().strip_prefix(ty).and_then(|rest| rest.strip_prefix('.'));
                let choices = (0..u16::MAX).map(|value| names.choice(id, value));
                let choices = choices.take_while(|choice| !choice.is_empty());
                parse_choice(name.unwrap_or(text), choices).map(Value::Choice)
            }
        };
        Ok(value?)
    }

    /// The units that a quantity for an entry, by position, may be written in.
    fn units(&self, entry: u16) -> impl Iterator<Item = Unit<'_>>;

    /// The position of an entry of the plan itself.
    fn entry_named(&self, name: &str) -> Option<EntryId> {
        let names = self.names();
        let mut ids = (0..names.entries()).map(TraceEntryId);
        let found = ids.find(|id| names.entry(*id).path == name)?;
        u16::try_from(found.0).ok().filter(|_| !name.contains('.')).map(EntryId)
    }
}

impl NameTable {
    fn row(&self, id: ComponentId) -> Option<&'static ComponentRow> {
        self.components.get(usize::try_from(id.0).ok()?)
    }

    fn entry_row(&self, id: TraceEntryId) -> Option<&'static EntryRow> {
        self.entries.get(usize::try_from(id.0).ok()?)
    }
}

impl Names for NameTable {
    fn components(&self) -> u32 {
        self.components.len() as u32
    }

    fn component(&self, id: ComponentId) -> ComponentName<'_> {
        self.row(id).map_or(ComponentName::NONE, |row| row.name)
    }

    fn outcome(&self, id: ComponentId, outcome: Outcome) -> &str {
        match outcome {
            Outcome::DeadlineMissed => "DeadlineMissed",
            Outcome::Error => "Error",
            Outcome::Declared(position) => {
                let row = self.row(id).and_then(|row| row.outcomes.get(usize::from(position)));
                row.map_or("", |(name, _)| name)
            }
        }
    }

    fn target(&self, id: ComponentId, outcome: Outcome) -> &str {
        let Some(row) = self.row(id) else { return "" };
        match outcome {
            Outcome::DeadlineMissed | Outcome::Error => row.special,
            Outcome::Declared(position) => {
                row.outcomes.get(usize::from(position)).map_or("", |(_, target)| target)
            }
        }
    }

    fn reaction(&self, element: ComponentId, n: u16) -> Option<Reaction<'_>> {
        self.row(element)?.reactions.get(usize::from(n)).copied()
    }

    fn input(&self, id: ComponentId, port: u16) -> &str {
        self.input_port(id, port).name
    }

    fn input_port(&self, id: ComponentId, port: u16) -> PortName<'_> {
        let row = self.row(id).and_then(|row| row.inputs.get(usize::from(port)));
        row.map_or(PortName::default(), |row| row.name)
    }

    fn input_choice(&self, id: ComponentId, port: u16, value: u16) -> &str {
        let row = self.row(id).and_then(|row| row.inputs.get(usize::from(port)));
        row.and_then(|row| row.choices.get(usize::from(value))).map_or("", |name| name)
    }

    fn output_port(&self, id: ComponentId, port: u16) -> PortName<'_> {
        let rows = self.row(id).map_or(&[][..], |row| row.outputs);
        let row = rows.iter().find(|row| row.position == port);
        row.map_or(PortName::default(), |row| row.name)
    }

    fn outputs(&self, id: ComponentId) -> u16 {
        let rows = self.row(id).map_or(&[][..], |row| row.outputs);
        rows.iter().map(|row| row.position.saturating_add(1)).max().unwrap_or(0)
    }

    fn initial(&self, id: TraceEntryId) -> Option<TextPlace<'_>> {
        self.entry_row(id)?.initial
    }

    fn entries(&self) -> u32 {
        self.entries.len() as u32
    }

    fn entry(&self, id: TraceEntryId) -> EntryName<'_> {
        self.entry_row(id).map_or(EntryName::NONE, |row| row.name)
    }

    fn choice(&self, id: TraceEntryId, value: u16) -> &str {
        let row = self.entry_row(id).and_then(|row| row.choices.get(usize::from(value)));
        row.map_or("", |name| name)
    }
}
