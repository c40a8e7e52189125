//! First numbers of sub-plans.
//!
//! In an unfolded plan (`crate::unfold`), a plan's elements and supervisors are followed by the
//! blocks of its sub-plans, element by element, with the same layout; entries likewise.

use crate::graph::{Component, Plan};
use afp_types::Child;

/// The size of a plan's block, and the first numbers of its sub-plans.
pub(super) struct Block {
    /// Number of components, with sub-plans, without itself.
    components: u32,
    /// Number of entries, with sub-plans.
    entries: u32,
    /// First numbers of each element that is a sub-plan; zero for others.
    pub(super) children: Vec<Child>,
}

/// The block of each plan, sub-plans first; `None` if numbers overflow.
pub(super) fn blocks(plans: &[Plan]) -> Option<Vec<Block>> {
    let mut blocks: Vec<Block> = Vec::with_capacity(plans.len());
    for plan in plans {
        let block = block(plan, &blocks)?;
        blocks.push(block);
    }
    Some(blocks)
}

fn block(plan: &Plan, inner: &[Block]) -> Option<Block> {
    let own = plan.elements.len() + plan.supervisors.len();
    let mut block = Block {
        components: u32::try_from(own).ok()?,
        entries: u32::try_from(plan.entries.len()).ok()?,
        children: Vec::with_capacity(plan.elements.len()),
    };
    for element in &plan.elements {
        let Component::SubPlan(id) = element.component else {
            block.children.push(Child::default());
            continue;
        };
        let child = inner.get(id.index())?;
        block.children.push(Child { components: block.components, entries: block.entries });
        block.components = block.components.checked_add(child.components)?;
        block.entries = block.entries.checked_add(child.entries)?;
    }
    Some(block)
}
