//! The order of a trace: one actor at a time, and whole commits.

use std::collections::BTreeMap;

use afp_core::Value;
use afp_core::trace::{Author, ComponentId, ComponentKind, EntryKind, Names, Record, TraceEntryId};

/// The state of a plan, from its trace.
#[derive(Debug, Default)]
pub(super) struct Order {
    /// The actor that has started, and has neither ended nor been suspended.
    active: Option<ComponentId>,
    /// The values of the entries that a component has written.
    entries: BTreeMap<TraceEntryId, Value>,
    /// The commit of the last records: its author and its entries.
    commit: Option<(Author, Vec<TraceEntryId>)>,
}

impl Order {
    /// Takes a record; returns the rule that it violates, if any.
    pub(super) fn on_record(&mut self, record: &Record<'_>, names: &impl Names) -> Option<String> {
        if !matches!(record, Record::Committed { .. }) {
            self.commit = None;
        }
        let is_actor = |id| names.component(id).kind == ComponentKind::Actor;
        match *record {
            Record::Started { component } | Record::Returned { component, .. }
                if is_actor(component) =>
            {
                let other = self.active.replace(component)?;
                let [this, other] = [component, other].map(|id| names.component(id).path);
                Some(format!("'{this}' starts while '{other}' is active"))
            }
            Record::Started { component } => {
                // The entries of a sub-plan begin with their initial values.
                let path = format!("{}.", names.component(component).path);
                self.entries.retain(|id, _| !names.entry(*id).path.starts_with(&path));
                None
            }
            Record::Interrupted { element: id }
            | Record::Finished { element: id, .. }
            | Record::Suspended { element: id, started: true, .. }
            | Record::Faulted { component: id, .. } => {
                self.active = self.active.filter(|active| *active != id);
                None
            }
            Record::Ended { plan, .. } if plan.0 == 0 => {
                let active = self.active?;
                Some(format!("the plan ends while '{}' is active", names.component(active).path))
            }
            Record::Committed { author, entry, old, new } => {
                self.commits(author, entry, (old.to_value().ok()?, new.to_value().ok()?), names)
            }
            _ => None,
        }
    }

    /// Takes an end without records of the active components.
    pub(super) fn aborted(&mut self) {
        self.active = None;
    }

    fn commits(
        &mut self,
        author: Author,
        entry: TraceEntryId,
        (old, new): (Value, Value),
        names: &impl Names,
    ) -> Option<String> {
        let path = names.entry(entry).path;
        let commit = match &mut self.commit {
            Some((known, entries)) if *known == author => entries,
            other => &mut other.insert((author, Vec::new())).1,
        };
        if commit.contains(&entry) {
            return Some(format!("a commit writes '{path}' twice"));
        }
        commit.push(entry);
        // The plan around a sub-plan changes its inputs without a commit.
        let is_input = names.entry(entry).kind == EntryKind::In;
        let before = self.entries.insert(entry, new).filter(|_| !is_input)?;
        let text = || format!("'{path}' was {before:?}, but the commit of {author:?} says {old:?}");
        (before != old).then(text)
    }
}
