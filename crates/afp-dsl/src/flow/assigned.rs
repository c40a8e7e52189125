//! Entries that may be read before they are written.
//!
//! A forward search over all paths from `start` finds, in reverse, the entries that can reach an
//! element without a value. An interrupted element writes nothing, a global supervisor can fire
//! from the first look on, and a sub-plan writes the certain outputs of its ending.

mod reads;
mod report;

use crate::flow::dataflow::{WIDTH, propagate};
use crate::flow::view::View;
use crate::flow::{INTERRUPTED, OK};
use crate::graph::{Entry, EntryId, EntryKind};
use afp_syntax::diagnostics::Diagnostics;

use reads::Reads;
use report::Report;

/// Reports each entry once, at the first early read in the source; returns for each ending the
/// `out` entries that may lack a value, with a path.
pub(super) fn check(view: &View<'_>, diags: &mut Diagnostics) -> [Vec<Option<String>>; 2] {
    let outs = view.plan.entries.iter().filter(|entry| entry.kind == EntryKind::Out).count();
    let mut unset = [vec![None; outs], vec![None; outs]];
    let unsure: Vec<EntryId> = unsure(&view.plan.entries);
    if unsure.is_empty() {
        return unset;
    }
    let mut report = Report::new(view, &mut unset, diags);
    let reads = Reads::of(view);
    let writes = writes(view);
    let mut stops = vec![0u64; view.edges.len()];
    for group in unsure.chunks(WIDTH) {
        for (bit, entry) in group.iter().enumerate() {
            writes[entry.index()].iter().for_each(|at| stops[*at as usize] |= 1 << bit);
        }
        let without = propagate(view, u64::MAX, &stops);
        for (bit, entry) in group.iter().enumerate() {
            let may_lack = |node: usize| without[node] >> bit & 1 == 1;
            let writes = &writes[entry.index()];
            report.reads(*entry, &reads, &may_lack, writes);
            report.endings(
                *entry,
                [may_lack(view.end(OK)), may_lack(view.end(INTERRUPTED))],
                writes,
            );
        }
        for entry in group {
            writes[entry.index()].iter().for_each(|at| stops[*at as usize] = 0);
        }
    }
    unset
}

/// The entries without a value at the plan's start.
fn unsure(entries: &[Entry]) -> Vec<EntryId> {
    let unsure = |entry: &Entry| {
        matches!(entry.kind, EntryKind::Var | EntryKind::Out) && entry.init.is_none()
    };
    let with_id = entries.iter().enumerate();
    let unsure = with_id.filter(|(_, entry)| unsure(entry));
    unsure.filter_map(|(index, _)| u16::try_from(index).ok().map(EntryId)).collect()
}

/// For each entry the edges that certainly write it, in ascending order.
fn writes(view: &View<'_>) -> Vec<Vec<u32>> {
    let mut writes: Vec<Vec<u32>> = vec![Vec::new(); view.plan.entries.len()];
    for (at, edge) in view.edges.iter().enumerate() {
        for output in view.writes(edge.cause) {
            writes[output.entry.index()].push(at as u32);
        }
    }
    writes
}
