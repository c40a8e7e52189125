//! Elements without braces: their only edge, and the change to braces.

use std::ops::Range;

use super::buffer::{Splice, TextBuffer};
use super::list::Page;
use super::project::Project;
use super::tree::{self, name_token, range};
use super::{Item, Refused};
use afp_syntax::Node;
use afp_syntax::kind::Kind;

/// The edge of a state or event. The state of an element without braces comes from its template; it is empty if the
/// template is unknown.
pub(super) fn edge(buffer: &TextBuffer, component: &Node, outcome: &str) -> Option<Node> {
    tree::edge(component, outcome).or_else(|| {
        let edge = tree::nameless(component)?;
        let is_meant =
            outcome.is_empty() || state_of(buffer, component, &edge)?.as_str() == outcome;
        is_meant.then_some(edge)
    })
}

fn state_of(buffer: &TextBuffer, component: &Node, edge: &Node) -> Option<String> {
    if tree::is_subplan(component) {
        return Some("OK".to_owned());
    }
    let arrow = tree::tokens(edge, Kind::Arrow).next()?;
    Project::alone(buffer).declared_name(&arrow)
}

/// Puts the edge of an element into braces, with the name of its state. An element with braces stays the same.
pub(super) fn with_braces(buffer: &mut TextBuffer, element: &Item) -> Result<(), Refused> {
    let component = tree::component(&buffer.root(), element)?;
    let Some(edge) = tree::nameless(&component) else { return Ok(()) };
    let state = state_of(buffer, &component, &edge);
    let state = state.ok_or_else(|| {
        Refused::new(format!("the edge of '{}' is not for a known state", element.name()))
    })?;
    let place = without_comma(&edge);
    let page = Page { text: buffer.text(), root: buffer.root() };
    let indent = page.indent(tree::solid_range(&component).unwrap_or_default().start);
    let edge = &buffer.text()[place.clone()];
    let text = format!("{{\n{indent}    {state} {edge}\n{indent}}}");
    buffer.splice(vec![(place, text)]);
    Ok(())
}

fn without_comma(edge: &Node) -> Range<usize> {
    let tokens = edge.descendants_with_tokens().filter_map(|each| each.into_token());
    let mut solid = tokens.filter(|it| !it.kind().is_trivia() && it.kind() != Kind::Comma);
    let Some(first) = solid.next() else { return Range::default() };
    range(&first).start..range(&solid.last().unwrap_or(first)).end
}

/// The splice that removes an edge from its component.
pub(super) fn removal(page: &Page<'_>, edge: &Node) -> Splice {
    match edge.kind() == Kind::Edge && name_token(edge).is_none() {
        true => (without_comma(edge), "{}".to_owned()),
        false => page.remove(edge),
    }
}
