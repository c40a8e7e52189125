//! Contributions between a plan and its users.

use std::sync::Arc;

use crate::flow::view::{Cause, Node, View};
use crate::graph::{Component, Element, SupervisorId};

use super::cost::Cost;
use super::held::{locals, poll, sum};
use super::level::{Level, Levels};
use super::step::entering;

impl Levels {
    /// Computes the levels; sub-plans come first.
    pub fn of(views: &[View<'_>]) -> Levels {
        let mut all = Vec::with_capacity(views.len());
        for view in views {
            let level = level(view, &all);
            all.push(level);
        }
        Levels { all }
    }
}

fn level(view: &View<'_>, inner: &[Level]) -> Level {
    let plan = view.plan;
    let globals = (0..plan.globals).map(SupervisorId);
    let mut level = Level { globals: sum(view, globals.clone()), ..Level::default() };
    let costs = entering(view, inner);
    // Each global supervisor may divert an entry once.
    let diverted = diverted(view, &costs);
    for (node, element) in view.elements() {
        let own = Own::of(view, element, inner);
        let supervised = locals(view, element);
        if element.takes_time() {
            let by_event = view.of_globals(node).filter(|edge| is_event(edge.cause));
            let by_event = by_event.fold(Cost::ZERO, |most, edge| most.or(&costs[edge.to]));
            let by_event = by_event.or(&behind(view, node, &costs, is_event));
            let step = own.poll.and(&behind(view, node, &costs, is_state));
            let event = own.interrupt.and(&by_event);
            // An unconnected fault ends the plan.
            let fault = match element.on_error {
                Some(_) => own.poll.and(&own.interrupt).and(&behind(view, node, &costs, is_error)),
                None => Cost::ZERO,
            };
            let longest = supervised.and(&step.or(&event).or(&fault));
            if level.longest.is_none() || longest.exceeds(&level.longest_step) {
                let of_active = |cost: &Cost| longest.is_same(&supervised.and(cost));
                let active = match (of_active(&step), of_active(&event)) {
                    (true, _) => own.poll.clone(),
                    (_, true) => own.interrupt.clone(),
                    _ => own.poll.and(&own.interrupt),
                };
                level.longest = Some((node, supervised.time(), active.time()));
            }
            level.longest_step = level.longest_step.or(&longest);
            level.interrupt = level.interrupt.or(&own.interrupt);
            level.stop = level.stop.or(&own.stop);
        }
        level.take_demand(view, node, element, &own);
    }
    level.longest_step = level.longest_step.and(&level.globals).and(&diverted);
    let first = &costs[view.start()];
    let around = level.globals.times(2).and(&diverted);
    level.entering = around.and(first);
    let elements = view.elements().filter(|(_, element)| element.takes_time());
    let any = elements.fold(Cost::ZERO, |most, (node, _)| most.or(&costs[node]));
    level.again = around.and(&any);
    level.add_demand(view, globals);
    level
}

impl Level {
    fn take_demand(&mut self, view: &View<'_>, node: Node, element: &Element, own: &Own) {
        let of_locals = share(view, element.supervisors.iter().copied());
        let demand = own.demand + of_locals.0;
        let unknown = own.demand_unknown.clone().or(of_locals.1);
        self.demand_unknown = self.demand_unknown.take().or(unknown);
        if self.busiest.is_none() || demand > self.demand {
            self.demand = demand;
            self.busiest = Some(node);
        }
    }

    fn add_demand(&mut self, view: &View<'_>, globals: impl Iterator<Item = SupervisorId>) {
        let (demand, unknown) = share(view, globals);
        self.demand += demand;
        self.demand_unknown = self.demand_unknown.take().or(unknown);
    }
}

/// Costs of an element without its supervisors.
#[derive(Default)]
struct Own {
    poll: Cost,
    interrupt: Cost,
    stop: Cost,
    demand: f64,
    demand_unknown: Option<Arc<str>>,
}

impl Own {
    fn of(view: &View<'_>, element: &Element, inner: &[Level]) -> Own {
        match element.component {
            Component::SubPlan(id) => {
                let level = &inner[id.index()];
                Own {
                    poll: level.longest_step.clone(),
                    interrupt: level.interrupt.clone(),
                    stop: level.stop.clone(),
                    demand: level.demand,
                    demand_unknown: level.demand_unknown.clone(),
                }
            }
            Component::Actor(id) => {
                let template = view.model.template(id);
                let poll = Cost::budget(template);
                let per_second = template.budget.unwrap_or(0) as f64 / template.every as f64;
                Own {
                    interrupt: poll.clone(),
                    stop: Cost::stop(template),
                    demand: per_second,
                    demand_unknown: poll.known().err().map(Arc::from),
                    poll,
                }
            }
            Component::Computation(_) => Own::default(),
        }
    }
}

/// The supervisors' share of the processor.
fn share(
    view: &View<'_>,
    supervisors: impl Iterator<Item = SupervisorId>,
) -> (f64, Option<Arc<str>>) {
    supervisors.fold((0.0, None), |(demand, unknown), id| {
        let (own, period) = (poll(view, id).known(), view.supervisor(id).timing.period);
        let share = own.as_ref().map_or(0.0, |own| *own as f64 / period.as_nanos() as f64);
        (demand + share, unknown.or_else(|| own.err().map(Arc::from)))
    })
}

fn is_event(cause: Cause) -> bool {
    matches!(cause, Cause::Event(..) | Cause::Miss(_) | Cause::On(..))
}

fn is_state(cause: Cause) -> bool {
    matches!(cause, Cause::State(..))
}

fn is_error(cause: Cause) -> bool {
    matches!(cause, Cause::Error(_))
}

/// Maximum cost of entries after a node along edges of one kind. An element that `return` continues
/// costs as much as at its start.
fn behind(view: &View<'_>, node: Node, costs: &[Cost], kind: fn(Cause) -> bool) -> Cost {
    let back = view.back.iter().filter(|edge| edge.from == node);
    let edges = view.from(node).iter().chain(back).filter(|edge| kind(edge.cause));
    edges.fold(Cost::ZERO, |most, edge| most.or(&costs[edge.to]))
}

/// Maximum cost of all global events in one step, each of them once.
fn diverted(view: &View<'_>, costs: &[Cost]) -> Cost {
    let mut most: std::collections::BTreeMap<u16, Cost> = Default::default();
    for edge in view.of_all_globals() {
        if let Cause::Event(id, _) | Cause::On(_, id, Some(_)) = edge.cause {
            let known = most.entry(id.0).or_insert(Cost::ZERO);
            *known = known.or(&costs[edge.to]);
        }
    }
    most.values().fold(Cost::ZERO, |sum, cost| sum.and(cost))
}

/// Polls before any of a plan, by index, at its worst use.
pub(super) struct Outside {
    /// `None` if the main plan does not reach it.
    pub before: Vec<Option<Cost>>,
}

impl Outside {
    /// Computes it from the main plan inward.
    pub fn of(views: &[View<'_>], levels: &Levels, main: usize) -> Outside {
        let mut before: Vec<Option<Cost>> = vec![None; views.len()];
        before[main] = Some(Cost::ZERO);
        for index in (0..views.len()).rev() {
            let Some(own) = before[index].clone() else { continue };
            let view = &views[index];
            for (_, element) in view.elements() {
                let Component::SubPlan(id) = element.component else { continue };
                let here = own.and(&levels.all[index].globals).and(&locals(view, element));
                let inner = &mut before[id.index()];
                *inner = Some(inner.as_ref().map_or(here.clone(), |known| known.or(&here)));
            }
        }
        Outside { before }
    }
}
