//! Reports entries that may lack a value, with a path without a write.

use super::reads::{Read, Reads};
use crate::flow::dataflow;
use crate::flow::view::{Cause, Node, View};
use crate::flow::{INTERRUPTED, OK};
use crate::graph::{Entry, EntryId, EntryKind};
use crate::types::Type;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Message, Words};
use afp_syntax::message;

/// Maximum number of other reads in a diagnostic.
const MAX_READS: usize = 3;
/// Maximum number of printed steps of a path.
const MAX_STEPS: usize = 12;
/// Maximum number of path searches per plan, since each is expensive.
const MAX_WAYS: usize = 64;

/// The fix for an entry without a value; objects have no literals.
fn remedy(Entry { name, ty, .. }: &Entry, otherwise: &'static str) -> Message {
    match ty {
        Type::Object(_) => otherwise.into(),
        _ => message!("give '{}' an initial value, or {}", name, Words(otherwise)),
    }
}

pub(super) struct Report<'a, 'b> {
    view: &'a View<'b>,
    unset: &'a mut [Vec<Option<String>>; 2],
    diags: &'a mut Diagnostics,
    ways: usize,
}

impl<'a, 'b> Report<'a, 'b> {
    pub fn new(
        view: &'a View<'b>,
        unset: &'a mut [Vec<Option<String>>; 2],
        diags: &'a mut Diagnostics,
    ) -> Self {
        Report { view, unset, diags, ways: 0 }
    }

    /// Reports the early reads of an entry.
    pub fn reads(
        &mut self,
        entry: EntryId,
        reads: &Reads<'_>,
        may_lack: &dyn Fn(Node) -> bool,
        writes: &[u32],
    ) {
        let early = |read: &&Read<'_>| read.node.is_none_or(may_lack);
        let mut early = reads.of_entry(entry).iter().filter(early);
        let Some(first) = early.next() else { return };
        let declared = &self.view.plan.entries[entry.index()];
        let name = &declared.name;
        let mut found = match first.node {
            Some(_) => Diagnostic::new(
                Code::E0303,
                first.span,
                message!("'{}' may be read before anything has written it", name),
            ),
            None => Diagnostic::new(Code::E0303, first.span, at_start(name, first)),
        };
        found = found.note(declared.span, "it has no value when the plan starts");
        if let Some(node) = first.node {
            let (path, blamed) = self.path(node, writes);
            found = found.note(self.view.plan.start_span, message!("one path: {}", Words(&path)));
            found = blamed.into_iter().fold(found, |found, at| self.blame(found, at, entry));
        }
        for other in early.take(MAX_READS) {
            found = found.note(other.span, "this also reads it too early");
        }
        let otherwise = match first.node {
            Some(_) => "write it on every path to this place",
            None => "watch with a supervisor of an element that runs later",
        };
        self.diags.push(found.help(remedy(declared, otherwise)));
    }

    /// Adds that a sub-plan on the path may not write the entry.
    fn blame(&self, found: Diagnostic, at: usize, entry: EntryId) -> Diagnostic {
        let Cause::State(id, state) = self.view.edges[at].cause else { return found };
        let element = &self.view.plan.elements[id.index()];
        let Some(inner) = self.view.summary(element) else { return found };
        let bound = element.outputs.iter().filter(|output| output.entry == entry);
        let unset = &inner.unset[usize::from(state)];
        let mut ways = bound.filter_map(|output| unset.get(usize::from(output.port))?.as_ref());
        match ways.next() {
            Some(path) => found.note(
                element.span,
                message!("'{}' may end without writing it: {}", element.name, Words(&path)),
            ),
            None => found,
        }
    }

    /// Records that an `out` entry may lack a value at an ending, and warns.
    pub fn endings(&mut self, entry: EntryId, lacks: [bool; 2], writes: &[u32]) {
        let entries = &self.view.plan.entries;
        let declared = &entries[entry.index()];
        if declared.kind != EntryKind::Out {
            return;
        }
        let before = entries[..entry.index()].iter();
        let port = before.filter(|other| other.kind == EntryKind::Out).count();
        for ending in [OK, INTERRUPTED] {
            if lacks[ending] {
                let (path, _) = self.path(self.view.end(ending), writes);
                self.unset[ending][port] = Some(path);
            }
        }
        let Some(path) = &self.unset[OK][port] else { return };
        let message = message!("'{}' may have no value when the plan ends", declared.name);
        self.diags.push(
            Diagnostic::new(Code::E0310, declared.span, message)
                .note(self.view.plan.start_span, message!("one path: {}", Words(&path)))
                .help(remedy(declared, "write it on every path to 'terminate'")),
        );
    }

    /// A path to a node without a write of an entry, as text, with its edges.
    fn path(&mut self, goal: Node, writes: &[u32]) -> (String, Vec<usize>) {
        self.ways += 1;
        if self.ways > MAX_WAYS {
            return ("not searched, because there are too many".to_owned(), Vec::new());
        }
        let passes = |at: usize| writes.binary_search(&(at as u32)).is_err();
        let edges = dataflow::path(self.view, goal, passes).unwrap_or_default();
        (self.spell(&edges), edges)
    }

    fn spell(&self, edges: &[usize]) -> String {
        let mut steps = vec![format!("start '{}'", self.view.node_name(self.view.start()))];
        let mut active = None;
        for at in edges {
            let edge = &self.view.edges[*at];
            let label = self.view.label(edge.cause);
            if matches!(edge.cause, Cause::Active(_)) {
                active = Some(label);
                continue;
            }
            let during = active.take().map(|name| format!(" during '{name}'"));
            let target = self.view.node_name(edge.to);
            steps.push(format!("'{label}'{} -> '{target}'", during.unwrap_or_default()));
        }
        if steps.len() > MAX_STEPS {
            let left = steps.len() - MAX_STEPS;
            let half = MAX_STEPS / 2;
            steps.splice(half..half + left, [format!("... {left} more ...")]);
        }
        steps.join(", ")
    }
}

fn at_start(name: &str, read: &Read<'_>) -> Message {
    let supervisor = read.supervisor.map_or("", |supervisor| supervisor.name.as_str());
    message!(
        "'{}' reads '{}' when the plan starts, before anything has written it",
        supervisor,
        name
    )
}
