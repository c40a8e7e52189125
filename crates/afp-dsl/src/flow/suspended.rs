//! Suspended elements: they can continue, their handlers return, and no lasting event starts them
//! again in the meantime.

use std::collections::{BTreeMap, BTreeSet};

use crate::flow::lasting;
use crate::flow::view::{Cause, Node, View};
use crate::graph::{Component, Element};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Message};
use afp_syntax::message;
use afp_syntax::source::Span;

/// Maximum number of notes about other elements.
const MAX_NOTES: usize = 3;

/// An actor that cannot continue after an interruption.
#[derive(Clone, Debug)]
pub(crate) struct Rigid {
    /// Its path from the plan.
    path: String,
    template: String,
    span: Span,
    /// The declaration of the template.
    declared: Span,
}

pub(super) fn check(view: &View<'_>, diags: &mut Diagnostics) {
    if view.handlers.is_empty() {
        return;
    }
    cannot_continue(view, diags);
    never_returns(view, diags);
    starts_again(view, diags);
}

/// A reachable actor of a plan that cannot continue after an interruption.
pub(super) fn rigid(view: &View<'_>) -> Option<Rigid> {
    view.elements().find_map(|(_, element)| rigid_in(view, element))
}

/// The actor that cannot continue: an element itself, or an actor inside.
fn rigid_in(view: &View<'_>, element: &Element) -> Option<Rigid> {
    match element.component {
        Component::Actor(id) => {
            let template = view.model.template(id);
            let (path, span) = (element.name.clone(), element.span);
            let (name, declared) = (template.name.clone(), template.span);
            (!template.resumable).then_some(Rigid { path, template: name, span, declared })
        }
        Component::Computation(_) => None,
        Component::SubPlan(_) => {
            let inner = view.summary(element)?.rigid.as_ref()?;
            Some(Rigid { path: format!("{}.{}", element.name, inner.path), ..inner.clone() })
        }
    }
}

/// Reports each event that would suspend an element that cannot continue, with all such elements.
fn cannot_continue(view: &View<'_>, diags: &mut Diagnostics) {
    let mut wrong: BTreeMap<usize, BTreeSet<Node>> = BTreeMap::new();
    for aside in &view.asides {
        let is_rigid = view.element(aside.element).is_some_and(|it| rigid_in(view, it).is_some());
        if is_rigid {
            wrong.entry(aside.edge).or_default().insert(aside.element);
        }
    }
    for (edge, elements) in wrong {
        let edge = &view.edges[edge];
        let found = elements.iter().filter_map(|node| {
            let element = view.element(*node)?;
            Some((element, rigid_in(view, element)?))
        });
        let mut found = found.collect::<Vec<_>>().into_iter();
        let Some((element, first)) = found.next() else { continue };
        let line = format!("actor {} resumable", first.template);
        let message = message!(
            "'{}' would suspend '{}', but '{}' cannot continue later",
            view.label(edge.cause),
            first.path,
            first.template
        );
        let error = Diagnostic::new(Code::E0321, view.span(edge.cause), message)
            .note(first.span, "this actor starts from the beginning each time")
            .note(
                first.declared,
                message!("a toolbox declares a template that can continue as '{}'", line),
            );
        let error = found.take(MAX_NOTES).fold(error, |error, (_, other)| {
            error.note(other.span, message!("it would suspend '{}', too", other.path))
        });
        diags.push(error.help(instead(view, edge.cause, element)));
    }
}

fn instead(view: &View<'_>, cause: Cause, element: &Element) -> Message {
    let (id, event) = match cause {
        Cause::Event(id, event) | Cause::On(_, id, Some(event)) => (id, Some(event)),
        Cause::Miss(id) | Cause::On(_, id, None) => (id, None),
        _ => return "lead it to an element without 'suspend'".into(),
    };
    let supervisor = view.supervisor(id);
    if supervisor.owner.is_some() || matches!(cause, Cause::On(..)) {
        return "lead it to an element without 'suspend'".into();
    }
    let outcomes = &view.template(supervisor).outcomes;
    let event = event.and_then(|event| outcomes.get(usize::from(event)));
    let event = event.map_or("DeadlineMissed", |event| &event.name);
    let line = format!("on {} {{ {event} -> ignore }}", supervisor.name);
    message!(
        "write '{}' in '{}', or lead the event to an element without 'suspend'",
        line,
        element.name
    )
}

/// Warns of each handler that never returns.
fn never_returns(view: &View<'_>, diags: &mut Diagnostics) {
    for node in view.handlers.iter().copied().filter(|node| !view.can_return(*node)) {
        let Some(handler) = view.element(node).filter(|it| !lasting::lasts(view, node, it)) else {
            continue;
        };
        let name = &handler.name;
        let message = message!("'{}' never returns to the element that it interrupts", name);
        let mut found = Diagnostic::new(Code::E0322, handler.span, message);
        if let Some(aside) = view.asides.iter().find(|aside| aside.handler == node) {
            let span = view.span(view.edges[aside.edge].cause);
            found = found.note(span, "the element that is suspended here never continues");
        }
        diags.push(found.help(message!("lead one of its states or events to 'return', or remove the word 'suspend' before '{}'", name)));
    }
}

/// Warns of lasting events of global supervisors that lead to a suspended element: during the
/// handler the event is taken, and the element starts again instead of continuing.
fn starts_again(view: &View<'_>, diags: &mut Diagnostics) {
    let mut told = BTreeSet::new();
    for aside in &view.asides {
        let (Some(element), Some(handler)) =
            (view.element(aside.element), view.element(aside.handler))
        else {
            continue;
        };
        // Two lasting events that take turns are reported as such.
        let by = view.edges[aside.edge].cause;
        if let Cause::Event(id, event) | Cause::On(_, id, Some(event)) = by
            && view.supervisor(id).owner.is_none()
            && !view.is_once(id, event)
        {
            continue;
        }
        for edge in view.of_globals(aside.handler).filter(|edge| !edge.suspends) {
            let (Cause::Event(id, event) | Cause::On(_, id, Some(event))) = edge.cause else {
                continue;
            };
            let is_there = view.rests(edge.to).contains(&aside.element);
            if !is_there || view.is_once(id, event) || !told.insert((id, event, aside.element)) {
                continue;
            }
            let label = view.label(edge.cause);
            let message = message!(
                "if '{}' still holds during '{}', it starts '{}' again",
                label,
                handler.name,
                element.name
            );
            let outcome = view.template(view.supervisor(id)).outcomes.get(usize::from(event));
            let outcome = outcome.map_or("", |event| &event.name);
            let line = format!("on {} {{ {outcome} -> ignore }}", view.supervisor(id).name);
            let note = message!("'{}' is suspended here", element.name);
            diags.push(
                Diagnostic::new(Code::E0323, view.span(edge.cause), message)
                    .note(view.span(by), note)
                    .help(message!(
                        "write '{}' in '{}', so that '{}' can continue",
                        line,
                        handler.name,
                        element.name
                    )),
            );
        }
    }
}
