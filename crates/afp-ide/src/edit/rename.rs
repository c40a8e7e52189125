//! Another name for an item, wherever the files refer to it.

use super::project::Workspace;
use super::tree::{self, range, scope_of};
use super::{Item, Refused, name, refer};
use afp_dsl::types::is_built_in;
use afp_syntax::Node;
use afp_syntax::kind::Kind;

/// Renames an item.
pub(super) fn item(workspace: &mut Workspace, item: &Item, to: &str) -> Result<(), Refused> {
    let root = workspace.buffer().root();
    let node = tree::find(&root, item)?;
    match node.kind() {
        Kind::Element => name::check_element(to)?,
        Kind::Enum if is_built_in(to) => {
            return Err(Refused::new(format!("'{to}' is a type of the language")));
        }
        _ => name::check(to)?,
    }
    name::check_free(&scope_of(&root, item)?, to, Some(item.name()))?;
    if to == item.name() {
        return Ok(());
    }
    if matches!(node.kind(), Kind::Plan | Kind::Enum) {
        check_free_elsewhere(workspace, node.kind(), to)?;
    }
    let project = workspace.project();
    let tokens = refer::to(&project, workspace.home, item);
    if tokens.is_empty() {
        return Err(Refused::new("it has no name yet"));
    }
    for (file, buffer) in workspace.buffers.iter_mut().enumerate() {
        let own = tokens.iter().filter(|(home, _)| *home == file);
        let splices: Vec<_> = own.map(|(_, token)| (range(token), to.to_owned())).collect();
        if splices.is_empty() {
            continue;
        }
        let before = shape(&buffer.root());
        buffer.splice(splices);
        if shape(&buffer.root()) != before {
            return Err(Refused::new(format!("'{to}' would be read as a word of the grammar")));
        }
    }
    Ok(())
}

/// Checks that no file that sees the item's file sees something else of the new name.
fn check_free_elsewhere(workspace: &Workspace, kind: Kind, to: &str) -> Result<(), Refused> {
    let project = workspace.project();
    let seeing = project.sees.iter().enumerate().filter(|(_, seen)| seen.contains(&workspace.home));
    let found = seeing.into_iter().find_map(|(file, _)| project.find(file, kind, to));
    match found {
        None => Ok(()),
        Some((file, _)) => {
            Err(Refused::new(format!("'{to}' is already there in '{}'", workspace.paths[file])))
        }
    }
}

/// The kinds of everything in a tree, which a name must not change.
fn shape(root: &Node) -> Vec<Kind> {
    root.descendants_with_tokens().map(|element| element.kind()).collect()
}
