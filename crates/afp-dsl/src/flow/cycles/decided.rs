//! The states of declared computations and readers of tables whose inputs are known.
//!
//! Known values are constants, initial values, bindings that all users of a sub-plan share, and
//! results of these computations.

use std::collections::{BTreeMap, BTreeSet};

use crate::flow::view::{Cause, Edge, Node, View};
use crate::graph::constant::{convert, evaluate};
use crate::graph::{Component, Element, EntryId, EntryKind, Formula, Output, PlanId};
use crate::table::Table;
use crate::toolbox::case::reached;
use crate::types::Constant;

pub(super) type Known = BTreeMap<EntryId, Constant>;

/// Maximum number of tracked entries; beyond it none is tracked.
const MOST: usize = 64;

/// The entries that such a computation reads, with their initial values.
pub(super) fn at_start(view: &View<'_>) -> Known {
    let mut read = BTreeSet::new();
    for (_, element) in view.elements().filter(|(_, it)| chooses_by_inputs(view, it)) {
        read.extend(element.inputs.iter().flat_map(Formula::entries).map(|(entry, _)| entry));
    }
    if read.is_empty() || read.len() > MOST {
        return Known::new();
    }
    let mut known = Known::new();
    let ins = (0..).map(EntryId).zip(&view.plan.entries).filter(|(_, it)| it.kind == EntryKind::In);
    known.extend(ins.enumerate().filter_map(|(at, (id, _))| Some((id, given(view, at)?))));
    for (id, entry, init) in view.plan.initial().filter(|(_, it, _)| it.kind != EntryKind::In) {
        let value = entry.value.clone().or_else(|| value_of(init, &known));
        known.extend(value.map(|value| (id, value)));
    }
    known.retain(|entry, _| read.contains(entry));
    known
}

/// The initial values that never change.
pub(super) fn for_ever(view: &View<'_>) -> Known {
    let mut known = at_start(view);
    let elements = view.plan.elements.iter().flat_map(|element| &element.outputs);
    let supervisors = view.plan.supervisors.iter().flat_map(|supervisor| &supervisor.outputs);
    elements.chain(supervisors).for_each(|output| _ = known.remove(&output.entry));
    known
}

/// The common binding of all users of the plan for an input.
fn given(view: &View<'_>, input: usize) -> Option<Constant> {
    let plans = &view.model.plans;
    let own = plans.iter().position(|plan| plan.is_some_and(|it| std::ptr::eq(it, view.plan)))?;
    let own = Component::SubPlan(PlanId(u16::try_from(own).ok()?));
    let mut all = None;
    for plan in plans {
        // The bindings of a plan with errors are unknown.
        let plan = (*plan)?;
        for element in plan.elements.iter().filter(|element| element.component == own) {
            let value = plan.constant(element.inputs.get(input)?)?;
            if all.get_or_insert_with(|| value.clone()) != &value {
                return None;
            }
        }
    }
    all
}

/// Whether a computation with these values takes a different edge.
pub(super) fn excludes(view: &View<'_>, cause: Cause, known: &Known) -> bool {
    let Cause::State(id, state) = cause else { return false };
    outcome(view, &view.plan.elements[id.index()], known).is_some_and(|decided| decided != state)
}

pub(super) fn after(view: &View<'_>, cause: Cause, known: &mut Known) {
    let values: Vec<_> =
        view.writes(cause).map(|output| written(view, cause, output, known)).collect();
    // A sub-plan may write more than its certain outputs.
    view.may_write(cause).iter().for_each(|output| _ = known.remove(&output.entry));
    known.extend(values.into_iter().flatten());
}

/// Whether a cycle ends by itself, or its number of rounds is unknown: a computation on it chooses
/// another edge, or depends on a value that the cycle changes.
pub(super) fn breaks_off(view: &View<'_>, cycle: &[Edge], constants: &Known) -> bool {
    let mut known = constants.clone();
    cycle.iter().for_each(|edge| after(view, edge.cause, &mut known));
    let outputs = cycle.iter().flat_map(|edge| view.writes(edge.cause));
    let changed: BTreeSet<_> = outputs.map(|output| output.entry).collect();
    cycle.iter().any(|edge| {
        let breaks = chooses_by(view, edge, &changed, &known);
        after(view, edge.cause, &mut known);
        breaks
    })
}

/// Whether a computation takes a different edge, or may do so because of changed values.
fn chooses_by(view: &View<'_>, edge: &Edge, changed: &BTreeSet<EntryId>, known: &Known) -> bool {
    let Cause::State(id, state) = edge.cause else { return false };
    let element = &view.plan.elements[id.index()];
    let is_choice = is_choice(element, state);
    // The counter's limit is already known.
    if element.takes_time() || !is_choice || view.counters().has(id) {
        return false;
    }
    match outcome(view, element, known) {
        Some(decided) => decided != state,
        None => {
            let mut read = element.inputs.iter().flat_map(Formula::entries);
            read.any(|(entry, _)| changed.contains(&entry))
        }
    }
}

/// Whether an element has a different target in another state.
pub(super) fn is_choice(element: &Element, state: u16) -> bool {
    let mut others = element.states.iter().flatten();
    others.any(|target| Some(target) != element.states[usize::from(state)].as_ref())
}

/// Whether a computation depends only on its inputs.
pub(super) fn chooses_by_inputs(view: &View<'_>, element: &Element) -> bool {
    view.cases(element).is_some() || table(view, element).is_some()
}

/// The state of a computation with these values.
pub(super) fn outcome(view: &View<'_>, element: &Element, known: &Known) -> Option<u16> {
    let value = |input: u16| value_of(element.inputs.get(usize::from(input))?, known);
    if let Some(cases) = view.cases(element) {
        return reached(cases, &value);
    }
    let rows = rows(view, element)?;
    match value(0)? {
        Constant::Int(index) if index >= 0 => Some(u16::from(index >= rows)),
        _ => None,
    }
}

/// The edge of a computation with these values, if known.
pub(super) fn next<'v>(view: &'v View<'_>, node: Node, known: &Known) -> Option<&'v Edge> {
    let decided = outcome(view, view.element(node)?, known);
    let states = view.from(node).iter();
    let mut taken = states.filter(|edge| match (edge.cause, decided) {
        (Cause::State(_, state), Some(decided)) => state == decided,
        (Cause::State(..), None) => edge.possible,
        _ => false,
    });
    let first = taken.next()?;
    taken.all(|other| other.to == first.to).then_some(first)
}

/// The value that an output writes on an edge.
fn written(
    view: &View<'_>,
    cause: Cause,
    output: &Output,
    known: &Known,
) -> Option<(EntryId, Constant)> {
    let Cause::State(id, state) = cause else { return None };
    let element = &view.plan.elements[id.index()];
    let value = |input: u16| value_of(element.inputs.get(usize::from(input))?, known);
    let value = match (view.cases(element), state) {
        (Some(cases), _) => cases.get(usize::from(state))?.written(output.port, &value)?,
        (None, 0) => cell(view, element, value(0)?, output.port)?,
        _ => return None,
    };
    let value = match &output.conversion {
        Some(conversion) => convert(conversion, value).ok()?,
        None => value,
    };
    Some((output.entry, value))
}

fn value_of(formula: &Formula, known: &Known) -> Option<Constant> {
    evaluate(formula, &|entry| known.get(&EntryId(entry)).cloned()).ok()?
}

/// How many rows the table of an element has.
fn rows(view: &View<'_>, element: &Element) -> Option<i64> {
    i64::try_from(table(view, element)?.rows.len()).ok()
}

fn cell(view: &View<'_>, element: &Element, index: Constant, column: u16) -> Option<Constant> {
    let Constant::Int(index) = index else { return None };
    let row = table(view, element)?.rows.get(usize::try_from(index).ok()?)?;
    Some(row.get(usize::from(column))?.value.clone())
}

fn table<'a>(view: &View<'a>, element: &Element) -> Option<&'a Table> {
    let Component::Computation(id) = element.component else { return None };
    view.model.template(id).reads_table.as_ref()?.table.as_deref()
}
