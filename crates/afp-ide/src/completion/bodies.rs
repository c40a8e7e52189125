//! What is written for a template or plan: an element or supervisor with its body and exits.

use crate::View;
use crate::describe::component_kind;
use crate::edit::Taken;
use afp_dsl::graph::EntryKind;
use afp_dsl::outline::{ComponentKind, Plan};
use afp_dsl::toolbox::Template;

/// A piece of what is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Piece {
    Text(String),
    /// A place to fill, with what stands there until then; may be empty.
    Hole(String),
}

/// Text without holes.
pub fn plain(text: &str) -> Vec<Piece> {
    vec![Piece::Text(text.to_owned())]
}

/// Bindings that must be there, and the exits.
struct Parts<'a> {
    required: Vec<&'a str>,
    exits: Vec<&'a str>,
}

/// What follows the name of a template: the inputs that need a value, and a body with an edge for
/// each exit. Lines below the first have no indentation but their own.
pub(crate) fn body_of_template(template: &Template) -> Vec<Piece> {
    let required = template.inputs.iter().filter(|port| port.default.is_none());
    let parts = Parts {
        required: required.map(|port| port.name.as_str()).collect(),
        exits: template.outcomes.iter().map(|outcome| outcome.name.as_str()).collect(),
    };
    body(&parts, component_kind(template.kind))
}

/// The same for a plan.
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
    let mut pieces = Vec::new();
    for (index, port) in parts.required.iter().enumerate() {
        let sign = if index == 0 { "(" } else { ", " };
        pieces.push(Piece::Text(format!("{sign}{port} = ")));
        pieces.push(Piece::Hole(String::new()));
    }
    let close = if parts.required.is_empty() { "" } else { ")" };
    let short = kind == ComponentKind::Supervisor && parts.exits.len() == 1;
    let (open, gap, end) = if short { (" {", " ", " }") } else { (" {\n", "    ", "}") };
    pieces.push(Piece::Text(format!("{close}{open}")));
    let width = parts.exits.iter().map(|exit| exit.len()).max().unwrap_or(0);
    for exit in &parts.exits {
        pieces.push(Piece::Text(format!("{gap}{exit:width$} -> ")));
        pieces.push(Piece::Hole(String::new()));
        if !short {
            pieces.push(Piece::Text("\n".to_owned()));
        }
    }
    pieces.push(Piece::Text(end.to_owned()));
    pieces
}

/// A name for what is made from a template: its own with a small first letter, or with a number behind
/// it where that is taken.
pub(crate) fn instance_name(template: &str, taken: &Taken) -> String {
    let mut letters = template.chars();
    let first = letters.next().map(|first| first.to_lowercase().to_string()).unwrap_or_default();
    taken.fresh(&format!("{first}{}", letters.as_str()))
}
