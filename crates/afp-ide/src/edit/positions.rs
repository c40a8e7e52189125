//! Positions of a drawing after changes of the text.

use super::{Change, Item};
use afp_draw::layout_file::Layout;

/// Adapts names, places and plans of positions to a change of the text.
///
/// New items have no position. Extracted elements keep theirs in the new plan, and the sub-plan
/// gets the position of the first of them. Inlined elements use the automatic layout.
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
