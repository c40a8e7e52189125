//! Which conditions can hold while an element is entered, and which never hold together.
//!
//! What templates do nobody declares, except those of the standard toolbox, which are known here.

use crate::flow::view::{Cause, Edge, View};
use crate::graph::{Component, Element, EntryId, Formula, FormulaKind, Supervisor};
use crate::toolbox::Constant;

/// The event of `CheckValue` that reports a value below its limit; the other one reports one above.
const BELOW: u16 = 0;

/// Whether an edge can be taken in the look, or by the start of an element.
pub(super) fn can_hold(view: &View<'_>, cause: Cause) -> bool {
    match cause {
        Cause::Event(id, _) => !waits(view, view.supervisor(id)),
        Cause::Error(id) => can_fail(view, &view.plan.elements[id.index()]),
        _ => true,
    }
}

/// Whether a supervisor reports something only after some time.
fn waits(view: &View<'_>, supervisor: &Supervisor) -> bool {
    match standard(view, supervisor) {
        Some("Every" | "Changed") => true,
        Some("CheckTimeout") => {
            let time = supervisor.inputs.first().and_then(|time| view.constant(time));
            matches!(time, Some(Constant::Float(time)) if time > 0.0)
        }
        _ => false,
    }
}

/// Whether the start of an element can fail: it commands something, or computes what it needs.
fn can_fail(view: &View<'_>, element: &Element) -> bool {
    let (Component::Actor(id) | Component::Computation(id)) = element.component else {
        return true;
    };
    let computes = element.inputs.iter().any(|input| view.constant(input).is_none());
    computes || !view.model.template(id).uses.is_empty()
}

/// Whether the conditions of a cycle never hold together: one value above a limit and below another one.
pub(super) fn contradict(view: &View<'_>, cycle: &[Edge]) -> bool {
    let limits: Vec<_> = cycle.iter().filter_map(|edge| limit(view, edge.cause)).collect();
    let is_written = |entry: EntryId| {
        cycle.iter().any(|edge| view.writes(edge.cause).any(|output| output.entry == entry))
    };
    limits.iter().any(|(entry, above, event)| {
        let below = limits.iter().filter(|(other, ..)| other == entry);
        let impossible = |(_, below, other): &&(EntryId, f64, u16)| {
            *event != BELOW && *other == BELOW && *above >= *below
        };
        { below }.any(|other| impossible(&other)) && !is_written(*entry)
    })
}

/// The entry that a `CheckValue` compares, with what, and which of its events it is.
fn limit(view: &View<'_>, cause: Cause) -> Option<(EntryId, f64, u16)> {
    let Cause::Event(id, event) = cause else { return None };
    let supervisor = view.supervisor(id);
    standard(view, supervisor).filter(|name| *name == "CheckValue")?;
    let [value, limit] = supervisor.inputs.as_slice() else { return None };
    let limit = match view.constant(limit)? {
        Constant::Int(limit) => limit as f64,
        Constant::Float(limit) => limit,
        _ => return None,
    };
    Some((entry(value)?, limit, event))
}

/// The entry that a formula reads, and nothing else.
fn entry(formula: &Formula) -> Option<EntryId> {
    match &formula.kind {
        FormulaKind::Entry(id) => Some(*id),
        FormulaKind::Convert(_, inner) => entry(inner),
        _ => None,
    }
}

/// The name of a supervisor's template, if that is one of the standard toolbox.
fn standard<'a>(view: &View<'a>, supervisor: &Supervisor) -> Option<&'a str> {
    let id = supervisor.template;
    let toolbox = &view.model.toolboxes[id.toolbox.index()];
    (toolbox.name == "std").then(|| view.model.template(id).name.as_str())
}
