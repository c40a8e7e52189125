//! The reads of entries in a plan's formulas.

use crate::flow::view::{Node, View};
use crate::graph::{EntryId, Formula, Supervisor};
use afp_syntax::source::Span;

/// A read of an entry.
#[derive(Clone, Copy)]
pub(super) struct Read<'a> {
    /// The element that is entered when the formula is evaluated; `None` for a global supervisor,
    /// whose inputs are read at the plan's start.
    pub node: Option<Node>,
    /// The reading supervisor, if any.
    pub supervisor: Option<&'a Supervisor>,
    /// The entry in the formula.
    pub span: Span,
}

/// All reads, by entry, in source order.
pub(super) struct Reads<'a> {
    by_entry: Vec<Vec<Read<'a>>>,
}

impl<'a> Reads<'a> {
    /// The reads of everything reachable.
    pub fn of(view: &View<'a>) -> Reads<'a> {
        let mut reads = Reads { by_entry: vec![Vec::new(); view.plan.entries.len()] };
        for (node, element) in view.elements() {
            reads.add(&element.inputs, Some(node), None);
        }
        for supervisor in view.supervisors() {
            let node = supervisor.owner.map(|owner| owner.index());
            reads.add(&supervisor.inputs, node, Some(supervisor));
        }
        for places in &mut reads.by_entry {
            places.sort_by_key(|read| read.span);
        }
        reads
    }

    fn add(&mut self, inputs: &[Formula], node: Option<Node>, supervisor: Option<&'a Supervisor>) {
        for formula in inputs {
            for (entry, span) in formula.entries() {
                self.by_entry[entry.index()].push(Read { node, supervisor, span });
            }
        }
    }

    pub fn of_entry(&self, entry: EntryId) -> &[Read<'a>] {
        &self.by_entry[entry.index()]
    }
}
