//! Formulas in clients' requests, with their current values.

use afp_core::Text;
use afp_core::trace::{ComponentId, TraceEntryId};
use afp_dsl::graph::EntryId;
use afp_dsl::toolbox::Constant;
use afp_dsl::types::{Dimension, Type};
use afp_dsl::watch::Watch;
use afp_session::Datum;

use crate::program::Program;
use crate::state::State;

/// A formula inside a running plan.
#[derive(Clone, Debug)]
pub(crate) struct Watched {
    watch: Watch,
    text: String,
    /// The number of the plan's first entry.
    first: u32,
    /// The entry, if the formula is only an entry.
    entry: Option<TraceEntryId>,
}

impl Watched {
    /// Parses a formula inside a plan.
    ///
    /// # Errors
    /// The error and an action.
    pub fn new(program: &Program, plan: ComponentId, text: &str) -> Result<Watched, String> {
        let inside = program.plan_of(plan).ok_or("there is no such plan")?;
        let watch = Watch::new(&program.graph, inside, text).map_err(|why| why.to_string())?;
        let first = program.entries.iter().position(|entry| entry.plan == plan).unwrap_or(0);
        let text = text.trim().to_owned();
        let entry = program.entry(plan, &text);
        Ok(Watched { watch, text, first: first as u32, entry })
    }

    /// Parses a formula with the type bool.
    ///
    /// # Errors
    /// As [`Watched::new`].
    pub fn condition(program: &Program, plan: ComponentId, text: &str) -> Result<Watched, String> {
        let watched = Watched::new(program, plan, text)?;
        match watched.watch.ty() {
            Type::Bool => Ok(watched),
            ty => Err(format!("'{}' is of type '{ty}': compare it with something", watched.text)),
        }
    }

    /// Computes its value; `None` while one of its entries is unset.
    ///
    /// # Errors
    /// It cannot be computed.
    pub fn value(&self, program: &Program, state: &State) -> Result<Option<Constant>, String> {
        let entry = |id: EntryId| {
            let number = TraceEntryId(self.first + u32::from(id.0));
            let declared = program.graph_entry(number)?;
            constant(state.entry(number)?, &declared.ty)
        };
        self.watch.value(&entry).map_err(|why| format!("cannot compute '{}': {why}", self.text))
    }

    /// Whether it is true for the values of all entries, by number. Never allocates.
    pub fn holds_for(&self, entries: &[Constant]) -> bool {
        let entry = |id: EntryId| {
            let value = entries.get(self.first as usize + usize::from(id.0))?;
            (*value != Constant::Unset).then(|| value.clone())
        };
        matches!(self.watch.value(&entry), Ok(Some(Constant::Bool(true))))
    }

    /// Its constant value, if an entry of this type can take it.
    pub fn constant_for(&self, ty: &Type) -> Result<Constant, String> {
        let number = matches!((self.watch.ty(), ty), (Type::Int, Type::Quantity(it)) if *it == Dimension::NONE);
        let fits = number || self.watch.ty() == ty;
        let value = self.watch.value(&|_| None).ok().flatten().filter(|_| fits);
        value.ok_or_else(|| format!("'{}' is not a value of type '{ty}'", self.text))
    }

    /// Whether it is true; an unset value counts as false.
    pub fn holds(&self, program: &Program, state: &State) -> bool {
        matches!(self.value(program, state), Ok(Some(Constant::Bool(true))))
    }

    /// Its value with a unit.
    ///
    /// # Errors
    /// It cannot be computed.
    pub fn shown(&self, program: &Program, state: &State) -> Result<String, String> {
        let Some(value) = self.value(program, state)? else {
            // Formulas cannot read objects, so an entry with an object is shown like other entries.
            let object = self.entry.and_then(|entry| state.entry(entry));
            let object = object.filter(|held| matches!(held, Datum::Object(_)));
            return Ok(object.map_or("unset".to_owned(), |held| held.to_string()));
        };
        let unit = self.watch.ty().si_unit();
        Ok(datum(value, self.watch.ty()).in_unit(&unit).to_string())
    }

    /// The type of its value in source form.
    pub fn ty(&self) -> String {
        self.watch.ty().to_string()
    }
}

impl Program {
    /// A value of an entry, for formulas; unset for objects.
    pub(crate) fn constant(&self, id: TraceEntryId, value: Option<&Datum>) -> Constant {
        let declared = self.graph_entry(id);
        value.zip(declared).and_then(|(value, it)| constant(value, &it.ty)).unwrap_or_default()
    }

    pub(crate) fn graph_entry(&self, id: TraceEntryId) -> Option<&afp_dsl::graph::Entry> {
        let plan = self.entries.get(id.0 as usize)?.plan;
        let first = self.entries.iter().position(|entry| entry.plan == plan)?;
        let inside = self.plan_of(plan)?;
        self.graph.plan(inside).entries.get(id.0 as usize - first)
    }
}

/// A value for formulas; `None` if it is unset or an object.
pub(crate) fn constant(value: &Datum, ty: &Type) -> Option<Constant> {
    let place = |name: String| {
        let (name, Type::Enum(choices)) = (name.rsplit('.').next()?, ty) else { return None };
        u16::try_from(choices.variants.iter().position(|variant| variant == name)?).ok()
    };
    let value = value.clone().try_map(|text| Text::try_from(&*text).ok(), place, |_| None)?;
    Some(value).filter(|value| *value != Constant::Unset)
}

/// A value in the format of runs.
fn datum(value: Constant, ty: &Type) -> Datum {
    let name = |place| match ty {
        Type::Enum(choices) => {
            let name = choices.variants.get(usize::from(place)).map_or("", |name| &**name);
            format!("{}.{name}", choices.name)
        }
        _ => format!("#{place}"),
    };
    value.map(|text| text.to_string(), name, |object| format!("#{object}"))
}
