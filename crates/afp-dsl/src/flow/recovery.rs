//! Supervisors that would start their own recovery again.
//!
//! An event of a global supervisor is not taken while its target is active, so a lasting condition
//! lets one element finish. Elements behind it that only this event leads to are part of the same
//! recovery, and there it is taken: the recovery begins anew, for ever. A computation is over at once,
//! so behind one the first actor is such an element already. Where such an element reacts otherwise to
//! the event (`on`), it goes on. Two conditions that last alike start their recoveries in turns.
//!
//! An event of a local supervisor is taken at each poll, so one that lasts and leads to its own element starts that over and
//! over: a robot that moves stays where it is. Where it writes something, the element may start with other values, and where
//! it comes after some time, the element has that time. One that commands nothing waits until it is quiet.

use std::collections::{BTreeMap, BTreeSet};

use crate::flow::dataflow::{WIDTH, propagate};
use crate::flow::view::{Cause, Edge, Node, View};
use crate::graph::{Component, Element, SupervisorId};
use crate::types::{Dimension, Type};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;
use afp_types::Meaning;

/// An event of a global supervisor, and where it leads.
type Recovery = (SupervisorId, u16, Node);

/// Warns of each such event, at its edge.
pub(super) fn check(view: &View<'_>, diags: &mut Diagnostics) {
    start_over(view, diags);
    let recoveries = recoveries(view);
    let recoveries: Vec<_> = recoveries.into_iter().collect();
    alternate(view, &recoveries, diags);
    for group in recoveries.chunks(WIDTH) {
        let mut stops = vec![0u64; view.edges.len()];
        for (bit, (_, edges)) in group.iter().enumerate() {
            edges.iter().for_each(|at| stops[*at] = 1 << bit);
        }
        let without = propagate(view, u64::MAX, &stops);
        for (bit, (recovery, edges)) in group.iter().enumerate() {
            let edge = edges.last().map(|at| view.edges[*at]);
            report(view, *recovery, edge, |node| without[node] >> bit & 1 == 0, diags);
        }
    }
}

/// The edges of each recovery; those that hold for most elements come last.
fn recoveries(view: &View<'_>) -> BTreeMap<Recovery, Vec<usize>> {
    let mut recoveries: BTreeMap<Recovery, Vec<usize>> = BTreeMap::new();
    for (at, edge) in view.edges.iter().enumerate().filter(|(_, edge)| view.reached[edge.from]) {
        if let Some(recovery) = recovery_of(view, edge) {
            recoveries.entry(recovery).or_default().push(at);
        }
    }
    recoveries
}

fn recovery_of(view: &View<'_>, edge: &Edge) -> Option<Recovery> {
    let (id, event) = match edge.cause {
        Cause::Event(id, event) if view.is_shared(edge.from) => (id, event),
        Cause::On(_, id, Some(event)) => (id, event),
        _ => return None,
    };
    // What happens once holds no more while its recovery runs.
    (!view.is_once(id, event)).then_some((id, event, edge.to))
}

/// Warns of events that last, and start the element again that they interrupt.
fn start_over(view: &View<'_>, diags: &mut Diagnostics) {
    let own = view.edges.iter().filter(|edge| view.reached[edge.from] && edge.from == edge.to);
    for edge in own {
        let (Cause::Event(id, event), Some(element)) = (edge.cause, view.element(edge.to)) else {
            continue;
        };
        let writes = !view.may_write(edge.cause).is_empty();
        let goes_on = writes || view.is_once(id, event) || comes_after_a_time(view, id);
        if goes_on || !commands(view, element) {
            continue;
        }
        let (label, name) = (view.label(edge.cause), &element.name);
        let message =
            message!("'{}' starts '{}' again at every poll for as long as it lasts", label, name);
        let error = Diagnostic::new(Code::E0309, view.span(edge.cause), message);
        diags.push(error.help("write 'ignore', or lead it to another element"));
    }
}

/// Whether a supervisor takes a time, after which it may report: it begins anew with its element.
fn comes_after_a_time(view: &View<'_>, id: SupervisorId) -> bool {
    let template = view.template(view.supervisor(id));
    template.inputs.iter().any(|input| input.ty == Type::Quantity(Dimension::DURATION))
}

/// Whether an element, or one inside of it, commands a device of the robot until it has done something.
fn commands(view: &View<'_>, element: &Element) -> bool {
    let (mut open, mut seen) = (vec![element], BTreeSet::new());
    while let Some(element) = open.pop() {
        match element.component {
            Component::Actor(id)
                if !element.states.is_empty() && !view.model.template(id).uses.is_empty() =>
            {
                return true;
            }
            Component::SubPlan(id) if seen.insert(id.index()) => {
                let inner = view.model.plans.get(id.index()).copied().flatten();
                open.extend(inner.iter().flat_map(|plan| &plan.elements));
            }
            _ => {}
        }
    }
    false
}

/// Warns of events that hold for ever once they do, and replace what another such event has started, as that one does.
fn alternate(view: &View<'_>, all: &[(Recovery, Vec<usize>)], diags: &mut Diagnostics) {
    let lasts = |(id, ..): &Recovery| {
        view.template(view.supervisor(*id)).meaning == Some(Meaning::TimesOut)
    };
    let acts = |(.., to): &Recovery| view.element(*to).is_some_and(Element::takes_time);
    let lasting: Vec<_> = all.iter().filter(|(it, _)| lasts(it) && acts(it)).collect();
    let holds = |during: &Recovery, other: &Recovery| {
        view.of_globals(during.2).any(|edge| recovery_of(view, edge) == Some(*other))
    };
    for (at, (one, edges)) in lasting.iter().enumerate() {
        let other = lasting[..at]
            .iter()
            .find(|(other, _)| other.2 != one.2 && holds(one, other) && holds(other, one));
        let Some((_, others)) = other else { continue };
        let cause = |edges: &[usize]| edges.last().map(|edge| view.edges[*edge].cause);
        let (Some(one), Some(other)) = (cause(edges), cause(others)) else { continue };
        let (first, next) = (view.label(other), view.label(one));
        let message =
            message!("once '{}' and '{}' hold, each ends what the other has started", first, next);
        diags.push(
            Diagnostic::new(Code::E0309, view.span(one), message)
                .note(view.span(other), "both hold for ever")
                .help("let one of them be ignored in what the other leads to, with 'on', or lead it to 'terminate'"),
        );
    }
}

/// `only` tells which nodes can be reached by the event alone.
fn report(
    view: &View<'_>,
    wanted: Recovery,
    edge: Option<Edge>,
    only: impl Fn(usize) -> bool,
    diags: &mut Diagnostics,
) {
    let Some(edge) = edge else { return };
    let Some(target) = view.element(edge.to).filter(|_| only(edge.to)) else { return };
    let again = |node: usize| {
        let mut edges = view.of_globals(node);
        node != edge.to && only(node) && edges.any(|other| recovery_of(view, other) == Some(wanted))
    };
    let mut recovery = view.elements().filter(|(node, other)| other.takes_time() && again(*node));
    let Some((_, other)) = recovery.next() else { return };
    let label = view.label(edge.cause);
    let (first, next) = (&target.name, &other.name);
    let message = message!(
        "'{}' leads to '{}', and starts it again while '{}' runs after it",
        label,
        first,
        next
    );
    diags.push(
        Diagnostic::new(Code::E0309, view.span(edge.cause), message)
            .note(other.span, "only this event leads here, and it may still hold")
            .help(message!("put '{}' and '{}' into one sub-plan and lead the event to it, or ignore the event in '{}' with 'on'", first, next, next)),
    );
}
