//! Where the numbers of sub-plans begin.
//!
//! A running plan is unfolded (`crate::unfold`): the elements and supervisors of a plan are followed by
//! the blocks of its sub-plans, element by element, laid out alike; entries likewise.

use crate::graph::{Component, Plan};
use afp_types::Child;

/// How many numbers a plan takes, and where those of its sub-plans begin.
pub(super) struct Block {
    /// Components, those of sub-plans included, itself excluded.
    components: u32,
    /// Entries, those of sub-plans included.
    entries: u32,
    /// For each element that is a sub-plan, where its numbers begin; zero for the others.
    pub(super) children: Vec<Child>,
}

/// The block of each plan, sub-plans before the plans that use them; `None` when there are more
/// components or entries than numbers.
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
