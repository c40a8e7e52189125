//! Positions of a drawing, carried along with changes of the text.

use super::{Change, Item};
use afp_draw::layout_file::Layout;

/// Gives items their new names, places and plans after a change of the text.
///
/// What a change adds has no position. Elements that are extracted keep theirs in the new plan,
/// the sub-plan stands where the first of them stood; elements that are inlined are left to the
/// automatic layout.
pub fn follow(layout: &mut Layout, change: &Change) {
    match change {
        Change::Remove { item } => layout.remove(item),
        Change::Rename { item, to } => rename(layout, item, to),
        Change::Move { item, plan, owner } => {
            let name = item.name();
            let to = match owner {
                Some(owner) => Item::local(plan, owner, name),
                None => Item::inner(plan, name),
            };
            layout.relocate(item, &to);
        }
        Change::Extract { plan, elements, new_plan, element } => {
            let first = elements.iter().find_map(|name| layout.get(&Item::inner(plan, name)));
            for name in elements {
                layout.relocate(&Item::inner(plan, name), &Item::inner(new_plan, name));
            }
            if let Some(position) = first {
                layout.set(Item::inner(plan, element), position);
            }
        }
        Change::Inline { plan, element } => layout.remove(&Item::inner(plan, element)),
        _ => {}
    }
}

fn rename(layout: &mut Layout, item: &Item, to: &str) {
    let renamed = match item {
        Item::Plan { .. } => Item::plan(to),
        Item::Enum { .. } | Item::Table { .. } => return,
        Item::Inner { plan, .. } => Item::inner(plan, to),
        Item::Local { plan, owner, .. } => Item::local(plan, owner, to),
    };
    layout.relocate(item, &renamed);
}

#[cfg(test)]
mod tests;
