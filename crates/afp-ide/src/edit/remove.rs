//! Removing items and the references to them.

use super::buffer::{Splice, TextBuffer};
use super::list::Page;
use super::project::Project;
use super::refer;
use super::tree::{self, below, children, name_of, target};
use super::{Item, Refused, braces, port};
use afp_syntax::kind::Kind;
use afp_syntax::{Node, Token};

pub(super) fn item(buffer: &mut TextBuffer, item: &Item) -> Result<(), Refused> {
    let node = tree::find(&buffer.root(), item)?;
    let project = Project::alone(buffer);
    match node.kind() {
        Kind::Plan => check_unused_plan(&project, item)?,
        Kind::Enum | Kind::Table if refer::to(&project, 0, item).len() > 1 => {
            return Err(Refused::new(format!("'{}' is used in the file", item.name())));
        }
        Kind::Entry => {
            check_unread(&project, item)?;
            unbind_all(buffer, &project, item);
        }
        Kind::Element => cut_edges_to(buffer, item),
        Kind::Guard => drop_reactions(buffer, item),
        _ => {}
    }
    let node = tree::find(&buffer.root(), item)?;
    take_out(buffer, &node);
    Ok(())
}

/// Removes the reactions of elements to a supervisor of their plan.
fn drop_reactions(buffer: &mut TextBuffer, item: &Item) {
    let reaction = |buffer: &TextBuffer| {
        let project = Project::alone(buffer);
        let mut uses = refer::to(&project, 0, item).into_iter().skip(1);
        uses.find_map(|(_, token)| token.parent().filter(|node| node.kind() == Kind::Reactions))
    };
    while let Some(node) = reaction(buffer) {
        take_out(buffer, &node);
    }
}

pub(super) fn take_out(buffer: &mut TextBuffer, node: &Node) {
    let page = Page { text: buffer.text(), root: buffer.root() };
    let splice = page.remove(node);
    buffer.splice(vec![splice]);
}

fn check_unused_plan(project: &Project, item: &Item) -> Result<(), Refused> {
    let root = &project.roots[0];
    let own = tree::find(root, item)?;
    let name = item.name();
    let users = refer::users_of(project, 0, item);
    let mut outside = users.iter().filter(|user| user.ancestors().all(|ancestor| ancestor != own));
    if let Some(user) = outside.next() {
        let user = name_of(user).unwrap_or_default();
        return Err(Refused::new(format!("'{name}' is used by the sub-plan '{user}'")));
    }
    match refer::in_scenarios(project, 0, std::slice::from_ref(item), 0).is_empty() {
        true => Ok(()),
        false => {
            Err(Refused::new(format!("a scenario is for '{name}': remove the scenario first")))
        }
    }
}

fn check_unread(project: &Project, item: &Item) -> Result<(), Refused> {
    let entry = tree::find(&project.roots[0], item)?;
    let mut readers = refer::reads_of(project, 0, item).into_iter().filter_map(|token| {
        let items = token.parent_ancestors();
        items
            .into_iter()
            .find(|node| matches!(node.kind(), Kind::Entry | Kind::Element | Kind::Guard))
    });
    let reader = readers.find(|reader| *reader != entry);
    if let Some(reader) = reader {
        let reader = name_of(&reader).unwrap_or_default();
        return Err(Refused::new(format!("'{}' is read by '{reader}'", item.name())));
    }
    Ok(())
}

/// Removes the outputs that write an entry, and the bindings of sub-plans to it.
fn unbind_all(buffer: &mut TextBuffer, project: &Project, item: &Item) {
    let kinds = [Kind::BindIn, Kind::BindOut, Kind::BindSame];
    let uses = refer::to(project, 0, item).into_iter().skip(1);
    let binds = uses.filter_map(|(_, token)| around(&token, &kinds));
    backwards(buffer, binds, &kinds, |buffer, bind| {
        let component = bind.parent()?.parent()?;
        Some(port::removal(buffer, &component, bind))
    });
}

/// Removes the edges to an element from others, and the `start` that names it.
pub(super) fn cut_edges_to(buffer: &mut TextBuffer, element: &Item) {
    let project = Project::alone(buffer);
    let own = tree::find(&project.roots[0], element).ok();
    let tokens = refer::to_element(&project, 0, element).into_iter();
    let others = tokens.filter(|token| token.parent_ancestors().all(|node| Some(node) != own));
    let kinds = [Kind::Edge, Kind::Start];
    let nodes = others.filter_map(|token| around(&token, &kinds));
    backwards(buffer, nodes, &kinds, |buffer, node| {
        Some(braces::removal(&Page { text: buffer.text(), root: buffer.root() }, node))
    });
}

/// The innermost enclosing node of some kinds.
fn around(token: &Token, kinds: &[Kind]) -> Option<Node> {
    token.parent_ancestors().find(|node| kinds.contains(&node.kind()))
}

/// Changes nodes from last to first, so that earlier places stay valid.
fn backwards(
    buffer: &mut TextBuffer,
    nodes: impl Iterator<Item = Node>,
    kinds: &[Kind],
    change: impl Fn(&TextBuffer, &Node) -> Option<Splice>,
) {
    let mut places: Vec<_> =
        nodes.filter_map(|node| tree::solid_range(&node).map(|range| range.start)).collect();
    places.sort_unstable();
    places.dedup();
    for place in places.into_iter().rev() {
        let token = tree::solid_after(&buffer.root(), place);
        let node = token.and_then(|token| around(&token, kinds));
        if let Some(splice) = node.and_then(|node| change(buffer, &node)) {
            buffer.splice(vec![splice]);
        }
    }
}

/// Removes the edges of a component whose target is neither itself nor in the plan `there`.
pub(super) fn cut_edges_from(buffer: &mut TextBuffer, component: &Item, there: &Node) {
    let project = Project::alone(buffer);
    let Ok(own) = tree::find(&project.roots[0], component) else { return };
    let is_there = |name: &str| {
        matches!(name, "terminate" | "fail" | "ignore" | "resume" | "return")
            || children(there, Kind::Element).any(|element| tree::is_named(&element, name))
    };
    let leads_away = |edge: &Node| {
        target(edge).is_some_and(|target| {
            let meant = project.item(0, &target).map(|(_, node)| node);
            meant.as_ref() != Some(&own) && !is_there(target.text())
        })
    };
    let edges = below(&own, Kind::Edge).filter(leads_away);
    backwards(buffer, edges, &[Kind::Edge], |buffer, edge| {
        Some(braces::removal(&Page { text: buffer.text(), root: buffer.root() }, edge))
    });
}
