//! Fragments of text in a change: each is parsed in its context first, so that it cannot contain
//! more than expected.

use super::Refused;
use super::list::dedented;
use super::tree::{below, children, is_comment, keyword, solid_range};
use afp_format::format;
use afp_syntax::diagnostics::{Diagnostic, Diagnostics, Severity};
use afp_syntax::kind::Kind;
use afp_syntax::{Node, parse};

pub(super) fn formula(text: &str) -> Result<(), Refused> {
    read("plan P { const x = ", text, " }", "a formula", |item| {
        item.children().find(|child| !matches!(child.kind(), Kind::Type | Kind::Error))
    })
}

pub(super) fn ty(text: &str) -> Result<(), Refused> {
    read("plan P { var x: ", text, " }", "a type", |item| children(item, Kind::Type).next())
}

/// Checks a time such as `10 ms`, or the name of a constant.
pub(super) fn time(text: &str) -> Result<(), Refused> {
    read("plan P { supervise x: X every ", text, " {} }", "a time", |item| {
        let timing = children(item, Kind::Timing).next()?;
        timing.children().find(|value| matches!(value.kind(), Kind::Literal | Kind::Ref))
    })
}

/// Checks the name of a template or plan, with or without a toolbox.
pub(super) fn reference(text: &str) -> Result<(), Refused> {
    read("plan P { actor x: ", text, " {} }", "the name of a template", |item| {
        children(item, Kind::Ref).next()
    })
}

/// Checks the condition of a state: comparisons with `and` between them.
pub(super) fn condition(text: &str) -> Result<(), Refused> {
    let before = "computation C { state S when ";
    let refused = || Refused::new(format!("'{text}' is not a condition"));
    let root = without_errors(&format!("{before}{text} {{}} }}")).map_err(|_| refused())?;
    let mut conditions = below(&root, Kind::When);
    let end = conditions.next().and_then(|when| solid_range(&when)).map(|range| range.end);
    let mut tokens = root.descendants_with_tokens().filter_map(|each| each.into_token());
    let plain = !text.contains('\n') && !tokens.any(|token| is_comment(&token));
    match plain && end == Some(before.len() + text.trim_end().len()) {
        true => Ok(()),
        false => Err(refused()),
    }
}

/// Parses a fragment between two texts; it must be exactly the result of `find`.
fn read(
    before: &str,
    text: &str,
    after: &str,
    what: &str,
    find: impl Fn(&Node) -> Option<Node>,
) -> Result<(), Refused> {
    let whole = format!("{before}{text}{after}");
    let refused = || Refused::new(format!("'{text}' is not {what}"));
    let root = without_errors(&whole).map_err(|_| refused())?;
    let plan = only(&root, Kind::Plan).ok_or_else(refused)?;
    let item = plan.children().next().filter(|_| plan.children().count() == 1);
    let found = item.and_then(|item| find(&item)).ok_or_else(refused)?;
    let mut tokens = root.descendants_with_tokens().filter_map(|each| each.into_token());
    let plain = !text.contains('\n') && !tokens.any(|token| is_comment(&token));
    let trimmed = text.trim_start();
    let start = before.len() + text.len() - trimmed.len();
    let place = start..start + trimmed.trim_end().len();
    match solid_range(&found) {
        Some(range) if plain && range == place => Ok(()),
        _ => Err(refused()),
    }
}

/// Items of a plan, or of an element, in canonical form and without indentation, with their nodes.
pub(super) fn items(text: &str, in_element: bool) -> Result<(String, Vec<Node>), Refused> {
    let (before, after) = match in_element {
        false => ("plan P {\n", "\n}\n"),
        true => ("plan P {\nactor A: A {\n", "\n}\n}\n"),
    };
    let formatted = canonical(&format!("{before}{text}{after}"))?;
    let root = without_errors(&formatted)?;
    let several = || Refused::new("the text has more than the items of one list");
    let plan = only(&root, Kind::Plan).ok_or_else(several)?;
    let list = match in_element {
        false => plan,
        true => only(&plan, Kind::Element).ok_or_else(several)?,
    };
    let allowed: &[Kind] = match in_element {
        false => &[Kind::Entry, Kind::Element, Kind::Guard],
        true => &[Kind::Guard],
    };
    let nodes: Vec<_> =
        list.children().filter(|child| !matches!(child.kind(), Kind::Ref | Kind::Args)).collect();
    if nodes.is_empty() {
        return Err(Refused::new("the text has no item"));
    }
    if let Some(other) = nodes.iter().find(|node| !allowed.contains(&node.kind())) {
        let text = other.text().to_string();
        let first = text.trim().lines().next().unwrap_or_default().to_owned();
        return Err(Refused::new(format!("'{first}' cannot be put here")));
    }
    let levels = if in_element { 2 } else { 1 };
    let lines: Vec<_> = formatted.lines().collect();
    let inner = lines.get(levels..lines.len().saturating_sub(levels)).unwrap_or_default();
    let indent = " ".repeat(4 * levels);
    let lines = inner.iter().map(|line| line.strip_prefix(&indent).unwrap_or(line.trim_start()));
    Ok((lines.collect::<Vec<_>>().join("\n"), nodes))
}

/// Plans and computations in canonical form, with their nodes.
pub(super) fn plans(text: &str) -> Result<(String, Vec<Node>), Refused> {
    let formatted = canonical(text)?;
    let root = without_errors(&formatted)?;
    let nodes: Vec<_> = root.children().collect();
    let fits = |node: &Node| match node.kind() {
        Kind::Template => keyword(node).is_some_and(|word| word.text() == "computation"),
        kind => kind == Kind::Plan,
    };
    if nodes.is_empty() || !nodes.iter().all(fits) {
        return Err(Refused::new("the text has items other than plans and computations"));
    }
    Ok((dedented(formatted.trim_end(), ""), nodes))
}

fn canonical(text: &str) -> Result<String, Refused> {
    format(text).map_err(|diags| unreadable(&diags))
}

fn without_errors(text: &str) -> Result<Node, Refused> {
    let mut diags = Diagnostics::default();
    let root = parse(text, 0, &mut diags).root();
    if diags.has_errors() { Err(unreadable(&diags)) } else { Ok(root) }
}

fn unreadable(diags: &Diagnostics) -> Refused {
    let first = diags.iter().find(|each| each.severity == Severity::Error);
    let message = first.map_or_else(|| "nothing".to_owned(), Diagnostic::message_text);
    Refused::new(format!("the text cannot be read: {message}"))
}

/// The child, if it is the only one and of that kind.
fn only(node: &Node, kind: Kind) -> Option<Node> {
    let mut items = node.children().filter(|child| !matches!(child.kind(), Kind::Ref | Kind::Args));
    items.next().filter(|item| item.kind() == kind && items.next().is_none())
}
