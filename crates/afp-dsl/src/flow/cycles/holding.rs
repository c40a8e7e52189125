//! Which conditions can hold while an element is entered, and which never hold together.
//!
//! What templates do nobody declares, except those of the standard toolbox, which are known here.

use crate::flow::view::{Cause, Edge, View};
use crate::graph::{
    Component, Element, EntryId, Formula, FormulaKind, Output, Supervisor, TemplateId,
};
use crate::toolbox::Constant;
use crate::types::Conversion;

/// The event of `CheckValue` that reports a value below its limit; the other one reports one above.
const BELOW: u16 = 0;

/// Computations of the standard toolbox that never fail: only what goes into them and comes out of them can.
const SURE: &[&str] = &["Assign", "Compare", "Count", "Is", "Log", "Switch"];

/// Whether an edge can be taken in the look, or by the start of an element.
pub(super) fn can_hold(view: &View<'_>, cause: Cause) -> bool {
    match cause {
        Cause::Event(id, event) => !view.is_once(id, event) && !waits(view, view.supervisor(id)),
        Cause::Error(id) => can_fail(view, &view.plan.elements[id.index()]),
        _ => true,
    }
}

/// Whether a supervisor reports something only after some time.
fn waits(view: &View<'_>, supervisor: &Supervisor) -> bool {
    if standard(view, supervisor) != Some("CheckTimeout") {
        return false;
    }
    let time = supervisor.inputs.first().and_then(|time| view.constant(time));
    matches!(time, Some(Constant::Float(time)) if time > 0.0)
}

/// Whether the start of an element can fail: it commands something, or computes what it needs.
pub(super) fn can_fail(view: &View<'_>, element: &Element) -> bool {
    let (Component::Actor(id) | Component::Computation(id)) = element.component else {
        return true;
    };
    if standard_template(view, id).is_some_and(|name| SURE.contains(&name)) {
        let fits = |output: &Output| {
            let entry = view.plan.entries.get(output.entry.index());
            entry.is_some_and(|entry| entry.range.is_none() && entry.ranged_by.is_empty())
                && output.conversion.as_ref().is_none_or(never_fails)
        };
        let inputs = element.inputs.iter().all(|input| is_plain(view, input));
        return !(inputs && element.outputs.iter().all(fits));
    }
    let computes = element.inputs.iter().any(|input| view.constant(input).is_none());
    computes || !view.model.template(id).uses.is_empty()
}

/// Whether a formula is a constant or an entry, so that nothing can go wrong with it.
fn is_plain(view: &View<'_>, formula: &Formula) -> bool {
    match &formula.kind {
        FormulaKind::Entry(_) => true,
        FormulaKind::Convert(conversion, inner) if never_fails(conversion) => is_plain(view, inner),
        _ => view.constant(formula).is_some(),
    }
}

fn never_fails(conversion: &Conversion) -> bool {
    !matches!(conversion, Conversion::FloatToInt | Conversion::FromText(_))
}

/// What a `CheckValue` compares.
#[derive(Clone, Copy, PartialEq)]
enum Term {
    Entry(EntryId),
    Number(f64),
}

/// Whether the conditions of a cycle never hold together: one value above a limit and below another one.
pub(super) fn contradict(view: &View<'_>, cycle: &[Edge]) -> bool {
    let is_written = |term: Term| {
        let mut outputs = cycle.iter().flat_map(|edge| view.writes(edge.cause));
        matches!(term, Term::Entry(entry) if outputs.any(|output| output.entry == entry))
    };
    let all = cycle.iter().filter_map(|edge| less(view, edge.cause));
    let mut less: Vec<_> = all.filter(|(a, b)| !is_written(*a) && !is_written(*b)).collect();
    less.dedup();
    less.iter().any(|(least, _)| is_above(&less, *least))
}

/// Whether a term would have to be less than itself, or a number than one that is not greater.
fn is_above(less: &[(Term, Term)], least: Term) -> bool {
    let (mut known, mut next) = (vec![least], 0);
    while let Some(term) = known.get(next).copied() {
        next += 1;
        for (_, greater) in less.iter().filter(|(smaller, _)| *smaller == term) {
            let impossible = match (least, *greater) {
                (Term::Number(least), Term::Number(greater)) => least >= greater,
                (least, greater) => least == greater,
            };
            if impossible {
                return true;
            }
            if !known.contains(greater) {
                known.push(*greater);
            }
        }
    }
    false
}

/// Which of the two that a `CheckValue` compares is less than which, when its event comes.
fn less(view: &View<'_>, cause: Cause) -> Option<(Term, Term)> {
    let Cause::Event(id, event) = cause else { return None };
    let supervisor = view.supervisor(id);
    standard(view, supervisor).filter(|name| *name == "CheckValue")?;
    let [value, limit] = supervisor.inputs.as_slice() else { return None };
    let (value, limit) = (term(view, value)?, term(view, limit)?);
    Some(if event == BELOW { (value, limit) } else { (limit, value) })
}

fn term(view: &View<'_>, formula: &Formula) -> Option<Term> {
    match view.constant(formula) {
        Some(Constant::Int(number)) => Some(Term::Number(number as f64)),
        Some(Constant::Float(number)) => Some(Term::Number(number)),
        Some(_) => None,
        None => entry(formula).map(Term::Entry),
    }
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
pub(crate) fn standard<'a>(view: &View<'a>, supervisor: &Supervisor) -> Option<&'a str> {
    standard_template(view, supervisor.template)
}

/// The name of a template, if it is one of the standard toolbox.
pub(super) fn standard_template<'a>(view: &View<'a>, id: TemplateId) -> Option<&'a str> {
    let toolbox = &view.model.toolboxes[id.toolbox.index()];
    (toolbox.name == "std").then(|| view.model.template(id).name.as_str())
}
