//! Loops of computations that exceed the edges of a step.

use std::collections::{BTreeMap, BTreeSet};

use afp_types::MAX_TRANSITIONS_PER_STEP;

use super::counters;
use super::decided::{self, Known};
use super::ways::Ways;
use crate::flow::view::{Cause, Counter, Edge, Node, View};
use crate::graph::{ElementId, SupervisorId, Target, chain, resuming};
use crate::types::Constant;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Message, Words, list};
use afp_syntax::message;
use afp_syntax::source::Span;

/// Maximum number of edges per step.
const MOST: i64 = MAX_TRANSITIONS_PER_STEP as i64;

pub(super) struct Loops<'a, 'b> {
    view: &'a View<'b>,
    constants: &'a Known,
    /// Remaining edges of the search, so that its cost is linear in the plan.
    room: usize,
    found: Vec<Loop>,
}

/// A loop with a counter.
struct Loop {
    id: ElementId,
    counter: Counter,
    component: u32,
    /// Its nodes, each with the number of edges to the counter.
    nodes: Vec<(Node, usize)>,
    /// Number of its edges, if there is only one path around.
    round: Option<usize>,
    /// Counters within it.
    others: Vec<ElementId>,
    /// Number of edges that it takes, capped at the limit of a step.
    taken: i64,
}

impl<'a, 'b> Loops<'a, 'b> {
    pub fn new(view: &'a View<'b>, constants: &'a Known) -> Self {
        Loops { view, constants, room: 100 * MOST as usize, found: Vec::new() }
    }

    /// Adds a cycle if a counter bounds it and its number of rounds is known. `members` are its
    /// nodes, `inner` its edges, `component` numbers the cycles.
    pub fn add(&mut self, members: &[Node], inner: &[&Edge], component: &[u32]) {
        let view = self.view;
        let bounding = view.counters().bounding(view, inner.iter().copied());
        let [(id, counter)] = bounding.as_slice() else { return };
        let all = view.counters().on(inner.iter().copied());
        let round = (inner.len() == members.len()).then_some(inner.len());
        let taken = match round {
            Some(edges) => {
                let rounds = rounds(view, *id, counter);
                Some(rounds.saturating_mul(i64::try_from(edges).unwrap_or(i64::MAX)))
            }
            None => self.followed(members, *id, &all),
        };
        let Some(taken) = taken else { return };
        let others = all.into_iter().map(|(other, _)| other).filter(|other| other != id).collect();
        let nodes = distances(members, inner, id.index());
        let (id, counter, component) = (*id, *counter, component[id.index()]);
        self.found.push(Loop { id, counter, component, nodes, round, others, taken });
    }

    /// Warns of loops that take more edges than a step allows, alone or in sequence. Returns the
    /// number of edges from the plan's start to an ending; after a warning the limit, so that its
    /// users do not warn again.
    pub fn check(&self, component: &[u32], diags: &mut Diagnostics) -> i64 {
        let view = self.view;
        let sub_plans = view.elements().filter_map(|(node, element)| {
            let taken = view.summary(element).map_or(0, |inner| inner.taken);
            (0 < taken && taken < MOST).then_some((node, element, taken))
        });
        let sub_plans: Vec<_> = sub_plans.collect();
        if self.found.is_empty() && sub_plans.is_empty() {
            return 0;
        }
        let loops = self.found.iter().map(|it| (it.component, it.taken));
        let inner = sub_plans.iter().map(|(node, _, taken)| (component[*node], *taken));
        // A loop with too many edges is reported separately.
        let taken_in = loops.chain(inner).filter(|(_, taken)| *taken < MOST).collect();
        let ways = Ways::of(view, component, &taken_in);
        let mut is_reported = false;
        for each in &self.found {
            // At least one edge leads out.
            let others = ways.through(each.component, each.nodes.iter().copied()).max(1);
            if let Some((message, better)) = each.report(view, others) {
                let element = &view.plan.elements[each.id.index()];
                let span = element.inputs.get(1).map_or(element.span, |limit| limit.span);
                diags.push(Diagnostic::new(Code::E0312, span, message).help(better));
                is_reported = true;
            }
        }
        for (node, element, taken) in sub_plans {
            let others = ways.through(component[node], std::iter::once((node, 0)));
            if taken.saturating_add(others) > MOST {
                let message = message!(
                    "'{}' takes {} edges within one step, which may take at most {}, and {} more come before and after it",
                    element.name,
                    taken,
                    MOST,
                    others
                );
                let help = "count less far, or put an actor such as 'Wait' before it";
                diags.push(Diagnostic::new(Code::E0312, element.span, message).help(help));
            }
        }
        self.held(diags);
        if is_reported { MOST } else { ways.to_end(view).clamp(0, MOST) }
    }

    /// Warns of events that resume after such loops and may come in the same step.
    fn held(&self, diags: &mut Diagnostics) {
        let view = self.view;
        let elements = &view.plan.elements;
        let resuming = resuming(elements.iter().map(Some));
        let taken = |edge: &Edge| {
            let first = ElementId(u16::try_from(edge.to).ok()?);
            let (run, _) = chain(elements, Target::Element(first));
            let is_held = run.first().is_some_and(|id| resuming[id.index()]);
            let loops = self.found.iter().filter(|it| is_held && run.contains(&it.id));
            loops.map(|it| it.taken).filter(|taken| *taken < MOST).max()
        };
        let mut reported = BTreeSet::new();
        for (node, _) in view.elements().filter(|(_, element)| element.takes_time()) {
            let mut of_each: BTreeMap<SupervisorId, (i64, Span, String)> = BTreeMap::new();
            for edge in view.from(node).iter().chain(view.of_globals(node)) {
                let (Cause::Event(id, _) | Cause::On(_, id, _)) = edge.cause else { continue };
                let Some(taken) = taken(edge) else { continue };
                let own = of_each.entry(id).or_default();
                if taken > own.0 {
                    *own = (taken, view.span(edge.cause), view.label(edge.cause));
                }
            }
            let all = of_each.values().map(|(taken, ..)| *taken).fold(0, i64::saturating_add);
            let Some((_, span, _)) = of_each.values().max_by_key(|it| it.1) else { continue };
            if all > MOST && of_each.len() > 1 && reported.insert(*span) {
                let names = list(of_each.values().map(|(.., label)| label.as_str()), "and");
                let message = message!(
                    "{} may come in one step and take {} edges together; the limit is {}",
                    names,
                    all,
                    MOST
                );
                let error = Diagnostic::new(Code::E0312, *span, message);
                diags.push(error.help("count less far in one of the loops"));
            }
        }
    }

    /// Number of edges of a cycle with several paths, followed from its counter if all decisions
    /// are known.
    fn followed(
        &mut self,
        members: &[Node],
        from: ElementId,
        all: &[(ElementId, Counter)],
    ) -> Option<i64> {
        let mut known = self.constants.clone();
        let begins = all.iter().map(|(id, counter)| {
            let entered = counters::entered(self.view, *id, counter.entry);
            (counter.entry, Constant::Int(entered))
        });
        known.extend(begins);
        let members: BTreeSet<Node> = members.iter().copied().collect();
        let mut node = from.index();
        for taken in 0..MOST {
            self.room = self.room.checked_sub(1)?;
            let edge = decided::next(self.view, node, &known)?;
            if !members.contains(&edge.to) {
                return Some(taken);
            }
            decided::after(self.view, edge.cause, &mut known);
            node = edge.to;
        }
        Some(MOST)
    }
}

impl Loop {
    /// Message and help if it and the `others`, before and after it, are too many edges.
    fn report(&self, view: &View<'_>, others: i64) -> Option<(Message, Message)> {
        let room = (MOST - others).max(0);
        if self.taken <= room {
            return None;
        }
        let actor = "put an actor such as 'Wait' into the loop";
        let Some(edges) = self.round else {
            let all = std::iter::once(&self.id).chain(&self.others);
            let names = all.map(|id| view.plan.elements[id.index()].name.as_str());
            let names = list(names, "and");
            let go = if self.others.is_empty() { "repeats" } else { "repeat" };
            let message = message!(
                "{} {} more often within one step than {} edges allow",
                names,
                Words(go),
                MOST
            );
            return Some((message, message!("count less far, or {}", Words(actor))));
        };
        let message = self.goes_round(view, edges, others);
        let most = room / i64::try_from(edges).unwrap_or(i64::MAX);
        let better = match most {
            0 => actor.into(),
            most => {
                message!("{}, or {}", better(view, (self.id, &self.counter), most), Words(actor))
            }
        };
        Some((message, better))
    }

    fn goes_round(&self, view: &View<'_>, edges: usize, others: i64) -> Message {
        let name = &view.plan.elements[self.id.index()].name;
        let rounds = rounds(view, self.id, &self.counter);
        let each = if edges > 1 {
            message!(" with {} edges each time", edges)
        } else {
            Message::default()
        };
        match self.taken >= MOST {
            true => message!(
                "'{}' repeats {} times{} within one step, which may take at most {} edges",
                name,
                rounds,
                each,
                MOST
            ),
            false => message!(
                "'{}' repeats {} times{} within one step, which may take at most {} edges, and {} more come before and after the loop",
                name,
                rounds,
                each,
                MOST,
                others
            ),
        }
    }
}

fn rounds(view: &View<'_>, id: ElementId, counter: &Counter) -> i64 {
    counter.limit.saturating_sub(counters::entered(view, id, counter.entry))
}

/// The nodes of a cycle, each with the number of edges to another node if there is only one path.
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

/// How to limit a counter to this many rounds.
fn better(view: &View<'_>, (id, counter): (ElementId, &Counter), rounds: i64) -> Message {
    let entered = counters::entered(view, id, counter.entry);
    if entered < 0 && counter.limit <= rounds {
        let name = &view.plan.entries[counter.entry.index()].name;
        return message!("begin '{}' with {} or more", name, counter.limit - rounds);
    }
    message!("count at most to {}", entered.saturating_add(rounds))
}
