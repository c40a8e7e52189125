//! Cycles that take no time: endless computations, and conditions that, if they hold together, lead
//! the plan around within a single step.
//!
//! The following take no time: computations; elements that end by an event of the first poll or by
//! a fault of their start; sub-plans that can end by only these. Global supervisors are polled
//! once in a step, so they close no cycle at their own level.

mod choices;
mod count;
mod counters;
mod decided;
pub(super) mod facts;
mod holding;
mod instant;
mod ways;

use std::collections::{BTreeMap, BTreeSet};

use crate::flow::view::{Cause, Edge, Node, View};
use crate::flow::{INTERRUPTED, OK};
use crate::flow::{strong, toggle};
use crate::graph::Target;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Message, Words, list};
use afp_syntax::message;
use afp_syntax::source::Span;

pub(crate) use counters::{components, open_to_writes, unwind};
use decided::Known;

/// The limit of elements of a cycle in a message.
const MAX_NAMES: usize = 8;
/// The limit of conditions in a diagnostic.
const MAX_CONDITIONS: usize = 8;

/// Reports each cycle once, at the edge that closes it.
///
/// Returns the number of edges that the plan takes from its start to an ending in one step, as far
/// as its loops determine it.
pub(super) fn check(view: &View<'_>, diags: &mut Diagnostics) -> i64 {
    let sure = Quick::of(view, |edge| is_sure(view, edge.cause));
    let constants = decided::for_ever(view);
    let mut loops = count::Loops::new(view, &constants);
    let mut reported = BTreeSet::new();
    for (members, inner) in sure.cycles() {
        match sure.has_exit(&members, |_| true) {
            true => loops.add(&members, &inner, &sure.component),
            false => {
                sure.report_endless(&inner, diags);
                reported.extend(members);
            }
        }
    }
    let taken = loops.check(&sure.component, diags);
    let lasting = Quick::with_returns(view, |edge| {
        let cause = edge.cause;
        is_quick(view, edge)
            && holding::can_hold(view, cause)
            && !decided::excludes(view, cause, &constants)
    });
    let lasting = lasting.unwound();
    let is_taken = |edge: &Edge| !decided::excludes(view, edge.cause, &constants);
    for (members, inner) in lasting.cycles() {
        let told = if inner.iter().any(|edge| !is_sure(view, edge.cause)) {
            lasting.report_conditions(&inner, &constants, diags)
        } else if !reported.contains(&members[0]) && !lasting.has_exit(&members, is_taken) {
            lasting.report_decided(&inner, diags);
            true
        } else {
            false
        };
        reported.extend(members.into_iter().filter(|_| told));
    }
    let chosen = Quick::of(view, |edge| {
        let is_open = edge.possible && !reported.contains(&edge.from);
        is_open && is_sure(view, edge.cause) && is_taken(edge)
    });
    let chosen = chosen.unwound();
    for (_, inner) in chosen.cycles() {
        chosen.report_choices(&inner, diags);
    }
    taken
}

/// The endings that are possible in the step of the start, and whether the plan never takes time.
pub(super) fn instant_endings(view: &View<'_>) -> ([bool; 2], bool) {
    let reached = view.edges.iter().filter(|edge| view.reached[edge.from]);
    let quick: Vec<Edge> = reached.filter(|edge| is_quick(view, edge)).copied().collect();
    (instant::endings(view, &quick), timeless(view))
}

/// Whether a plan consists of computations only.
fn timeless(view: &View<'_>) -> bool {
    view.elements().all(|(_, element)| {
        !element.takes_time() || view.summary(element).is_some_and(|inner| inner.timeless)
    })
}

/// Whether an entered element certainly ends at once by an edge of this cause.
fn is_sure(view: &View<'_>, cause: Cause) -> bool {
    let Cause::State(id, _) = cause else { return false };
    let element = &view.plan.elements[id.index()];
    !element.takes_time() || view.summary(element).is_some_and(|inner| inner.timeless)
}

/// Whether an edge can be taken in the step in which its origin is entered.
pub(crate) fn is_quick(view: &View<'_>, edge: &Edge) -> bool {
    match edge.cause {
        Cause::State(id, state) => {
            let element = &view.plan.elements[id.index()];
            !element.takes_time()
                || view.summary(element).is_some_and(|inner| inner.instant[usize::from(state)])
        }
        Cause::Error(_) => true,
        // An event that leads back to the element being entered is not taken.
        Cause::Event(..) => !view.is_shared(edge.from) && edge.from != edge.to,
        // The first poll never misses a deadline, and a global supervisor is polled once in a step.
        Cause::Miss(_) | Cause::On(..) | Cause::Active(_) => false,
    }
}

/// The edges that take no time.
struct Quick<'a, 'b> {
    view: &'a View<'b>,
    /// Edges from elements that can be reached.
    edges: Vec<Edge>,
    /// The index of the first edge of each node.
    first: Vec<u32>,
    /// The strongly connected component of each node.
    component: Vec<u32>,
}

impl<'a, 'b> Quick<'a, 'b> {
    /// The edges for which `takes` is true.
    fn of(view: &'a View<'b>, takes: impl Fn(&Edge) -> bool) -> Self {
        let reached = view.edges.iter().filter(|edge| view.reached[edge.from]);
        Quick::new(view, reached.filter(|edge| takes(edge)).copied().collect())
    }

    /// The same with edges to `return`, except those that events lead to: a handler takes time.
    fn with_returns(view: &'a View<'b>, takes: impl Fn(&Edge) -> bool) -> Self {
        let by_event = |edge: &&Edge| !matches!(edge.cause, Cause::State(..) | Cause::Error(_));
        let back = view.back.iter().filter(|edge| !by_event(edge) && takes(edge));
        let own = view.edges.iter().filter(|edge| view.reached[edge.from]);
        let returns = |edge: &&Edge| {
            by_event(edge)
                && view.handlers.contains(&edge.from)
                && view.computation_returns(edge.to)
        };
        let own = own.filter(|edge| takes(edge) && !returns(edge));
        let mut edges: Vec<Edge> = own.chain(back).copied().collect();
        edges.sort_by_key(|edge| edge.from);
        Quick::new(view, edges)
    }

    fn new(view: &'a View<'b>, edges: Vec<Edge>) -> Self {
        let first = strong::first(view.nodes(), edges.iter().map(|edge| edge.from));
        let component = components(view.nodes(), &edges);
        Quick { view, edges, first, component }
    }

    /// Removes edges that a counter limits to a few rounds of their cycle.
    fn unwound(mut self) -> Self {
        let before = self.edges.len();
        unwind(self.view, self.component.clone(), &mut self.edges, counters::MOST_ROUNDS);
        if self.edges.len() == before { self } else { Quick::new(self.view, self.edges) }
    }

    /// The components that contain a cycle: their nodes, and the edges between them.
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

    /// Whether an edge for which `is_taken` is true, quick or not, leads out of a component.
    fn has_exit(&self, members: &[Node], is_taken: impl Fn(&Edge) -> bool) -> bool {
        let mut edges = members.iter().flat_map(|node| self.view.from(*node));
        let leaves = |node: &Node| {
            [Target::Resume, Target::Return].iter().any(|to| self.view.has_edge_to(*node, *to))
        };
        members.iter().any(leaves)
            || edges.any(|edge| {
                !matches!(edge.cause, Cause::Active(_))
                    && edge.possible
                    && self.can_be_taken(edge.cause)
                    && self.component[edge.from] != self.component[edge.to]
                    && is_taken(edge)
            })
    }

    /// Whether an edge can ever be taken: a fault may be impossible.
    fn can_be_taken(&self, cause: Cause) -> bool {
        match cause {
            Cause::Error(id) => {
                !holding::never_fails(self.view, &self.view.plan.elements[id.index()])
            }
            _ => true,
        }
    }

    /// The cycle that an edge closes: the edge, then a shortest path from its end to its origin.
    /// `room` limits the edges that are examined, and is reduced by their number.
    fn cycle(&self, closing: &Edge, room: &mut usize) -> Option<Vec<Edge>> {
        let mut came_by: BTreeMap<Node, &Edge> = Default::default();
        let mut open = std::collections::VecDeque::from([closing.to]);
        while let Some(node) = open.pop_front() {
            if node == closing.from {
                break;
            }
            let (component, edges) = (self.component[node], self.from(node));
            *room = room.checked_sub(edges.len())?;
            for edge in edges.iter().filter(|edge| self.component[edge.to] == component) {
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
        *room = room.checked_sub(back.len())?;
        Some(back)
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
        let Some(closing) = inner.iter().max_by_key(|edge| self.place(edge)) else { return };
        let Some(cycle) = self.cycle(closing, &mut room(inner)) else { return };
        let message = message!("computations without an exit: {}", Words(self.names(&cycle)));
        diags.push(
            Diagnostic::new(Code::E0305, self.view.span(closing.cause), message)
                .help("lead one of their states to an element outside of the cycle"),
        );
    }

    /// Reports a cycle of computations without an exit for the known values.
    fn report_decided(&self, inner: &[&Edge], diags: &mut Diagnostics) {
        let conditions = inner.iter().filter(|edge| self.is_condition(edge));
        let Some(closing) = conditions.max_by_key(|edge| self.place(edge)) else { return };
        let Some(cycle) = self.cycle(closing, &mut room(inner)) else { return };
        self.report_livelock(closing, &cycle, diags);
    }

    /// Reports cycles of computations that never end, for any values of their conditions.
    fn report_choices(&self, inner: &[&Edge], diags: &mut Diagnostics) {
        let conditions = inner.iter().copied().filter(|edge| self.is_condition(edge));
        self.report_each(inner, conditions, |cycle| choices::never_change(self.view, cycle), diags);
    }

    fn report_conditions(
        &self,
        inner: &[&Edge],
        constants: &Known,
        diags: &mut Diagnostics,
    ) -> bool {
        let unsure = inner.iter().copied().filter(|edge| !is_sure(self.view, edge.cause));
        let lasts = |cycle: &[Edge]| {
            !facts::contradict(self.view, cycle)
                && !decided::breaks_off(self.view, cycle, constants)
                && !self.view.counters().end(self.view, cycle.iter())
        };
        self.report_each(inner, unsure, lasts, diags)
    }

    /// Reports the cycles of `closing` edges for which `last` is true, from the last one in the
    /// text. A cycle with an edge that was already reported is omitted, because the same correction
    /// applies. Returns whether it reported a cycle.
    fn report_each<'e>(
        &self,
        inner: &[&Edge],
        closing: impl Iterator<Item = &'e Edge>,
        last: impl Fn(&[Edge]) -> bool,
        diags: &mut Diagnostics,
    ) -> bool {
        let mut all: Vec<&Edge> = closing.collect();
        all.sort_by_key(|edge| self.place(edge));
        let (mut room, mut reported) = (room(inner), Vec::new());
        while let Some(closing) = all.pop() {
            let Some(cycle) = self.cycle(closing, &mut room) else { break };
            let is_known = cycle.iter().any(|edge| reported.contains(&edge.cause));
            if !is_known && last(&cycle) {
                self.report_livelock(closing, &cycle, diags);
                reported.push(closing.cause);
            }
        }
        !reported.is_empty()
    }

    fn report_livelock(&self, closing: &Edge, cycle: &[Edge], diags: &mut Diagnostics) {
        let conditions: Vec<_> = cycle.iter().filter(|edge| self.is_condition(edge)).collect();
        let labels: Vec<_> =
            conditions.iter().take(MAX_NAMES).map(|edge| self.view.label(edge.cause)).collect();
        let all = list(labels.iter().map(String::as_str), "and");
        let more = if conditions.len() > MAX_NAMES { " and others" } else { "" };
        let message = match labels.len() {
            1 => message!("if {} stays true, the plan loops without time passing", all),
            _ => message!("{}{} together end the run in a livelock", all, Words(more)),
        };
        let mut found = Diagnostic::new(Code::E0306, self.view.span(closing.cause), message);
        for edge in
            conditions.iter().filter(|edge| edge.cause != closing.cause).take(MAX_CONDITIONS)
        {
            let text = message!("this leads to '{}'", self.view.node_name(edge.to));
            found = found.note(self.view.span(edge.cause), text);
        }
        let counting = cycle.iter().find_map(|edge| counters::forgotten(self.view, edge.cause));
        let once = self.once_instead(&conditions);
        let help = match (counting, conditions.len()) {
            (Some((count, entry)), _) => message!("let '{}' count: 'next => {}'", count, entry),
            (None, 1) => {
                "lead it to an element that takes time, such as an actor that waits".into()
            }
            (None, _) if once.is_some() => once.unwrap_or_default(),
            (None, _) if cycle.iter().all(|edge| is_sure(self.view, edge.cause)) => {
                "lead one of them to an element that takes time, such as an actor that waits".into()
            }
            (None, _) => "lead one of them to an element that is not left at once, such as an element without that supervisor"
                .into(),
        };
        diags.push(found.help(help));
    }

    /// The help if all conditions are events of one template and another template reports them
    /// once.
    fn once_instead(&self, conditions: &[&Edge]) -> Option<Message> {
        let supervisor = |edge: &&Edge| match edge.cause {
            Cause::Event(id, _) => Some(self.view.supervisor(id)),
            _ => None,
        };
        let all: Option<Vec<_>> = conditions.iter().map(supervisor).collect();
        let all = all.filter(|all| all.windows(2).all(|two| two[0].template == two[1].template))?;
        toggle::once_instead(self.view, all.first()?.template)
    }

    /// Whether an edge depends on a condition: computations may take another edge, or fail.
    fn is_condition(&self, edge: &Edge) -> bool {
        let fails = |cause| matches!(cause, Cause::Error(_)) && self.can_be_taken(cause);
        let mut others = self.view.from(edge.from).iter().filter(|other| other.to != edge.to);
        !is_sure(self.view, edge.cause)
            || others.any(|other| is_sure(self.view, other.cause) || fails(other.cause))
    }

    /// The order of edges; the last one closes a cycle for a reader of the text from the top.
    fn place(&self, edge: &Edge) -> (bool, Span) {
        (edge.to <= edge.from, self.view.span(edge.cause))
    }
}

/// The limit of edges that are examined for the cycles of a component; the effort is linear in its
/// size.
fn room(inner: &[&Edge]) -> usize {
    inner.len().max(1000).saturating_mul(32)
}

/// The kind of an ending, for instant endings.
fn ending_of(view: &View<'_>, node: Node) -> Option<usize> {
    [OK, INTERRUPTED].into_iter().find(|ending| view.end(*ending) == node)
}
