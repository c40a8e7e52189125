//! A plan's names as static rows, and plans addressed by name.

use afp_types::{
    EntryId, Text, Unit, Value, parse_bool, parse_choice, parse_float, parse_int, parse_quantity,
};

use crate::fault::Fault;
use crate::rt::state::PlanState;
use crate::trace::{
    ComponentId, ComponentKind, ComponentName, EntryKind, EntryName, Names, Outcome, PortName,
    Reaction, TextPlace, TraceEntryId,
};

/// The names of a generated plan and its sub-plans.
#[derive(Clone, Copy, Debug)]
pub struct NameTable {
    /// The components, by id.
    pub components: &'static [ComponentRow],
    /// The entries, by id.
    pub entries: &'static [EntryRow],
}

#[derive(Clone, Copy, Debug)]
pub struct ComponentRow {
    pub name: ComponentName<'static>,
    /// States or events, each with its target.
    pub outcomes: &'static [(&'static str, &'static str)],
    /// Target of `Error` or `DeadlineMissed`.
    pub special: &'static str,
    pub inputs: &'static [PortRow],
    /// The bound outputs.
    pub outputs: &'static [PortRow],
    /// The element's edges that override those of global supervisors.
    pub reactions: &'static [Reaction<'static>],
    /// The states of a declared computation whose formulas can fail, with their source positions.
    pub states: &'static [PortRow],
}

#[derive(Clone, Copy, Debug)]
pub struct EntryRow {
    pub name: EntryName<'static>,
    pub choices: &'static [&'static str],
    /// Source position of the initial value.
    pub initial: Option<TextPlace<'static>>,
}

#[derive(Clone, Copy, Debug)]
pub struct PortRow {
    pub name: PortName<'static>,
    pub choices: &'static [&'static str],
    /// Position in the template, if not all ports have a row.
    pub position: u16,
}

impl PortRow {
    pub const fn new(name: &'static str, unit: &'static str) -> Self {
        let name = PortName { name, ty: "", unit, range: None, entry: None, place: None };
        PortRow { name, choices: &[], position: 0 }
    }

    /// Adds the type: an enum with its values, or an object without any.
    #[must_use]
    pub const fn of(mut self, ty: &'static str, choices: &'static [&'static str]) -> Self {
        self.name.ty = ty;
        self.choices = choices;
        self
    }

    /// An output port, by position in the template, bound to an entry.
    #[must_use]
    pub const fn into(mut self, position: u16, entry: &'static str) -> Self {
        self.position = position;
        self.name.entry = Some(entry);
        self
    }

    /// Adds a range, in SI units.
    #[must_use]
    pub const fn within(mut self, least: f64, greatest: f64) -> Self {
        self.name.range = Some((least, greatest));
        self
    }

    /// Adds the source position of the bound formula.
    #[must_use]
    pub const fn at(mut self, file: &'static str, line: u32, column: u32) -> Self {
        self.name.place = Some(TextPlace { file, line, column });
        self
    }
}

impl ComponentRow {
    pub const fn new(
        path: &'static str,
        kind: ComponentKind,
        template: &'static str,
        outcomes: &'static [(&'static str, &'static str)],
        special: &'static str,
        inputs: &'static [PortRow],
    ) -> Self {
        let name = ComponentName { path, kind, template };
        ComponentRow { name, outcomes, special, inputs, outputs: &[], reactions: &[], states: &[] }
    }

    /// Adds the bound outputs.
    #[must_use]
    pub const fn writing(mut self, outputs: &'static [PortRow]) -> Self {
        self.outputs = outputs;
        self
    }

    /// Adds the states of a declared computation.
    #[must_use]
    pub const fn declared(mut self, states: &'static [PortRow]) -> Self {
        self.states = states;
        self
    }

    /// Adds edges for events of global supervisors.
    #[must_use]
    pub const fn reacting(mut self, reactions: &'static [Reaction<'static>]) -> Self {
        self.reactions = reactions;
        self
    }
}

impl EntryRow {
    pub const fn new(
        path: &'static str,
        kind: EntryKind,
        ty: &'static str,
        unit: &'static str,
        choices: &'static [&'static str],
    ) -> Self {
        EntryRow { name: EntryName { path, kind, ty, unit, range: None }, choices, initial: None }
    }

    /// Adds a range, in SI units.
    #[must_use]
    pub const fn within(mut self, least: f64, greatest: f64) -> Self {
        self.name.range = Some((least, greatest));
        self
    }

    /// Adds the source position of the initial value.
    #[must_use]
    pub const fn at(mut self, file: &'static str, line: u32, column: u32) -> Self {
        self.initial = Some(TextPlace { file, line, column });
        self
    }
}

/// A plan addressed by name: generated or loaded.
pub trait NamedPlan: PlanState {
    /// The names of its ids.
    type Names: Names + Send + 'static;

    /// Returns the names, separate from the running plan.
    fn names(&self) -> Self::Names;

    /// Parses a value for an entry, written as in the plan: `35 cm`, `true`, `Side.left`; strings
    /// without quotes. Accepts only the units of [`NamedPlan::units`].
    ///
    /// # Errors
    /// [`Fault::CONVERSION`]; [`Fault::TOO_LONG`] for a string.
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

    /// The accepted units of an entry, by position.
    fn units(&self, entry: u16) -> impl Iterator<Item = Unit<'_>>;

    /// Looks up an entry of the outermost plan.
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

    fn state(&self, id: ComponentId, state: u16) -> Option<TextPlace<'_>> {
        self.row(id)?.states.get(usize::from(state))?.name.place
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
