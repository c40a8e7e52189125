use std::sync::Arc;

use crate::graph::{
    Component, Element, ElementId, Graph, Plan, Supervisor, SupervisorId, Target, resuming,
    returning,
};
use crate::rows::ids::blocks;
use crate::rows::wanted::{elsewhere, wanted};
use crate::rows::{Rows, polling_order};
use afp_types::{Child, Duration, ElementKind, ElementRow, Range, SupervisorRow};

/// The tables of all plans of a graph, in order; `None` if a table has too many rows, which the
/// check has reported.
pub(crate) fn lower(graph: &Graph) -> Option<Vec<Arc<Rows>>> {
    let blocks = blocks(&graph.plans)?;
    let plans = graph.plans.iter().zip(&blocks);
    plans.map(|(plan, block)| rows(graph, plan, &block.children).map(Arc::new)).collect()
}

fn rows(graph: &Graph, plan: &Plan, children: &[Child]) -> Option<Rows> {
    let mut rows = Rows {
        start: plan.start,
        globals: plan.globals,
        entries: u16::try_from(plan.entries.len()).ok()?,
        elements: Vec::with_capacity(plan.elements.len()),
        supervisors: Vec::with_capacity(plan.supervisors.len()),
        reasons: plan.reasons.clone(),
        edges: Vec::new(),
        sweeps: Vec::new(),
    };
    let elsewhere = elsewhere(plan);
    let resuming = resuming(plan.elements.iter().map(Some));
    let returning = returning(plan.elements.iter().map(Some));
    let handlers = plan.handlers();
    let leads = resuming.into_iter().zip(&returning).zip(handlers);
    for ((element, child), ((resumes, returns), handler)) in
        plan.elements.iter().zip(children).zip(leads)
    {
        let polled = polled(plan, &elsewhere, (rows.elements.len(), element))?;
        let sweep = append(&mut rows.sweeps, polled)?;
        let row = add_element(&mut rows, graph, element, *child)?;
        rows.elements.push(ElementRow { resumes, returns: *returns, handler, sweep, ..row });
    }
    for (index, supervisor) in plan.supervisors.iter().enumerate() {
        let row = add_supervisor(&mut rows, plan, (supervisor, index), &returning)?;
        rows.supervisors.push(row);
    }
    for (supervisor, there) in elsewhere {
        let row = row_at(&mut rows, plan, supervisor, there)?;
        rows.supervisors.push(row);
    }
    Some(rows)
}

/// The row of a global supervisor while an element is active.
fn row_at(
    rows: &mut Rows,
    plan: &Plan,
    supervisor: SupervisorId,
    there: ElementId,
) -> Option<SupervisorRow> {
    let row = rows.supervisors.get(supervisor.index())?;
    let targets = plan.events_at(supervisor, there);
    let wanted = wanted(&targets, Some(there))?;
    let row = SupervisorRow { wanted, wanted_in_look: wanted, ..*row };
    if plan.elements[there.index()].reactions_to(supervisor).is_none() {
        return Some(row);
    }
    let events = append(&mut rows.edges, targets.into_iter().map(Some))?;
    Some(SupervisorRow { events, on_miss: plan.miss_at(supervisor, there), ..row })
}

/// The row of an element, without plan-wide parts.
fn add_element(
    rows: &mut Rows,
    graph: &Graph,
    element: &Element,
    child: Child,
) -> Option<ElementRow> {
    let (kind, nanos) = match element.component {
        Component::Actor(id) => (ElementKind::Actor, graph.template(id).every),
        Component::Computation(_) => (ElementKind::Computation, 0),
        Component::SubPlan(_) => (ElementKind::SubPlan, 0),
    };
    let states = append(&mut rows.edges, element.states.iter().copied())?;
    let first = element.supervisors.first().map_or(0, |id| id.0);
    let len = u16::try_from(element.supervisors.len()).ok()?;
    Some(ElementRow {
        kind,
        period: Duration::from_nanos(nanos),
        states,
        on_error: element.on_error,
        resumes: false,
        returns: false,
        handler: false,
        locals: Range { first, len },
        sweep: Range::default(),
        child,
    })
}

/// Rows of the supervisors that are polled while an element is active: its own and the global ones.
fn polled(
    plan: &Plan,
    elsewhere: &[(SupervisorId, ElementId)],
    (index, element): (usize, &Element),
) -> Option<Vec<u16>> {
    if !element.takes_time() {
        return Some(Vec::new());
    }
    let globals = (0..plan.globals).map(SupervisorId);
    let ids = polling_order(plan, globals.chain(element.supervisors.iter().copied()));
    let here = ElementId(u16::try_from(index).ok()?);
    let row = |id: SupervisorId| match elsewhere.binary_search(&(id, here)) {
        Ok(behind) => u16::try_from(plan.supervisors.len() + behind).ok(),
        Err(_) => Some(id.0),
    };
    ids.into_iter().map(row).collect()
}

fn add_supervisor(
    rows: &mut Rows,
    plan: &Plan,
    (supervisor, index): (&Supervisor, usize),
    returning: &[bool],
) -> Option<SupervisorRow> {
    let index = u16::try_from(index).ok()?;
    // A handler takes time, so its own supervisors do not return in the look.
    let returns = |target: &Target| match target {
        Target::Return => true,
        Target::Element(id) => returning.get(id.index()) == Some(&true),
        _ => false,
    };
    let in_look = supervisor.events.iter();
    let in_look = in_look.map(|to| if returns(to) { Target::Ignore } else { *to });
    let wanted_in_look = wanted(&Vec::from_iter(in_look), supervisor.owner)?;
    let slot = match supervisor.owner {
        None => index,
        Some(owner) => {
            let first = plan.elements.get(owner.index())?.supervisors.first()?;
            plan.globals.checked_add(index.checked_sub(first.0)?)?
        }
    };
    Some(SupervisorRow {
        instance: SupervisorId(index),
        timing: supervisor.timing,
        slot,
        events: append(&mut rows.edges, supervisor.events.iter().copied().map(Some))?,
        on_miss: supervisor.on_miss,
        wanted: wanted(&supervisor.events, None)?,
        wanted_in_look,
    })
}

/// Appends rows to a shared table and returns their range.
fn append<T>(table: &mut Vec<T>, rows: impl IntoIterator<Item = T>) -> Option<Range> {
    let first = table.len();
    table.extend(rows);
    let (first, end) = (u16::try_from(first).ok()?, u16::try_from(table.len()).ok()?);
    Some(Range { first, len: end - first })
}
