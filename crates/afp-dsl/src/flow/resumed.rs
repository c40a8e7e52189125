//! Writes of events that lead to `resume`, and their readers.
//!
//! The continuing element and its supervisors were started with their inputs, so only `live` ports
//! see later writes.

use std::collections::BTreeSet;

use crate::flow::view::{Cause, Node, View};
use crate::graph::{
    Component, Element, ElementId, EntryId, EntryKind, Formula, Supervisor, SupervisorId, Target,
    chain,
};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Words};
use afp_syntax::message;
use afp_syntax::source::Span;

const GOES_ON: (&str, &str) =
    ("goes on", "use a template whose port is 'live', or lead the event to an element");
const SUSPENDED: (&str, &str) =
    ("is suspended", "use a template whose port is 'live', or write to a different entry");

/// Warns of resuming events without writes, and of inputs read once from entries that are written
/// while the element continues.
pub(super) fn check(view: &View<'_>, diags: &mut Diagnostics) {
    let globals = || (0..view.plan.globals).map(SupervisorId);
    let of_all = written(view, globals().flat_map(|id| own(view, id)), diags);
    for (node, element) in view.elements().filter(|(_, element)| element.takes_time()) {
        let mut changed =
            written(view, element.supervisors.iter().flat_map(|id| own(view, *id)), diags);
        if element.reactions.is_empty() {
            changed.extend(&of_all);
        } else {
            changed.extend(written(view, replacing(node, element), diags));
            let kept = globals().flat_map(|id| kept(view, element, id));
            // Errors of these are reported once.
            changed.extend(written(view, kept, &mut Diagnostics::default()));
        }
        let suspended = while_suspended(view, node, None);
        if changed.is_empty() && suspended.is_empty() {
            continue;
        }
        for (formula, port) in once(view, element) {
            frozen(view, formula, port, (&element.name, GOES_ON), &changed, diags);
            let only: BTreeSet<_> = suspended.difference(&changed).copied().collect();
            frozen(view, formula, port, (&element.name, SUSPENDED), &only, diags);
        }
        for id in &element.supervisors {
            let supervisor = view.supervisor(*id);
            for (formula, port) in of_template(view, supervisor) {
                frozen(view, formula, port, (&element.name, GOES_ON), &changed, diags);
            }
            if !view.template(supervisor).resumable {
                continue;
            }
            let suspended = while_suspended(view, node, Some(*id));
            let only: BTreeSet<_> = suspended.difference(&changed).copied().collect();
            for (formula, port) in of_template(view, supervisor) {
                frozen(view, formula, port, (&element.name, SUSPENDED), &only, diags);
            }
        }
    }
}

/// Entries that may be written between the suspension of an element and its continuation. For one of
/// its supervisors, only suspensions by other supervisors count: after its own event it starts again
/// and reads the new values.
fn while_suspended(view: &View<'_>, node: Node, of: Option<SupervisorId>) -> BTreeSet<EntryId> {
    let mut written = BTreeSet::new();
    for aside in view.asides.iter().filter(|aside| aside.element == node) {
        let edge = &view.edges[aside.edge];
        if let Cause::Event(by, _) | Cause::Miss(by) = edge.cause
            && of == Some(by)
        {
            continue;
        }
        written.extend(view.may_write(edge.cause).iter().map(|output| output.entry));
        let Some(handler) = view.element(aside.handler) else { continue };
        let reactions = handler.reactions.iter();
        let reactions = reactions.filter(|it| it.targets().any(|to| to == Target::Return));
        let supervisors =
            handler.supervisors.iter().copied().chain(reactions.map(|it| it.supervisor));
        let of_supervisors = supervisors.flat_map(|id| &view.supervisor(id).outputs);
        let before = chain(&view.plan.elements, target(view, edge.to)).0;
        let after = view.from(aside.handler).iter().filter(|edge| !edge.suspends);
        let after = after.flat_map(|edge| chain(&view.plan.elements, target(view, edge.to)).0);
        let computed = before.into_iter().chain(after);
        let computed = computed.flat_map(|id| &view.plan.elements[id.index()].outputs);
        let outputs = handler.outputs.iter().chain(of_supervisors).chain(computed);
        written.extend(outputs.map(|output| output.entry));
    }
    written
}

/// The node of an edge as a target; an ending is not followed.
fn target(view: &View<'_>, node: Node) -> Target {
    match (view.element(node), u16::try_from(node)) {
        (Some(_), Ok(id)) => Target::Element(ElementId(id)),
        _ => Target::Terminate,
    }
}

fn own(view: &View<'_>, id: SupervisorId) -> Vec<(Cause, Target)> {
    let supervisor = view.supervisor(id);
    let events = (0..).zip(&supervisor.events);
    let events = events.map(|(event, target)| (Cause::Event(id, event), *target));
    events.chain(supervisor.on_miss.map(|to| (Cause::Miss(id), to))).collect()
}

/// Edges of a global supervisor that are effective while an element is active.
fn kept(view: &View<'_>, element: &Element, id: SupervisorId) -> Vec<(Cause, Target)> {
    let mut edges = own(view, id);
    if let Some(table) = element.reactions_to(id) {
        edges.retain(|(cause, _)| match cause {
            Cause::Event(_, event) => table.target(Some(*event)).is_none(),
            _ => table.on_miss.is_none(),
        });
    }
    edges
}

/// The edges by which an element replaces global ones.
fn replacing(node: Node, element: &Element) -> impl Iterator<Item = (Cause, Target)> {
    let tables = element.reactions.iter().flat_map(|table| {
        let events = (0..).map(Some).take(table.events.len()).chain([None]);
        events.filter_map(move |event| Some((table.supervisor, event, table.target(event)?)))
    });
    let id = u16::try_from(node).ok().map(ElementId);
    tables.filter_map(move |(supervisor, event, to)| Some((Cause::On(id?, supervisor, event), to)))
}

/// Entries that edges write without interrupting; warns of edges without writes.
fn written(
    view: &View<'_>,
    edges: impl Iterator<Item = (Cause, Target)>,
    diags: &mut Diagnostics,
) -> BTreeSet<EntryId> {
    let mut written = BTreeSet::new();
    for (cause, target) in edges {
        let (run, _) = chain(&view.plan.elements, target);
        let resumes = target == Target::Resume || run.iter().any(|id| view.resumes(id.index()));
        if !resumes {
            continue;
        }
        let computed = run.iter().flat_map(|id| &view.plan.elements[id.index()].outputs);
        let before = written.len();
        let own: Vec<_> = view.writes(cause).map(|output| output.entry).collect();
        let nothing = own.is_empty() && run.is_empty();
        written.extend(own.into_iter().chain(computed.map(|output| output.entry)));
        if nothing && written.len() == before {
            let message = message!("'{}' resumes, but nothing has been written", view.label(cause));
            diags.push(
                Diagnostic::new(Code::E0316, view.span(cause), message)
                    .help("write 'ignore', which has the same effect, or lead the event to a computation that writes"),
            );
        }
    }
    written
}

/// The inputs that an element reads once, at its start, with the declarations of their ports.
fn once<'a>(view: &View<'a>, element: &'a Element) -> Vec<(&'a Formula, Span)> {
    match element.component {
        Component::Actor(id) | Component::Computation(id) => {
            let ports = &view.model.template(id).inputs;
            let ports = ports.iter().zip(&element.inputs).filter(|(port, _)| !port.live);
            ports.map(|(port, formula)| (formula, port.span)).collect()
        }
        Component::SubPlan(id) => {
            let Some(Some(plan)) = view.model.plans.get(id.index()) else { return Vec::new() };
            let ports = plan.entries.iter().filter(|entry| entry.kind == EntryKind::In);
            let ports = ports.zip(&element.inputs).filter(|(port, _)| !port.live);
            ports.map(|(port, formula)| (formula, port.span)).collect()
        }
    }
}

fn of_template<'a>(view: &View<'a>, supervisor: &'a Supervisor) -> Vec<(&'a Formula, Span)> {
    let ports = &view.template(supervisor).inputs;
    let ports = ports.iter().zip(&supervisor.inputs).filter(|(port, _)| !port.live);
    ports.map(|(port, formula)| (formula, port.span)).collect()
}

fn frozen(
    view: &View<'_>,
    formula: &Formula,
    port: Span,
    (name, (when, help)): (&str, (&str, &'static str)),
    changed: &BTreeSet<EntryId>,
    diags: &mut Diagnostics,
) {
    for (entry, span) in formula.entries().filter(|(entry, _)| changed.contains(entry)) {
        let entry = &view.plan.entries[entry.index()].name;
        let message = message!(
            "'{}' is read once, when '{}' starts, but changes while it {}",
            entry,
            name,
            Words(when)
        );
        diags.push(
            Diagnostic::new(Code::E0301, span, message)
                .note(port, "the port is not 'live'")
                .help(help),
        );
    }
}
