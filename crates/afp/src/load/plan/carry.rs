//! Values taken over by a plan that replaces another, or that begins at a moment of another run.

use afp_core::{Environment, Value};
use afp_dsl::graph::{EntryKind, Moment};
use afp_dsl::types::Type;

use super::LoadedPlan;
use super::entry::fit;
use crate::load::config::ObjectCell;
use crate::load::numbered;
use crate::load::outputs::limit;

/// A value that replaces an entry's initial value.
#[derive(Clone)]
pub(super) struct Carried {
    entry: u16,
    value: Value,
    object: Option<Box<dyn ObjectCell>>,
}

impl<E: Environment + ?Sized + 'static> LoadedPlan<E> {
    /// Takes over values of a plan that this one replaces: of each `in`, `var` and `out` entry with
    /// the same name and type in both and a value in the other. They replace initial values, only
    /// for the next start. Returns the names of those entries.
    ///
    /// A value outside the new entry's range is skipped.
    ///
    /// Enums have the same type if their values have the same names in the same order.
    pub fn carry(&mut self, from: &LoadedPlan<E>) -> Vec<String> {
        let mut names = Vec::new();
        for (entry, info) in numbered(&*self.entries) {
            let Some(other) = from.entry_number(&info.name) else { continue };
            let types = (self.config.values.ty(entry), from.config.values.ty(other));
            let (Some(ty), Some(other_ty)) = types else { continue };
            if info.kind == EntryKind::Const || !same(ty, other_ty) {
                continue;
            }
            if !from.config.values.is_set(other) {
                continue;
            }
            let value = from.config.values.get(other).clone();
            if limit(info.range, value.clone()).is_err() {
                continue;
            }
            let object = from.config.values.cell(other).map(ObjectCell::copied);
            self.carried.push(Carried { entry, value, object });
            names.push(info.name.clone());
        }
        // Inputs must be set before the start.
        self.put_carried(|kind| kind == EntryKind::In);
        names
    }
}

impl<E: ?Sized + 'static> LoadedPlan<E> {
    /// Begins the next start at a moment. Values outside their ranges are skipped.
    pub(super) fn begin_at(&mut self, moment: &Moment) {
        self.begins_at = moment.element;
        for (entry, value) in &moment.entries {
            let value = fit(self.config.values.ty(entry.0), value);
            let info = self.entries.get(usize::from(entry.0));
            if info.is_some_and(|info| limit(info.range, value.clone()).is_ok()) {
                self.carried.push(Carried { entry: entry.0, value, object: None });
            }
        }
    }

    /// Puts the carried values into the entries of some kinds.
    pub(super) fn put_carried(&mut self, of: impl Fn(EntryKind) -> bool) {
        let LoadedPlan { carried, entries, config, .. } = self;
        carried.retain(|Carried { entry, value, object }| {
            let here = entries.get(usize::from(*entry)).is_some_and(|info| of(info.kind));
            if here {
                config.values.set(*entry, value.clone(), object.as_deref());
            }
            !here
        });
    }
}

fn same(one: &Type, other: &Type) -> bool {
    match (one, other) {
        (Type::Enum(one_enum), Type::Enum(other_enum)) => {
            one == other && one_enum.variants == other_enum.variants
        }
        _ => one == other,
    }
}
