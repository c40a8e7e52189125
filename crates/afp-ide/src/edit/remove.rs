//! Removing items, and what would be left hanging.

use super::draft::Draft;
use super::list::Page;
use super::project::Project;
use super::refer;
use super::tree::{self, below, binds, children, name_of, name_token, target};
use super::{Item, Refused, port};
use afp_syntax::Node;
use afp_syntax::kind::Kind;

/// Removes an item.
pub(super) fn item(draft: &mut Draft, item: &Item) -> Result<(), Refused> {
    let root = draft.root();
    let node = tree::find(&root, item)?;
    match node.kind() {
        Kind::Plan => check_unused_plan(&root, item.name())?,
        Kind::Enum if refer::to(&Project::alone(&root), 0, item).len() > 1 => {
            return Err(Refused::new(format!("'{}' is used in the file", item.name())));
        }
        Kind::Entry => {
            check_unread(&root, item)?;
            unbind_all(draft, item);
        }
        Kind::Element => cut_edges_to(draft, item.plan_name(), item.name()),
        _ => {}
    }
    let node = tree::find(&draft.root(), item)?;
    take_out(draft, &node);
    Ok(())
}

/// Takes a node out of its list.
pub(super) fn take_out(draft: &mut Draft, node: &Node) {
    let page = Page { text: draft.text(), root: draft.root() };
    let splice = page.remove(node);
    draft.splice(vec![splice]);
}

fn check_unused_plan(root: &Node, name: &str) -> Result<(), Refused> {
    let own = tree::plan(root, name)?;
    let users = refer::users_of(root, name);
    let mut outside = users.iter().filter(|user| user.ancestors().all(|ancestor| ancestor != own));
    if let Some(user) = outside.next() {
        let user = name_of(user).unwrap_or_default();
        return Err(Refused::new(format!("'{name}' is used by the sub-plan '{user}'")));
    }
    let scenarios = children(root, Kind::Scenario)
        .flat_map(|s| children(&s, Kind::Ref).take(1).collect::<Vec<_>>());
    let mut names = scenarios.filter_map(|reference| tree::single(&reference));
    match names.any(|token| token.text() == name) {
        true => Err(Refused::new(format!("a scenario is for '{name}'"))),
        false => Ok(()),
    }
}

fn check_unread(root: &Node, item: &Item) -> Result<(), Refused> {
    let plan = tree::plan(root, item.plan_name())?;
    let entry = tree::find(root, item)?;
    let mut readers = refer::reads_of(&plan, item.name()).into_iter().filter_map(|token| {
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
    if !refer::in_scenarios(&Project::alone(root), |_, meant| meant == item).is_empty() {
        return Err(Refused::new(format!("'{}' is named by a scenario", item.name())));
    }
    Ok(())
}

/// Removes the outputs that write an entry, and the bindings of sub-plans to it.
fn unbind_all(draft: &mut Draft, item: &Item) {
    let bound = |draft: &Draft| -> Option<(Node, Node)> {
        let root = draft.root();
        let plan = tree::plan(&root, item.plan_name()).ok()?;
        let components = below(&plan, Kind::Element).chain(below(&plan, Kind::Guard));
        let inside = components.flat_map(|component| {
            let outputs = binds(&component).into_iter().filter(|bind| {
                let entry = target(bind).filter(|_| bind.kind() == Kind::BindOut);
                entry.is_some_and(|entry| entry.text() == item.name())
            });
            outputs.map(|bind| (component.clone(), bind)).collect::<Vec<_>>()
        });
        let users = refer::users_of(&root, item.plan_name()).into_iter();
        let outside = users.flat_map(|user| {
            let ports = binds(&user).into_iter().filter(|bind| port::port_of(bind) == item.name());
            ports.map(|bind| (user.clone(), bind)).collect::<Vec<_>>()
        });
        inside.chain(outside).next()
    };
    while let Some((component, bind)) = bound(draft) {
        let splice = port::removal(draft, &component, &bind);
        draft.splice(vec![splice]);
    }
}

/// Removes the edges that lead to an element, and the `start` that names it.
pub(super) fn cut_edges_to(draft: &mut Draft, plan: &str, name: &str) {
    let leads_there = |node: &Node| match node.kind() {
        Kind::Edge => target(node).is_some_and(|target| target.text() == name),
        Kind::Start => name_token(node).is_some_and(|target| target.text() == name),
        _ => false,
    };
    cut(draft, |root| {
        let plan = tree::plan(root, plan).ok()?;
        plan.descendants().find(leads_there)
    });
}

/// Removes the edges of a component that lead out of what `stays` says.
pub(super) fn cut_edges_from(
    draft: &mut Draft,
    component: impl Fn(&Node) -> Option<Node>,
    stays: impl Fn(&str) -> bool,
) {
    cut(draft, |root| {
        let component = component(root)?;
        below(&component, Kind::Edge).find(|edge| {
            target(edge).is_some_and(|target| {
                !matches!(target.text(), "terminate" | "ignore") && !stays(target.text())
            })
        })
    });
}

/// Takes out what is found until nothing is found.
fn cut(draft: &mut Draft, find: impl Fn(&Node) -> Option<Node>) {
    while let Some(node) = find(&draft.root()) {
        take_out(draft, &node);
    }
}
