//! Facts of supervisors: the condition of an event, and events that exclude each other.

use std::sync::Arc;

use super::condition::condition;
use super::ports::misfit;
use crate::check::formula::Scope;
use crate::check::head::EntryDraft;
use crate::check::names::{Indices, unknown};
use crate::graph::{EntryKind, Formula, Op};
use crate::toolbox::{Case, Condition, Fact, Template, TemplateKind};
use crate::types::{Dimension, Type};
use afp_syntax::ast::{self, Name, Part};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;

/// Reads the facts of a template. `cases` contains the conditions of its events, in their order.
pub(super) fn read(
    parts: &[Part],
    events: &[(&ast::Outcome, Name)],
    cases: Vec<Case>,
    (scope, template): (&Scope<'_>, &Template),
    diags: &mut Diagnostics,
) -> Arc<[Fact]> {
    let mut facts = Vec::new();
    for (event, ((node, name), case)) in (0..).zip(events.iter().zip(cases)) {
        let after = node.after().and_then(|(_, formula)| formula);
        let time = after.and_then(|formula| time(&formula, (scope, template), diags));
        if fits(node, name, diags) {
            facts.extend((!case.when.is_empty()).then_some(Fact::When(event, case.when)));
            facts.extend(time.map(|time| Fact::After(event, time)));
        }
    }
    let exclusive = parts.iter().filter_map(|part| match part {
        Part::Exclusive(node) => Some(node),
        _ => None,
    });
    for node in exclusive {
        if template.kind == TemplateKind::Supervisor {
            facts.extend(self::exclusive(node, scope, template, diags));
        } else {
            self::exclusive(node, scope, template, &mut Diagnostics::default());
            misfit("exclusive", "only a supervisor has events", node.span(), diags);
        }
    }
    facts.into()
}

/// Whether an event may have a fact: it has at most one, and none if it is marked `once`.
fn fits(node: &ast::Outcome, name: &Name, diags: &mut Diagnostics) -> bool {
    let (when, after) = (node.when(), node.after());
    let second = match (&when, &after) {
        (Some((span, _)), Some(_)) => Some(*span),
        _ => None,
    };
    let first = after.map(|(span, _)| span).or(when.map(|(span, _)| span));
    let (span, message, help) = match (first, second) {
        (Some(first), _) if node.once() => (
            first,
            message!("'{}' occurs once, so it cannot have a condition or a time", name.text),
            "remove 'once', or remove the condition or time",
        ),
        (_, Some(second)) => {
            (second, message!("'{}' has a time and a condition", name.text), "remove one of them")
        }
        _ => return true,
    };
    diags.push(Diagnostic::new(Code::E0519, span, message).help(help));
    false
}

fn time(
    formula: &ast::Formula,
    (scope, template): (&Scope<'_>, &Template),
    diags: &mut Diagnostics,
) -> Option<Formula> {
    let duration = Type::Quantity(Dimension::DURATION);
    let (time, _) = scope.check(formula, Some(&duration), diags)?;
    let live = time.nodes().find_map(|node| match node.op {
        Op::Entry(id) => template.inputs.get(id.index()).filter(|port| port.live).zip(Some(node)),
        _ => None,
    });
    let Some((port, node)) = live else { return Some(time) };
    let message = message!("'{}' may change before the time is over", port.name);
    let error = Diagnostic::new(Code::E0519, node.note.span, message);
    diags.push(error.note(port.span, "read at every poll").help("remove 'live'"));
    None
}

/// Reads two events that exclude each other.
fn exclusive(
    node: &ast::Exclusive,
    scope: &Scope<'_>,
    template: &Template,
    diags: &mut Diagnostics,
) -> Option<Fact> {
    let names = node.events();
    let events: Vec<_> = names.iter().map(|name| event(name, scope, template, diags)).collect();
    let own = template.inputs.iter().map(|port| (port.name.clone(), port));
    let other = template.inputs.iter().map(|port| (format!("other.{}", port.name), port));
    let entries: Vec<_> = own
        .chain(other)
        .map(|(name, port)| EntryDraft::readable(&name, port.span, EntryKind::In, &port.ty))
        .collect();
    let names_of_both = entries.iter().map(|entry| Some(entry.name.text.as_str()));
    let scope = Scope { entries: &entries, indices: &Indices::of(names_of_both), ..*scope };
    let (when, compared) = node.when().unzip();
    let compared = compared.unwrap_or_default();
    let conditions: Vec<Condition> =
        compared.iter().filter_map(|one| condition(&scope, one, diags)).collect();
    let [first, second] = events[..] else { return None };
    let (first, second) = (first?, second?);
    if first == second && when.is_none() {
        let message = message!("'{}' would never hold in two supervisors", names[1].text);
        let error = Diagnostic::new(Code::E0519, names[1].span, message);
        diags.push(error.help("add 'when' and a comparison with a port of 'other'"));
        return None;
    }
    (conditions.len() == compared.len()).then_some(Fact::Exclusive([first, second], conditions))
}

fn event(
    name: &Name,
    scope: &Scope<'_>,
    template: &Template,
    diags: &mut Diagnostics,
) -> Option<u16> {
    let events = &template.outcomes;
    let Some(place) = events.iter().position(|event| event.name == name.text) else {
        scope.record.unknown(name.span);
        let known = events.iter().map(|event| event.name.as_str());
        let message = message!("the template has no event '{}'", name.text);
        let none = "declare it in the template";
        diags.push(unknown(Code::E0210, name.span, message, &name.text, known, none));
        return None;
    };
    scope.record.definition(name.span, events[place].span);
    u16::try_from(place).ok()
}
