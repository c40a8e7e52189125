//! Conditions and assignments of declared computations.

use super::buffer::{Splice, TextBuffer};
use super::entry::set_part;
use super::tree::{self, children, is_named, keyword, name_token, range, solid_range, tokens};
use super::{Refused, fragment, name};
use afp_syntax::Node;
use afp_syntax::kind::Kind;

/// Sets or removes the condition of a state.
pub(super) fn set_condition(
    buffer: &mut TextBuffer,
    (computation, state): (&str, &str),
    condition: Option<&str>,
) -> Result<(), Refused> {
    condition.map_or(Ok(()), fragment::condition)?;
    let node = find(buffer, computation, state)?;
    let end = name_token(&node).map_or(0, |name| range(&name).end);
    let old = children(&node, Kind::When).next();
    let new = condition.map(|condition| format!("when {}", condition.trim()));
    set_part(buffer, old, end, "", " ", new.as_deref())
}

/// Sets or removes the formula that a state assigns to an output.
pub(super) fn assign(
    buffer: &mut TextBuffer,
    (computation, state): (&str, &str),
    output: &str,
    formula: Option<&str>,
) -> Result<(), Refused> {
    name::check(output)?;
    formula.map_or(Ok(()), fragment::formula)?;
    let node = find(buffer, computation, state)?;
    let binds: Vec<_> = children(&node, Kind::BindIn).collect();
    let own = binds.iter().position(|bind| is_named(bind, output));
    let splice = match (own, formula.map(str::trim)) {
        (None, None) => return Ok(()),
        (None, Some(formula)) => added(&node, &binds, &format!("{output} = {formula}")),
        (Some(own), Some(formula)) => {
            let start = name_token(&binds[own]).map_or(0, |name| range(&name).end);
            (start..end(&binds[own]), format!(" = {formula}"))
        }
        (Some(own), None) => removed(&node, &binds, own),
    };
    let Some((place, text)) =
        Some(splice).filter(|(place, text)| buffer.text()[place.clone()] != **text)
    else {
        return Ok(());
    };
    let is_inside = |token: &afp_syntax::Token| place.contains(&range(token).start);
    let mut all = node.descendants_with_tokens().filter_map(|each| each.into_token());
    if all.any(|token| tree::is_comment(&token) && is_inside(&token)) {
        return Err(Refused::new("it contains a comment"));
    }
    buffer.splice(vec![(place, text)]);
    Ok(())
}

fn find(buffer: &TextBuffer, computation: &str, state: &str) -> Result<Node, Refused> {
    let root = buffer.root();
    let is_it = |node: &Node| {
        is_named(node, computation) && keyword(node).is_some_and(|it| it.text() == "computation")
    };
    let found = children(&root, Kind::Template).find(is_it);
    let found =
        found.ok_or_else(|| Refused::new(format!("there is no computation '{computation}'")))?;
    let state_of = children(&found, Kind::Outcome).find(|node| is_named(node, state));
    state_of.ok_or_else(|| Refused::new(format!("'{computation}' has no state '{state}'")))
}

/// The end of an assignment, without the comma after it.
fn end(bind: &Node) -> usize {
    bind.children().last().and_then(|value| solid_range(&value)).map_or(0, |value| value.end)
}

/// An assignment after the others, in a new body if the state has none.
fn added(state: &Node, binds: &[Node], text: &str) -> Splice {
    if let Some(last) = binds.last() {
        return (end(last)..end(last), format!(", {text}"));
    }
    match body(state) {
        Some(inside) => (inside, format!(" {text} ")),
        None => {
            let end = solid_range(state).map_or(0, |all| all.end);
            (end..end, format!(" {{ {text} }}"))
        }
    }
}

/// Removes an assignment with the separator to its neighbour.
fn removed(state: &Node, binds: &[Node], own: usize) -> Splice {
    let all = solid_range(&binds[own]).unwrap_or_default();
    let next = binds.get(own + 1).and_then(solid_range);
    let before = own.checked_sub(1).and_then(|before| binds.get(before));
    let range = match (next, before) {
        (Some(next), _) => all.start..next.start,
        (None, Some(before)) => end(before)..all.end,
        (None, None) => body(state).unwrap_or(all),
    };
    (range, String::new())
}

/// The range between the braces of a state.
fn body(state: &Node) -> Option<std::ops::Range<usize>> {
    let open = tokens(state, Kind::OpenBrace).next()?;
    let close = tokens(state, Kind::CloseBrace).last()?;
    Some(range(&open).end..range(&close).start)
}
