//! New places of items: in their list, in another plan, at another owner.

use std::collections::BTreeSet;

use super::buffer::TextBuffer;
use super::list::{Page, Place};
use super::project::Project;
use super::tree::{self, Scope, children, name_of, target};
use super::{Item, Refused, add, braces, name, port, refer, remove};
use afp_syntax::Node;
use afp_syntax::kind::Kind;

/// Moves an item before another one of its list, or after the last of its kind.
pub(super) fn reorder(
    buffer: &mut TextBuffer,
    item: &Item,
    before: Option<&str>,
) -> Result<(), Refused> {
    let root = buffer.root();
    let node = tree::find(&root, item)?;
    let list_of = |root: &Node| match item {
        Item::Plan { .. } => Ok(root.clone()),
        Item::Enum { .. } => Err(Refused::new("the order of enums has no meaning")),
        Item::Table { .. } => Err(Refused::new("the order of tables has no meaning")),
        Item::Inner { plan, .. } => tree::plan(root, plan),
        Item::Local { plan, owner, .. } => tree::element(root, plan, owner),
    };
    let list = list_of(&root)?;
    if before == Some(item.name()) || is_there(&list, &node, before)? {
        return Ok(());
    }
    let lines = Page { text: buffer.text(), root }.lines_of(&node);
    let kind = node.kind();
    remove::take_out(buffer, &node);
    let root = buffer.root();
    if kind != Kind::Plan {
        return add::place(buffer, &list_of(&root)?, &lines, kind, before);
    }
    let place = match before {
        Some(before) => Place::Before(add::sibling(&root, before)?),
        None => children(&root, Kind::Plan).last().map_or(Place::Top, Place::After),
    };
    let splice = Page { text: buffer.text(), root: root.clone() }
        .insert_lines(&root, place, &lines, true)?;
    buffer.splice(vec![splice]);
    Ok(())
}

/// Whether an item already has that place.
fn is_there(list: &Node, node: &Node, before: Option<&str>) -> Result<bool, Refused> {
    let next = node.next_sibling();
    Ok(match before {
        Some(before) => next == Some(add::sibling(list, before)?),
        None => children(list, node.kind()).last().as_ref() == Some(node),
    })
}

/// Moves an item to another plan or owner.
pub(super) fn shift(
    buffer: &mut TextBuffer,
    item: &Item,
    plan: &str,
    owner: Option<&str>,
) -> Result<(), Refused> {
    let root = buffer.root();
    let node = tree::find(&root, item)?;
    let there = tree::plan(&root, plan)?;
    let same_plan = item.plan_name() == plan;
    check_kind(&node, item, same_plan, owner)?;
    let scope = match owner {
        None => Scope::Plan(there.clone()),
        Some(owner) => {
            let element = tree::element(&root, plan, owner)?;
            add::can_be_supervised(&element)?;
            Scope::Element(element)
        }
    };
    name::check_free(&scope, item.name(), None)?;
    match node.kind() {
        Kind::Entry => check_unused(buffer, item)?,
        _ if !same_plan => check_entries(buffer, &node, &there, plan)?,
        _ => {}
    }
    if let Some(owner) = owner {
        braces::with_braces(buffer, &Item::inner(plan, owner))?;
    }
    remove::cut_edges_from(buffer, item, &there);
    if node.kind() == Kind::Element {
        remove::cut_edges_to(buffer, item);
    }
    let lines = {
        let root = buffer.root();
        Page { text: buffer.text(), root: root.clone() }.lines_of(&tree::find(&root, item)?)
    };
    let moved = tree::find(&buffer.root(), item)?;
    remove::take_out(buffer, &moved);
    let root = buffer.root();
    let list = match owner {
        None => tree::plan(&root, plan)?,
        Some(owner) => tree::element(&root, plan, owner)?,
    };
    add::place(buffer, &list, &lines, node.kind(), None)
}

fn check_kind(
    node: &Node,
    item: &Item,
    same_plan: bool,
    owner: Option<&str>,
) -> Result<(), Refused> {
    let is_guard = node.kind() == Kind::Guard;
    let is_home = match item {
        Item::Local { owner: home, .. } => owner == Some(home.as_str()),
        _ => owner.is_none(),
    };
    if matches!(node.kind(), Kind::Plan | Kind::Enum | Kind::Table) {
        return Err(Refused::new("only items of a plan can move to another plan"));
    }
    if owner.is_some() && !is_guard {
        return Err(Refused::new(format!("'{}' is not a supervisor", item.name())));
    }
    if same_plan && is_home {
        return Err(Refused::new(format!("'{}' is already in this place", item.name())));
    }
    Ok(())
}

fn check_unused(buffer: &TextBuffer, item: &Item) -> Result<(), Refused> {
    match refer::to(&Project::alone(buffer), 0, item).len() {
        0 | 1 => Ok(()),
        _ => Err(Refused::new(format!("'{}' is used at its present place", item.name()))),
    }
}

/// Checks that a plan has the entries that a component reads and writes.
fn check_entries(
    buffer: &TextBuffer,
    component: &Node,
    plan: &Node,
    name: &str,
) -> Result<(), Refused> {
    let project = Project::alone(buffer);
    let known: BTreeSet<_> = children(plan, Kind::Entry).filter_map(|e| name_of(&e)).collect();
    let data = port::data_of(component);
    let names = data.flat_map(|bound| port::reads(&bound).into_iter().chain(target(&bound)));
    let used: BTreeSet<_> = names.filter_map(|token| project.entry(0, &token)).collect();
    let missing: Vec<_> = used.difference(&known).map(String::as_str).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let list = afp_syntax::diagnostics::words::list(missing, "and");
    Err(Refused::new(format!("'{name}' has no entry {list}")))
}
