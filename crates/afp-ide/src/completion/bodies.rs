//! The text of an element or supervisor for a template or plan, with body and exits.

use crate::View;
use crate::describe::component_kind;
use crate::edit::Taken;
use afp_dsl::graph::EntryKind;
use afp_dsl::outline::{ComponentKind, Plan};
use afp_dsl::toolbox::Template;

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Piece {
    Text(String),
    /// A placeholder with its initial text, which may be empty.
    Hole(String),
}

pub fn plain(text: &str) -> Vec<Piece> {
    vec![Piece::Text(text.to_owned())]
}

/// Text with placeholders, marked by `‹›`.
pub(crate) fn with_holes(text: &str) -> Vec<Piece> {
    let parts = text.split(['‹', '›']).enumerate();
    let parts = parts.filter(|(index, text)| index % 2 == 1 || !text.is_empty());
    let piece = |(index, text): (usize, &str)| match index % 2 {
        0 => Piece::Text(text.to_owned()),
        _ => Piece::Hole(text.to_owned()),
    };
    parts.map(piece).collect()
}

/// The text of a component: keyword, a placeholder for its name, template and body.
pub(crate) fn component(
    kind: ComponentKind,
    name: &str,
    made_from: &str,
    body: &[Piece],
) -> Vec<Piece> {
    let mut pieces = with_holes(&format!("{} ‹{name}›: {made_from}", kind.keyword()));
    pieces.extend_from_slice(body);
    pieces
}

struct Parts<'a> {
    required: Vec<&'a str>,
    exits: Vec<&'a str>,
}

/// The text after the name of a template: the required inputs, and a body with an edge for each
/// exit. Later lines have only their relative indentation.
pub(crate) fn body_of_template(template: &Template) -> Vec<Piece> {
    let required = template.inputs.iter().filter(|port| port.default.is_none());
    let parts = Parts {
        required: required.map(|port| port.name.as_str()).collect(),
        exits: template.outcomes.iter().map(|outcome| outcome.name.as_str()).collect(),
    };
    body(&parts, component_kind(template.kind))
}

/// The same text for a plan.
pub(crate) fn body_of_plan(view: &View, plan: &Plan) -> Vec<Piece> {
    let text = |name: &afp_syntax::ast::Name| view.text_of(name.span);
    let required = plan.entries.iter().filter(|it| it.kind == EntryKind::In && it.init.is_none());
    let mut exits = vec!["OK"];
    if plan.interruptible {
        exits.push("Interrupted");
    }
    let required = required.filter_map(|entry| entry.name.as_ref()).map(text).collect();
    body(&Parts { required, exits }, ComponentKind::SubPlan)
}

fn body(parts: &Parts<'_>, kind: ComponentKind) -> Vec<Piece> {
    let ports: Vec<_> = parts.required.iter().map(|port| format!("{port} = ‹›")).collect();
    let args = if ports.is_empty() { String::new() } else { format!("({})", ports.join(", ")) };
    let short = kind == ComponentKind::Supervisor && parts.exits.len() == 1;
    let (open, end) = if short { (" {", " }") } else { (" {\n", "}") };
    let (before, behind) = if short { (" ", "") } else { ("    ", "\n") };
    let width = parts.exits.iter().map(|exit| exit.len()).max().unwrap_or(0);
    let edge = |exit: &&str| format!("{before}{exit:width$} -> ‹›{behind}");
    let exits: String = parts.exits.iter().map(edge).collect();
    with_holes(&format!("{args}{open}{exits}{end}"))
}

/// A name for an instance: the template's in lower case, with a number if it is taken.
pub(crate) fn instance_name(template: &str, taken: &Taken) -> String {
    let mut letters = template.chars();
    let first = letters.next().map(|first| first.to_lowercase().to_string()).unwrap_or_default();
    taken.fresh(&format!("{first}{}", letters.as_str()))
}
