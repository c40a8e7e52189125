//! Finding items, names and comments in the tree.

use std::ops::Range;

use super::{Item, Refused};
use afp_syntax::kind::Kind;
use afp_syntax::{Node, Token};

/// A scope of distinct names.
pub(super) enum Scope {
    /// The plans and computations of a file, which also differ from its tables.
    File(Node),
    /// The enums of a file, which also differ from its tables.
    Enums(Node),
    /// The tables of a file, which also differ from its plans, computations and enums.
    Tables(Node),
    /// Entries, elements and global supervisors of a plan.
    Plan(Node),
    /// The local supervisors of an element.
    Element(Node),
    /// The parts of a kind in an item: columns of a table, values of an enum.
    Inside(Node, Kind),
}

impl Scope {
    pub fn names(&self) -> Vec<String> {
        let (node, kinds): (_, &[Kind]) = match self {
            Scope::Inside(node, kind) => {
                return below(node, *kind).filter_map(|part| name_of(&part)).collect();
            }
            Scope::File(node) => (node, &[Kind::Plan, Kind::Template, Kind::Table]),
            Scope::Enums(node) => (node, &[Kind::Enum, Kind::Table]),
            Scope::Tables(node) => (node, &[Kind::Table, Kind::Plan, Kind::Template, Kind::Enum]),
            Scope::Plan(node) => (node, &[Kind::Entry, Kind::Element, Kind::Guard]),
            Scope::Element(node) => (node, &[Kind::Guard]),
        };
        let items = node.children().filter(|child| kinds.contains(&child.kind()));
        items.filter_map(|item| name_of(&item)).collect()
    }
}

pub(super) fn scope_of(root: &Node, item: &Item) -> Result<Scope, Refused> {
    Ok(match item {
        Item::Plan { .. } => Scope::File(root.clone()),
        Item::Enum { .. } => Scope::Enums(root.clone()),
        Item::Table { .. } => Scope::Tables(root.clone()),
        Item::Inner { plan, .. } => Scope::Plan(self::plan(root, plan)?),
        Item::Local { plan, owner, .. } => Scope::Element(element(root, plan, owner)?),
    })
}

pub(super) fn plan(root: &Node, name: &str) -> Result<Node, Refused> {
    let found = pick(children(root, Kind::Plan), name);
    found.ok_or_else(|| Refused::new(format!("there is no plan '{name}'")))
}

pub(super) fn element(root: &Node, plan: &str, name: &str) -> Result<Node, Refused> {
    let node = self::plan(root, plan)?;
    let found = inner(&node, name).filter(|found| found.kind() == Kind::Element);
    let found = found.or_else(|| pick(children(&node, Kind::Element), name));
    found.ok_or_else(|| Refused::new(format!("'{plan}' has no element '{name}'")))
}

pub(super) fn find(root: &Node, item: &Item) -> Result<Node, Refused> {
    match item {
        Item::Plan { name } => plan(root, name),
        Item::Enum { name } => {
            let found = pick(children(root, Kind::Enum), name);
            found.ok_or_else(|| Refused::new(format!("there is no enum '{name}'")))
        }
        Item::Table { name } => {
            let found = pick(children(root, Kind::Table), name);
            found.ok_or_else(|| Refused::new(format!("there is no table '{name}'")))
        }
        Item::Inner { plan, name } => inner(&self::plan(root, plan)?, name)
            .ok_or_else(|| Refused::new(format!("'{plan}' has no '{name}'"))),
        Item::Local { plan, owner, name } => {
            let element = element(root, plan, owner)?;
            if let Some(watcher) = item.reacts_to() {
                let found = pick(children(&element, Kind::Reactions), watcher);
                return found.ok_or_else(|| Refused::new(format!("'{owner}' has no '{name}'")));
            }
            let found = pick(children(&element, Kind::Guard), name);
            found.ok_or_else(|| Refused::new(format!("'{owner}' has no supervisor '{name}'")))
        }
    }
}

pub(super) fn component(root: &Node, item: &Item) -> Result<Node, Refused> {
    let node = find(root, item)?;
    match node.kind() {
        Kind::Element | Kind::Guard | Kind::Reactions => Ok(node),
        _ => Err(Refused::new(format!("'{}' is not an element or supervisor", item.name()))),
    }
}

/// An entry, element or global supervisor of a plan.
pub(super) fn inner(plan: &Node, name: &str) -> Option<Node> {
    let kinds = [Kind::Entry, Kind::Element, Kind::Guard];
    pick(plan.children().filter(|child| kinds.contains(&child.kind())), name)
}

/// Finds a node by a name of an item's path: `name`, `name#2` for the second one, `#1` for the
/// first one without a name.
fn pick(mut nodes: impl Iterator<Item = Node>, name: &str) -> Option<Node> {
    let Some((text, number)) = name.split_once('#') else {
        return nodes.find(|node| is_named(node, name));
    };
    let index = number.parse::<usize>().ok()?.checked_sub(1)?;
    nodes.filter(|node| name_of(node).unwrap_or_default() == text).nth(index)
}

pub(super) fn name_token(node: &Node) -> Option<Token> {
    match node.kind() {
        Kind::BindSame => children(node, Kind::Ref).find_map(|name| single(&name)),
        _ => tokens(node, Kind::Name).next(),
    }
}

pub(super) fn name_of(node: &Node) -> Option<String> {
    name_token(node).map(|token| token.text().to_owned())
}

pub(super) fn is_named(node: &Node, name: &str) -> bool {
    name_token(node).is_some_and(|token| token.text() == name)
}

pub(super) fn children(node: &Node, kind: Kind) -> impl Iterator<Item = Node> {
    node.children().filter(move |child| child.kind() == kind)
}

pub(super) fn below(node: &Node, kind: Kind) -> impl Iterator<Item = Node> {
    node.descendants().filter(move |child| child.kind() == kind)
}

/// The tokens of a kind among the children of a node.
pub(super) fn tokens(node: &Node, kind: Kind) -> impl Iterator<Item = Token> {
    all_tokens(node).filter(move |token| token.kind() == kind)
}

fn all_tokens(node: &Node) -> impl Iterator<Item = Token> {
    node.children_with_tokens().filter_map(|element| element.into_token())
}

pub(super) fn keyword(node: &Node) -> Option<Token> {
    tokens(node, Kind::Keyword).next()
}

pub(super) fn is_subplan(element: &Node) -> bool {
    keyword(element).is_some_and(|token| token.text() == "subplan")
}

pub(super) fn has_events(component: &Node) -> bool {
    matches!(component.kind(), Kind::Guard | Kind::Reactions)
}

pub(super) fn is_computation(element: &Node) -> bool {
    keyword(element).is_some_and(|token| token.text() == "computation")
}

/// The template's name in an element or supervisor, if it has no toolbox.
pub(super) fn template(component: &Node) -> Option<String> {
    let reference = children(component, Kind::Ref).next()?;
    single(&reference).map(|token| token.text().to_owned())
}

/// The only name of a reference; `None` with a `.`.
pub(super) fn single(reference: &Node) -> Option<Token> {
    let mut names = tokens(reference, Kind::Name);
    names.next().filter(|_| names.next().is_none())
}

/// The target of an edge, or the entry of an output.
pub(super) fn target(node: &Node) -> Option<Token> {
    if node.kind() == Kind::BindSame {
        return name_token(node);
    }
    children(node, Kind::Target).next().and_then(|target| name_token(&target))
}

/// Whether `suspend` is written before a target.
pub(super) fn suspends(target: &Token) -> bool {
    let target = target.parent().filter(|node| node.kind() == Kind::Target);
    target.is_some_and(|node| tokens(&node, Kind::Keyword).next().is_some())
}

/// The edges of a component, without those of its supervisors.
pub(super) fn edges(component: &Node) -> impl Iterator<Item = Node> {
    children(component, Kind::Edge)
}

/// The edge of a state or event. The edge of a sub-plan without braces is for `OK`.
pub(super) fn edge(component: &Node, outcome: &str) -> Option<Node> {
    let named = edges(component).find(|edge| outcomes(edge).any(|name| name.text() == outcome));
    named.or_else(|| nameless(component).filter(|_| outcome == "OK" && is_subplan(component)))
}

/// The edge of an element without braces, which names no state.
pub(super) fn nameless(component: &Node) -> Option<Node> {
    edges(component).find(|edge| name_token(edge).is_none())
}

pub(super) fn outcomes(edge: &Node) -> impl Iterator<Item = Token> {
    tokens(edge, Kind::Name)
}

/// The range to delete for a state or event on a shared edge; `None` if the edge is not shared.
pub(super) fn without_outcome(edge: &Node, outcome: &str) -> Option<std::ops::Range<usize>> {
    let names: Vec<_> = outcomes(edge).collect();
    let index = names.iter().position(|name| name.text() == outcome)?;
    match (names.get(index + 1), index.checked_sub(1).and_then(|before| names.get(before))) {
        (Some(next), _) => Some(range(&names[index]).start..range(next).start),
        (None, Some(before)) => Some(range(before).end..range(&names[index]).end),
        (None, None) => None,
    }
}

pub(super) fn binds(component: &Node) -> Vec<Node> {
    let args = children(component, Kind::Args);
    args.flat_map(|args| args.children())
        .filter(|child| matches!(child.kind(), Kind::BindIn | Kind::BindOut | Kind::BindSame))
        .collect()
}

/// The initial value of an entry.
pub(super) fn init(entry: &Node) -> Option<Node> {
    let other = |kind| matches!(kind, Kind::Type | Kind::Range | Kind::Error);
    entry.children().find(|child| !other(child.kind()))
}

pub(super) fn range(token: &Token) -> Range<usize> {
    token.text_range().into()
}

/// The range from the first to the last solid token; `None` if there is none.
pub(super) fn solid_range(node: &Node) -> Option<Range<usize>> {
    let solid = |token: &Token| !token.kind().is_trivia();
    let mut tokens = node.descendants_with_tokens().filter_map(|each| each.into_token());
    let first = tokens.find(solid)?;
    let end = tokens.filter(solid).last().map_or(range(&first).end, |last| range(&last).end);
    Some(range(&first).start..end)
}

/// Whether a comment is between the first and last token of a node.
pub(super) fn holds_comment(node: &Node) -> bool {
    let Some(solid) = solid_range(node) else { return false };
    let mut tokens = node.descendants_with_tokens().filter_map(|each| each.into_token());
    tokens.any(|token| is_comment(&token) && solid.contains(&range(&token).start))
}

/// Whether a token is a comment or help text.
pub(super) fn is_comment(token: &Token) -> bool {
    token.kind().is_trivia() && token.kind() != Kind::Whitespace
}

/// The bytes of an item with its comments.
///
/// A comment on the line of the previous token stays there.
pub(super) fn own_range(node: &Node) -> Range<usize> {
    let all = Range::<usize>::from(node.text_range());
    let mut on_new_line = node.first_token().is_none_or(|first| is_below(&first));
    let tokens = node.descendants_with_tokens().filter_map(|each| each.into_token());
    for token in tokens {
        match token.kind() {
            Kind::Whitespace => on_new_line |= token.text().contains('\n'),
            Kind::Comment if !on_new_line => {}
            _ => return range(&token).start..all.end,
        }
    }
    all
}

/// Whether only a line break or nothing separates a token from the previous solid one.
fn is_below(token: &Token) -> bool {
    let mut before = std::iter::successors(token.prev_token(), Token::prev_token);
    let found = before.find(|token| !token.kind().is_trivia() || token.text().contains('\n'));
    found.is_none_or(|token| token.kind().is_trivia())
}

/// The last solid token before a place.
pub(super) fn solid_before(root: &Node, at: usize) -> Option<Token> {
    let first = root.token_at_offset(offset(at)).left_biased();
    let mut all = std::iter::successors(first, Token::prev_token);
    all.find(|token| !token.kind().is_trivia() && range(token).end <= at)
}

/// The first solid token after a place.
pub(super) fn solid_after(root: &Node, at: usize) -> Option<Token> {
    let first = root.token_at_offset(offset(at)).right_biased();
    let mut all = std::iter::successors(first, Token::next_token);
    all.find(|token| !token.kind().is_trivia() && range(token).start >= at)
}

fn offset(at: usize) -> rowan::TextSize {
    rowan::TextSize::try_from(at).unwrap_or_default()
}
