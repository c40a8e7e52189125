//! Several changes at once, applied all or none.
//!
//! If the name of a new item is taken, it gets a different one. Later changes refer to it by the
//! requested name.

mod given;
mod translate;

use std::rc::Rc;

use super::tree::{self, Scope, children, name_of};
use super::workspace::Workspace;
use super::{Change, Item, Refused, TextEdit, add, begin, end, fragment, make, name};
use afp_dsl::Toolboxes;
use afp_syntax::kind::Kind;
use afp_syntax::source::Source;

pub use given::Given;

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Made {
    /// The edits, file by file, in order and without overlaps.
    pub edits: Vec<TextEdit>,
    /// The changes with the assigned names.
    pub changes: Vec<Change>,
    /// Requested names that were taken, with the assigned ones.
    pub given: Given,
    pub added: Vec<Item>,
}

/// Returns the edits of all changes of the file `home`, each like [`edit`](super::edit). The first
/// element of an empty plan becomes its start.
///
/// # Errors
/// A change is refused; no change is made.
pub fn edit_all(
    files: &[Source],
    toolboxes: &Toolboxes,
    home: usize,
    changes: &[Change],
) -> Result<Made, Refused> {
    let mut workspace = begin(files, Rc::new(toolboxes.clone()), home)?;
    let errors = workspace.syntax_errors();
    let mut made = Made::default();
    for change in changes {
        let change = add::from_parts(change.clone())?;
        let mut change = made.given.in_change(&mut workspace, change)?;
        if let Change::Add { plan, owner, text, .. } = &mut change {
            let to = (plan.as_str(), owner.as_deref());
            made.added.extend(add_free(&mut workspace, &mut made.given, to, text)?);
        }
        make(&mut workspace, &change)?;
        let start = first_start(&mut workspace, &change);
        made.changes.push(change);
        if let Some(start) = start {
            make(&mut workspace, &start)?;
            made.changes.push(start);
        }
    }
    made.edits = end(workspace, files, errors)?;
    Ok(made)
}

/// Assigns free names to the items of a text, and adapts its references.
fn add_free(
    workspace: &mut Workspace,
    given: &mut Given,
    (plan, owner): (&str, Option<&str>),
    text: &mut String,
) -> Result<Vec<Item>, Refused> {
    let root = workspace.buffer().root();
    let scope = match owner {
        None => Scope::Plan(tree::plan(&root, plan)?),
        Some(owner) => Scope::Element(tree::element(&root, plan, owner)?),
    };
    let item = |name: &str| match owner {
        None => Item::inner(plan, name),
        Some(owner) => Item::local(plan, owner, name),
    };
    let (_, nodes) = fragment::items(text, owner.is_some())?;
    let mut taken = scope.names();
    let (mut items, mut names) = (Vec::new(), Vec::new());
    for (index, node) in nodes.iter().enumerate() {
        let Some(wished) = name_of(node) else { continue };
        let mut others = taken.clone();
        others.extend(wished_elsewhere(index, &nodes));
        let free = name::fresh(&wished, &taken);
        let free = if free == wished { free } else { name::fresh(&wished, &others) };
        items.push(item(&free));
        taken.push(free.clone());
        names.push((wished, free));
    }
    let (declared, to) = (names, (plan, owner.is_some()));
    *text = translate::items(workspace, given, to, text, &declared)?;
    let named = nodes.iter().filter(|node| name_of(node).is_some());
    for ((wished, free), node) in declared.into_iter().zip(named) {
        given.insert((plan, owner), wished, free, node.kind());
    }
    Ok(items)
}

/// The names of all nodes except one.
fn wished_elsewhere(index: usize, nodes: &[afp_syntax::Node]) -> Vec<String> {
    let others = nodes.iter().enumerate().filter(|(other, _)| *other != index);
    others.filter_map(|(_, node)| name_of(node)).collect()
}

/// Starts a plan without a start at its first new element: the only one, or the start that was cut.
fn first_start(workspace: &mut Workspace, change: &Change) -> Option<Change> {
    let Change::Add { plan, owner: None, text, .. } = change else { return None };
    let node = tree::plan(&workspace.buffer().root(), plan).ok()?;
    if children(&node, Kind::Start).next().is_some() {
        return None;
    }
    let (_, added) = fragment::items(text, false).ok()?;
    let to = added.iter().find(|node| node.kind() == Kind::Element).and_then(name_of)?;
    Some(Change::SetStart { plan: plan.clone(), to })
}
