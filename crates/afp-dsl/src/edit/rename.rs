//! Another name for an item, wherever the file refers to it.

use super::draft::Draft;
use super::tree::{self, range, scope_of};
use super::{Item, Refused, name, refer};
use crate::syntax::Node;
use crate::syntax::kind::Kind;

/// Renames an item.
pub(super) fn item(draft: &mut Draft, item: &Item, to: &str) -> Result<(), Refused> {
    let root = draft.root();
    let node = tree::find(&root, item)?;
    match node.kind() {
        Kind::Element => name::check_element(to)?,
        _ => name::check(to)?,
    }
    name::check_free(&scope_of(&root, item)?, to, Some(item.name()))?;
    if to == item.name() {
        return Ok(());
    }
    let before = shape(&root);
    let tokens = refer::to(&root, item);
    draft.splice(tokens.iter().map(|token| (range(token), to.to_owned())).collect());
    if shape(&draft.root()) != before {
        return Err(Refused::new(format!("'{to}' would be read as a word of the grammar")));
    }
    Ok(())
}

/// The kinds of everything in a tree, which a name must not change.
fn shape(root: &Node) -> Vec<Kind> {
    root.descendants_with_tokens().map(|element| element.kind()).collect()
}
