//! Toggles by a lasting event: the target element is left by the same event at the next poll.
//!
//! A button press lasts for many polls. Some templates have a variant that reports a press once, so
//! that each press advances by one element.

use crate::flow::view::{Aside, Cause, Edge, Node, View};
use crate::graph::{SupervisorId, TemplateId};
use crate::toolbox::{Template, TemplateKind};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Message};
use afp_syntax::message;

/// Warns of each such event of a global supervisor once, at the edge back.
pub(super) fn check(view: &View<'_>, diags: &mut Diagnostics) {
    for id in (0..view.plan.globals).map(SupervisorId) {
        let template = view.supervisor(id).template;
        let Some(help) = once_instead(view, template) else { continue };
        let events = 0..view.model.template(template).outcomes.len() as u16;
        for event in events.filter(|event| !view.is_once(id, *event)) {
            suspends_and_returns(view, id, event, &help, diags);
            let mut round = view.elements().filter_map(|(node, _)| {
                let (there, to) = leads(view, node, id, event)?;
                let (back, again) = leads(view, to, id, event)?;
                let is_back = view.span(back.cause) > view.span(there.cause);
                (again == node && is_back).then_some((there, back, node, to))
            });
            let Some((there, back, from, to)) = round.next() else { continue };
            let (label, one, other) =
                (view.label(back.cause), view.node_name(from), view.node_name(to));
            let message = message!(
                "while '{}' lasts, it leads from '{}' to '{}' and back at every poll",
                label,
                one,
                other
            );
            diags.push(
                Diagnostic::new(Code::E0317, view.span(back.cause), message)
                    .note(view.span(there.cause), "this edge leads there")
                    .help(help.clone()),
            );
        }
    }
}

/// Warns of an event whose handler returns by the same event.
fn suspends_and_returns(
    view: &View<'_>,
    id: SupervisorId,
    event: u16,
    help: &Message,
    diags: &mut Diagnostics,
) {
    let is_it = |cause: Cause| match cause {
        Cause::Event(by, it) | Cause::On(_, by, Some(it)) => (by, it) == (id, event),
        _ => false,
    };
    let mut back = view.back.iter().filter(|edge| is_it(edge.cause));
    let there = |back: &Edge| {
        let own = |it: &&Aside| it.handler == back.from && it.element == back.to;
        view.asides.iter().filter(own).map(|it| view.edges[it.edge].cause).find(|it| is_it(*it))
    };
    let Some((back, there)) = back.find_map(|back| Some((back, there(back)?))) else {
        return;
    };
    let (label, element) = (view.label(back.cause), view.node_name(back.to));
    let message =
        message!("while '{}' lasts, it suspends '{}' and returns at every poll", label, element);
    diags.push(
        Diagnostic::new(Code::E0317, view.span(back.cause), message)
            .note(view.span(there), "this edge leads there")
            .help(help.clone()),
    );
}

/// The edge of an event while an element is active, and its target, possibly through computations.
fn leads<'v>(
    view: &'v View<'_>,
    node: Node,
    id: SupervisorId,
    event: u16,
) -> Option<(&'v Edge, Node)> {
    let is_it = |edge: &&Edge| match edge.cause {
        Cause::Event(by, it) | Cause::On(_, by, Some(it)) => (by, it) == (id, event),
        _ => false,
    };
    let edge = view.of_globals(node).find(is_it)?;
    let rests = view.rests(edge.to);
    let only = rests.first().filter(|only| rests.len() == 1 && **only != node)?;
    view.element(*only).map(|_| (edge, *only))
}

/// The alternative to a template with a lasting event: a template of the same toolbox that reports
/// it once, whose name begins with the first one's.
pub(super) fn once_instead(view: &View<'_>, id: TemplateId) -> Option<Message> {
    let lasting = view.model.template(id);
    let is_once = |it: &&Template| {
        it.kind == TemplateKind::Supervisor
            && it.name.len() > lasting.name.len()
            && it.name.starts_with(&lasting.name)
            && it.outcomes.iter().all(|event| event.once)
    };
    let toolbox = view.model.toolboxes.get(id.toolbox.index())?;
    let better = toolbox.templates.iter().find(is_once)?;
    let event = &better.outcomes.first()?.name;
    Some(message!("use '{}', whose event '{}' comes once", better.name, event))
}
