//! Cycles that take no time: computations that go round for ever, and conditions which, holding
//! together, pass the robot from one look to the next within a single step.
//!
//! Without time pass: computations, elements left by an event of the look or by a fault of their
//! start, and sub-plans that can end through those alone. Global supervisors are asked once in a
//! step, so at their own level they close no cycle.

mod count;
mod decided;
mod holding;
mod instant;

use std::collections::BTreeMap;

use crate::flow::strong;
use crate::flow::view::{Cause, Edge, Node, View, takes_time};
use crate::flow::{INTERRUPTED, OK};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};

use decided::Known;
pub(super) use holding::standard;

/// Greatest number of elements of a cycle that a message names.
const MAX_NAMES: usize = 8;
/// Greatest number of conditions that a diagnostic shows.
const MAX_CONDITIONS: usize = 8;

/// Reports each cycle once, at the edge that closes it.
pub(super) fn check(view: &View<'_>, diags: &mut Diagnostics) {
    let sure = Quick::of(view, |edge| is_sure(view, edge.cause));
    for (members, inner) in sure.cycles() {
        match sure.has_exit(&members) {
            true => count::check(view, &members, inner.len(), diags),
            false => sure.report_endless(&inner, diags),
        }
    }
    // A counter with a small limit lets a cycle be taken a few times only.
    let constants = decided::for_ever(view);
    let lasting = Quick::of(view, |edge| {
        let cause = edge.cause;
        is_quick(view, edge)
            && holding::can_hold(view, cause)
            && !count::is_bounded(view, cause)
            && !decided::excludes(view, cause, &constants)
    });
    for (_, inner) in lasting.cycles() {
        if inner.iter().any(|edge| !is_sure(view, edge.cause)) {
            lasting.report_conditions(&inner, &constants, diags);
        }
    }
}

/// Which endings can come within the step that starts the plan, and whether it never takes time.
pub(super) fn instant_endings(view: &View<'_>) -> ([bool; 2], bool) {
    let reached = view.edges.iter().filter(|edge| view.reached[edge.from]);
    let quick: Vec<Edge> = reached.filter(|edge| is_quick(view, edge)).copied().collect();
    (instant::endings(view, &quick), timeless(view))
}

/// Whether a plan consists of computations only.
fn timeless(view: &View<'_>) -> bool {
    view.elements().all(|(_, element)| {
        !takes_time(element) || view.summary(element).is_some_and(|inner| inner.timeless)
    })
}

/// Whether an element that is entered surely leaves by one of these edges at once.
fn is_sure(view: &View<'_>, cause: Cause) -> bool {
    let Cause::State(id, _) = cause else { return false };
    let element = &view.plan.elements[id.index()];
    !takes_time(element) || view.summary(element).is_some_and(|inner| inner.timeless)
}

/// Whether an edge can be taken in the step in which its origin is entered.
pub(crate) fn is_quick(view: &View<'_>, edge: &Edge) -> bool {
    match edge.cause {
        Cause::State(id, state) => {
            let element = &view.plan.elements[id.index()];
            !takes_time(element)
                || view.summary(element).is_some_and(|inner| inner.instant[usize::from(state)])
        }
        Cause::Error(_) => true,
        // An event that leads back to the element being entered is not taken.
        Cause::Event(..) => !view.is_shared(edge.from) && edge.from != edge.to,
        // The look never raises a miss, and a global supervisor is asked once in a step.
        Cause::Miss(_) | Cause::On(..) | Cause::Active(_) => false,
    }
}

/// How often a counter lets a cycle be taken, where a node is one with a written limit.
pub(crate) fn count_limit(view: &View<'_>, node: Node) -> Option<u64> {
    let limit = count::limit(view, view.element(node)?)?;
    Some(u64::try_from(limit).unwrap_or(0))
}

/// The edges that take no time.
struct Quick<'a, 'b> {
    view: &'a View<'b>,
    /// Those that begin at elements that can be reached.
    edges: Vec<Edge>,
    /// For each node where its edges begin.
    first: Vec<u32>,
    /// For each node its strongly connected component.
    component: Vec<u32>,
}

impl<'a, 'b> Quick<'a, 'b> {
    /// The edges that `takes` lets through.
    fn of(view: &'a View<'b>, takes: impl Fn(&Edge) -> bool) -> Self {
        let mut edges = Vec::new();
        let mut first = Vec::with_capacity(view.nodes() + 1);
        for node in 0..view.nodes() {
            first.push(edges.len() as u32);
            if view.reached[node] {
                let quick = view.from(node).iter().filter(|edge| takes(edge));
                edges.extend(quick.copied());
            }
        }
        first.push(edges.len() as u32);
        let targets: Vec<u32> = edges.iter().map(|edge| edge.to as u32).collect();
        let component = strong::components(&first, &targets);
        Quick { view, edges, first, component }
    }

    /// The components that hold a cycle: their nodes, and the edges between them.
    fn cycles(&self) -> Vec<(Vec<Node>, Vec<&Edge>)> {
        let mut found: BTreeMap<u32, (Vec<Node>, Vec<&Edge>)> = BTreeMap::new();
        for edge in &self.edges {
            let component = self.component[edge.from];
            if component == self.component[edge.to] {
                found.entry(component).or_default().1.push(edge);
            }
        }
        if !found.is_empty() {
            for (node, component) in self.component.iter().enumerate() {
                found.get_mut(component).into_iter().for_each(|(members, _)| members.push(node));
            }
        }
        found.into_values().collect()
    }

    fn from(&self, node: Node) -> &[Edge] {
        &self.edges[self.first[node] as usize..self.first[node + 1] as usize]
    }

    /// Whether any edge, quick or not, leads out of a component.
    fn has_exit(&self, members: &[Node]) -> bool {
        let mut edges = members.iter().flat_map(|node| self.view.from(*node));
        let resumes = members.iter().any(|node| self.view.resumes(*node));
        resumes
            || edges.any(|edge| {
                !matches!(edge.cause, Cause::Active(_))
                    && edge.possible
                    && self.can_be_taken(edge.cause)
                    && self.component[edge.from] != self.component[edge.to]
            })
    }

    /// Whether an edge leads anywhere at all: a fault may be none that can come.
    fn can_be_taken(&self, cause: Cause) -> bool {
        match cause {
            Cause::Error(id) => holding::can_fail(self.view, &self.view.plan.elements[id.index()]),
            _ => true,
        }
    }

    /// The cycle that an edge closes: itself, then a shortest way from its end to its beginning.
    fn cycle(&self, closing: &Edge) -> Vec<Edge> {
        let mut came_by: BTreeMap<Node, &Edge> = Default::default();
        let mut open = std::collections::VecDeque::from([closing.to]);
        while let Some(node) = open.pop_front() {
            if node == closing.from {
                break;
            }
            let component = self.component[node];
            for edge in self.from(node).iter().filter(|edge| self.component[edge.to] == component) {
                if edge.to != closing.to && !came_by.contains_key(&edge.to) {
                    came_by.insert(edge.to, edge);
                    open.push_back(edge.to);
                }
            }
        }
        let mut back = Vec::new();
        let mut node = closing.from;
        while node != closing.to {
            let Some(edge) = came_by.get(&node) else { break };
            back.push(**edge);
            node = edge.from;
        }
        back.push(*closing);
        back.reverse();
        back
    }

    fn names(&self, cycle: &[Edge]) -> String {
        let name = |node: Node| format!("'{}'", self.view.node_name(node));
        let mut names: Vec<_> = cycle.iter().take(MAX_NAMES).map(|edge| name(edge.from)).collect();
        if cycle.len() > MAX_NAMES {
            names.push("...".to_owned());
        }
        names.extend(cycle.first().map(|edge| name(edge.from)));
        names.join(" -> ")
    }

    fn report_endless(&self, inner: &[&Edge], diags: &mut Diagnostics) {
        let Some(closing) = self.closing(inner.iter().copied()) else { return };
        let cycle = self.cycle(closing);
        let message = format!("computations without a way out: {}", self.names(&cycle));
        diags.push(
            Diagnostic::new(Code::E0305, self.view.span(closing.cause), message)
                .help("lead one of their states to an element outside of the cycle"),
        );
    }

    fn report_conditions(&self, inner: &[&Edge], constants: &Known, diags: &mut Diagnostics) {
        let mut unsure: Vec<&Edge> =
            inner.iter().copied().filter(|edge| !is_sure(self.view, edge.cause)).collect();
        let (closing, cycle) = loop {
            let Some(closing) = self.closing(unsure.iter().copied()) else { return };
            let cycle = self.cycle(closing);
            if !holding::contradict(self.view, &cycle)
                && !decided::breaks_off(self.view, &cycle, constants)
            {
                break (closing, cycle);
            }
            unsure.retain(|edge| edge.cause != closing.cause);
        };
        let conditions: Vec<_> = cycle.iter().filter(|edge| self.is_condition(edge)).collect();
        let labels: Vec<_> =
            conditions.iter().take(MAX_NAMES).map(|edge| self.view.label(edge.cause)).collect();
        let all = afp_syntax::diagnostics::words::list(labels.iter().map(String::as_str), "and");
        let more = if conditions.len() > MAX_NAMES { " and others" } else { "" };
        let message = match labels.len() {
            1 => format!("{all} holding on ends the run in a livelock"),
            _ => format!("{all}{more} together end the run in a livelock"),
        };
        let mut found = Diagnostic::new(Code::E0306, self.view.span(closing.cause), message);
        for edge in
            conditions.iter().filter(|edge| edge.cause != closing.cause).take(MAX_CONDITIONS)
        {
            let text = format!("this leads on to '{}'", self.view.node_name(edge.to));
            found = found.note(self.view.span(edge.cause), text);
        }
        let help = match conditions.len() {
            1 => "lead it to an element that takes time, such as an actor that waits",
            _ => {
                "lead one of them to an element that is not left at once, such as one without that supervisor"
            }
        };
        diags.push(found.help(help));
    }

    /// Whether something has to hold for an edge to be taken: computations may decide as well.
    fn is_condition(&self, edge: &Edge) -> bool {
        let others = self.view.from(edge.from).iter();
        !is_sure(self.view, edge.cause)
            || others
                .filter(|other| is_sure(self.view, other.cause))
                .any(|other| other.to != edge.to)
    }

    /// The edge that closes a cycle for somebody who reads the text from above.
    fn closing<'e>(&self, edges: impl Iterator<Item = &'e Edge>) -> Option<&'e Edge> {
        edges.max_by_key(|edge| (edge.to <= edge.from, self.view.span(edge.cause)))
    }
}

/// What instant endings need to know of the kinds of endings.
fn ending_of(view: &View<'_>, node: Node) -> Option<usize> {
    [OK, INTERRUPTED].into_iter().find(|ending| view.end(*ending) == node)
}
