//! The meaning of a plan's names in a run.

use afp::load::PlanNames;
use afp_core::EntryId;
use afp_core::trace::{ComponentId, ComponentKind, Names, Outcome, TraceEntryId, declared};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;

use super::session::Run;

impl Run {
    /// A component and one of its outcomes.
    pub fn reported(&self, path: &str, outcome: &str) -> PyResult<(ComponentId, Outcome)> {
        let names = &self.names;
        let component =
            self.find(path, &[ComponentKind::Actor, ComponentKind::Supervisor]).ok_or_else(
                || PyValueError::new_err(format!("the plan has no actor or supervisor '{path}'")),
            )?;
        let found = declared(names, component).find(|(_, name)| *name == outcome);
        let (outcome, _) = found.ok_or_else(|| {
            let known: Vec<_> = declared(names, component).map(|(_, name)| name).collect();
            let known = known.join(", ");
            PyValueError::new_err(format!("'{path}' has no '{outcome}'; there are: {known}"))
        })?;
        Ok((component, outcome))
    }

    /// An actor or sub-plan by its path.
    pub fn element(&self, path: &str) -> PyResult<ComponentId> {
        self.find(path, &[ComponentKind::Actor, ComponentKind::SubPlan]).ok_or_else(|| {
            PyValueError::new_err(format!("the plan has no actor or sub-plan '{path}'"))
        })
    }

    fn find(&self, path: &str, kinds: &[ComponentKind]) -> Option<ComponentId> {
        let names: &PlanNames = &self.names;
        (0..names.components()).map(ComponentId).find(|id| {
            let about = names.component(*id);
            about.path == path && kinds.contains(&about.kind)
        })
    }

    /// The number of an entry of the plan.
    ///
    /// # Errors
    /// It has no such entry.
    pub fn entry(&self, name: &str) -> PyResult<EntryId> {
        let known = self.own_entries();
        let found = (0..).map(EntryId).zip(&known).find(|(_, known)| *known == name);
        found.map(|(number, _)| number).ok_or_else(|| unknown_entry(name, &known))
    }

    /// The names of the plan's own entries.
    pub fn own_entries(&self) -> Vec<String> {
        let ids = (0..self.own_entries).map(TraceEntryId);
        ids.map(|id| self.names.entry(id).path.to_owned()).collect()
    }
}

/// The error for an unknown entry of a plan.
pub fn unknown_entry(name: &str, known: &[String]) -> PyErr {
    let none = format!("the plan has no entry '{name}'");
    PyKeyError::new_err(match known.is_empty() {
        true => format!("{none}; it has no entries"),
        false => format!("{none}; there are: {}", known.join(", ")),
    })
}
