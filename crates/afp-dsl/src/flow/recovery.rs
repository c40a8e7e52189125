//! Supervisors that would restart their own recovery.
//!
//! An event of a global supervisor is not taken while its target is active, so during a lasting
//! condition the target can finish. Later elements that only this event leads to belong to the same
//! recovery, and there the event is taken: the recovery restarts endlessly. A computation takes no
//! time, so after a computation the first actor is already such an element. An element with another
//! reaction to the event (`on`) is an exception. Two conditions that hold together restart their
//! recoveries in turn.
//!
//! An event of a local supervisor is taken at each poll. If it lasts and leads to its own element,
//! the element restarts at each poll, and a robot that should move stays in place. Exceptions: the
//! event writes an entry, so the element may start with other values; the event occurs after some
//! time, which the element has; the element commands no device.

use std::collections::{BTreeMap, BTreeSet};

use crate::flow::cycles::facts;
use crate::flow::dataflow::{WIDTH, propagate};
use crate::flow::view::{Cause, Edge, Node, View};
use crate::graph::{Component, Element, SupervisorId};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;

/// An event of a global supervisor, and its target.
type Recovery = (SupervisorId, u16, Node);

/// The limit of reported pairs in a plan.
const MOST_PAIRS: usize = 20;

/// Warns of each such event, at its edge.
pub(super) fn check(view: &View<'_>, diags: &mut Diagnostics) {
    start_over(view, diags);
    let recoveries = recoveries(view);
    let recoveries: Vec<_> = recoveries.into_iter().collect();
    let mut reported = BTreeSet::new();
    for group in recoveries.chunks(WIDTH) {
        let mut stops = vec![0u64; view.edges.len()];
        for (bit, (_, edges)) in group.iter().enumerate() {
            edges.iter().for_each(|at| stops[*at] = 1 << bit);
        }
        let without = propagate(view, u64::MAX, &stops);
        for (bit, (recovery, edges)) in group.iter().enumerate() {
            let edge = edges.last().map(|at| view.edges[*at]);
            if report(view, *recovery, edge, |node| without[node] >> bit & 1 == 0, diags) {
                reported.insert(*recovery);
            }
        }
    }
    alternate(view, &recoveries, &reported, diags);
}

/// The edges of each recovery; those that apply to most elements come last.
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
    let (id, event) = event_of(edge.cause)?;
    if view.supervisor(id).owner.is_some() {
        return None;
    }
    // An event marked `once` no longer holds during its recovery.
    (!view.is_once(id, event)).then_some((id, event, edge.to))
}

/// Warns of lasting events that restart the element that they interrupt.
fn start_over(view: &View<'_>, diags: &mut Diagnostics) {
    let own = view.edges.iter().filter(|edge| view.reached[edge.from] && edge.from == edge.to);
    for edge in own {
        let (Cause::Event(id, event), Some(element)) = (edge.cause, view.element(edge.to)) else {
            continue;
        };
        let writes = !view.may_write(edge.cause).is_empty();
        let goes_on = writes
            || edge.suspends
            || view.is_once(id, event)
            || comes_after_a_time(view, (id, event));
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

/// Whether a supervisor reports an event only after more than its period. The time restarts with its element.
fn comes_after_a_time(view: &View<'_>, event: (SupervisorId, u16)) -> bool {
    let period = view.supervisor(event.0).timing.period.as_secs_f64();
    facts::earliest(view, event, f64::INFINITY).is_some_and(|time| time > period)
}

/// Whether an element, or one inside it, commands a device of the robot and ends in a state.
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

/// Warns of two events that alternate while both hold: each ends the recovery of the other before
/// it is complete. Events of the recovery's own supervisors are omitted if the recovery is in
/// `reported`.
fn alternate(
    view: &View<'_>,
    all: &[(Recovery, Vec<usize>)],
    reported: &BTreeSet<Recovery>,
    diags: &mut Diagnostics,
) {
    let known: BTreeSet<(Node, Recovery)> =
        view.edges.iter().filter_map(|edge| Some((edge.from, recovery_of(view, edge)?))).collect();
    let holds = |node: Node, wanted: Recovery| {
        view.from(node).iter().any(|edge| match edge.cause {
            Cause::Active(_) => known.contains(&(edge.to, wanted)),
            _ => known.contains(&(node, wanted)),
        })
    };
    let mut told = BTreeSet::new();
    for (one, edges) in all {
        let Some(own) = edges.last().map(|edge| view.edges[*edge]) else { continue };
        let during = view.rests(one.2).into_iter().filter(|node| view.element(*node).is_some());
        for during in during {
            let local = view.from(during).iter().filter(|_| !reported.contains(one));
            let others = local.chain(view.of_globals(during));
            for other in others.filter(|it| it.to != during && lasts(view, one.0, it)) {
                let pair = BTreeSet::from([event_of(own.cause), event_of(other.cause)]);
                if told.len() == MOST_PAIRS || told.contains(&pair) {
                    continue;
                }
                let mut next = view.rests(other.to).into_iter();
                let next = next.find(|next| *next != during && holds(*next, *one));
                if let Some(next) = next.filter(|_| !facts::contradict(view, &[own, *other])) {
                    told.insert(pair);
                    diags.push(turns(view, (own.cause, next), (other.cause, during)));
                }
            }
        }
    }
}

fn event_of(cause: Cause) -> Option<(SupervisorId, u16)> {
    match cause {
        Cause::Event(id, event) | Cause::On(_, id, Some(event)) => Some((id, event)),
        _ => None,
    }
}

/// Whether an edge belongs to an event of a supervisor other than `one` that may hold from the
/// entry of an element on. Events of one supervisor have the order of their declaration.
fn lasts(view: &View<'_>, one: SupervisorId, edge: &Edge) -> bool {
    let Some((id, event)) = event_of(edge.cause) else { return false };
    let is_local = view.supervisor(id).owner.is_some();
    id != one && !view.is_once(id, event) && !(is_local && comes_after_a_time(view, (id, event)))
}

/// The diagnostic of two events, each with the element that would have to ignore it.
fn turns(view: &View<'_>, one: (Cause, Node), other: (Cause, Node)) -> Diagnostic {
    let (one, other) = match view.span(one.0) < view.span(other.0) {
        true => (one, other),
        false => (other, one),
    };
    let ((first, _), (next, _)) = (one, other);
    let ignored = |(cause, node): (Cause, Node)| {
        let (id, event) = event_of(cause).filter(|(id, _)| view.supervisor(*id).owner.is_none())?;
        let supervisor = view.supervisor(id);
        let event = &view.template(supervisor).outcomes.get(usize::from(event))?.name;
        let line = format!("on {} {{ {event} -> ignore }}", supervisor.name);
        Some(message!("'{}' in '{}'", line, view.node_name(node)))
    };
    // The supervisor that is declared first is usually more urgent.
    let help = match (ignored(other), ignored(one)) {
        (Some(late), Some(early)) => {
            message!("let one of them finish: write {}, or {}", late, early)
        }
        (Some(only), None) | (None, Some(only)) => message!("write {}", only),
        (None, None) => "lead one of them to 'terminate'".into(),
    };
    let (before, label) = (view.label(first), view.label(next));
    let message = message!(
        "once '{}' and '{}' hold, each ends the element that the other has started",
        before,
        label
    );
    Diagnostic::new(Code::E0309, view.span(next), message)
        .note(view.span(first), "this event may still hold")
        .help(help)
}

/// `only` tells which nodes only this event leads to. Returns whether it reported an error.
fn report(
    view: &View<'_>,
    wanted: Recovery,
    edge: Option<Edge>,
    only: impl Fn(usize) -> bool,
    diags: &mut Diagnostics,
) -> bool {
    let Some(edge) = edge else { return false };
    let Some(target) = view.element(edge.to).filter(|_| only(edge.to)) else { return false };
    let again = |node: usize| {
        let mut edges = view.of_globals(node);
        node != edge.to && only(node) && edges.any(|other| recovery_of(view, other) == Some(wanted))
    };
    let mut recovery = view.elements().filter(|(node, other)| other.takes_time() && again(*node));
    let Some((_, other)) = recovery.next() else { return false };
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
    true
}
