//! Loops of computations that count further than one step may go.

use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};

use afp_types::MAX_TRANSITIONS_PER_STEP;

use super::counters;
use super::decided::{self, Known};
use super::ways::Ways;
use crate::flow::view::{Counter, Edge, Node, View};
use crate::graph::{Element, ElementId};
use crate::types::Constant;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Message, Words, list};
use afp_syntax::message;

/// Edges that may be taken in one step.
const MOST: i64 = MAX_TRANSITIONS_PER_STEP as i64;

/// The loops of a plan.
pub(super) struct Loops<'a, 'b> {
    view: &'a View<'b>,
    /// What never changes.
    constants: &'a Known,
    /// How many edges may still be followed, so that the effort grows with the plan alone.
    room: usize,
    ways: OnceCell<Ways>,
}

impl<'a, 'b> Loops<'a, 'b> {
    /// Those of a plan in which these values never change.
    pub fn new(view: &'a View<'b>, constants: &'a Known) -> Self {
        Loops { view, constants, room: 100 * MOST as usize, ways: OnceCell::new() }
    }

    /// Warns of a cycle whose counters go round too often. `members` are its nodes, `inner` its edges, `component` numbers
    /// the cycles.
    pub fn check(
        &mut self,
        members: &[Node],
        inner: &[&Edge],
        component: &[u32],
        diags: &mut Diagnostics,
    ) {
        let view = self.view;
        let bounding = view.counters().bounding(view, inner.iter().copied());
        let [(id, counter)] = bounding.as_slice() else { return };
        let element = &view.plan.elements[id.index()];
        let ways = self.ways.get_or_init(|| Ways::of(view, component));
        let nodes = distances(members, inner, id.index());
        // At least one leads out.
        let others = ways.through(component[id.index()], nodes.into_iter()).clamp(1, MOST - 1);
        let told = if inner.len() == members.len() {
            let entered = counters::entered(view, *id, counter.entry);
            simple(view, element, (counter, entered), inner.len(), others)
        } else if self.spins(members, *id, others, &view.counters().on(inner.iter().copied())) {
            let others = view.counters().on(inner.iter().copied()).into_iter();
            let others = others.map(|(other, _)| other).filter(|other| other != id);
            let all: Vec<_> = [*id].into_iter().chain(others).collect();
            let names = all.iter().map(|id| view.plan.elements[id.index()].name.as_str());
            let (names, go) = (list(names, "and"), if all.len() == 1 { "goes" } else { "go" });
            let message = message!(
                "{} {} round more often within one step than {} edges allow",
                names,
                Words(go),
                MOST
            );
            Some((message, "count less far".into()))
        } else {
            None
        };
        if let Some((message, better)) = told {
            let span = element.inputs.get(1).map_or(element.span, |limit| limit.span);
            let help = message!("{}, or put an actor such as 'Wait' into the loop", better);
            diags.push(Diagnostic::new(Code::E0312, span, message).help(help));
        }
    }

    /// Whether a cycle with several ways round, followed from the counter that bounds it, takes more edges than a step may
    /// with the `others` that lead to it and on from it, all that its computations decide being known.
    fn spins(
        &mut self,
        members: &[Node],
        from: ElementId,
        others: i64,
        all: &[(ElementId, Counter)],
    ) -> bool {
        let mut known = self.constants.clone();
        let begins = all.iter().map(|(id, counter)| {
            let entered = counters::entered(self.view, *id, counter.entry);
            (counter.entry, Constant::Int(entered))
        });
        known.extend(begins);
        let members: BTreeSet<Node> = members.iter().copied().collect();
        let mut node = from.index();
        for _ in 0..=MOST - others {
            let Some(room) = self.room.checked_sub(1) else { return false };
            self.room = room;
            let Some(edge) = decided::next(self.view, node, &known) else { return false };
            if !members.contains(&edge.to) {
                return false;
            }
            decided::after(self.view, edge.cause, &mut known);
            node = edge.to;
        }
        true
    }
}

/// The nodes of a cycle, each with the number of edges to another one where there is only one way round.
fn distances(members: &[Node], inner: &[&Edge], to: Node) -> Vec<(Node, usize)> {
    if inner.len() != members.len() {
        return members.iter().map(|node| (*node, 0)).collect();
    }
    let next: BTreeMap<Node, Node> = inner.iter().map(|edge| (edge.from, edge.to)).collect();
    let (mut nodes, mut node) = (vec![(to, 0)], next.get(&to));
    while let Some(at) = node.filter(|at| **at != to && nodes.len() < members.len()) {
        nodes.push((*at, inner.len() - nodes.len()));
        node = next.get(at);
    }
    nodes
}

/// What is told of a cycle of so many edges with one way round, if its counter, come to with that value, goes round too often
/// beside the `others` that lead to it and on from it, and what is better.
fn simple(
    view: &View<'_>,
    element: &Element,
    (counter, entered): (&Counter, i64),
    edges: usize,
    others: i64,
) -> Option<(Message, Message)> {
    let length = i64::try_from(edges).unwrap_or(i64::MAX);
    let rounds = counter.limit.saturating_sub(entered);
    let taken = rounds.saturating_mul(length);
    let name = &element.name;
    let each =
        if edges > 1 { message!(" with {} edges each time", edges) } else { Message::default() };
    let message = || match taken >= MOST {
        true => message!(
            "'{}' goes round {} times{} within one step, which may take at most {} edges",
            name,
            rounds,
            each,
            MOST
        ),
        false => message!(
            "'{}' goes round {} times{} within one step, which may take at most {} edges, and {} more lead to the loop and on from it",
            name,
            rounds,
            each,
            MOST,
            others
        ),
    };
    let is_long = taken > MOST - others;
    is_long.then(|| (message(), better(view, (counter, entered), (MOST - others) / length)))
}

/// How a counter goes round so often at most.
fn better(view: &View<'_>, (counter, entered): (&Counter, i64), rounds: i64) -> Message {
    if entered < 0 && counter.limit <= rounds {
        let name = &view.plan.entries[counter.entry.index()].name;
        return message!("begin '{}' with {} or more", name, counter.limit - rounds);
    }
    message!("count at most to {}", entered.saturating_add(rounds))
}
