//! Work of a step before the poll of a supervisor: polls of others, and the effects of their
//! events.
//!
//! A global supervisor survives an interruption. If an earlier one takes an event, it is polled in
//! the following look: after the interruption, the computations on the path, and the starts of the
//! next element's supervisors. In a look another earlier global supervisor may divert, each of them
//! once.

use std::collections::BTreeMap;

use crate::flow::view::{Cause, View};
use crate::graph::{ElementId, SupervisorId, Target};
use crate::rows::polling_order;

use super::cost::Cost;
use super::held::{interrupts, poll};
use super::level::Levels;
use super::step::until_look;

/// Work before the poll of a supervisor in its step, in its plan.
#[derive(Clone)]
pub(super) struct Before {
    pub polls: Cost,
    /// Interruptions and entries before its poll.
    pub entered: Cost,
}

/// For each supervisor of a plan the maximum work before it in one step.
pub(super) fn before(view: &View<'_>, levels: &Levels, index: usize) -> Vec<Before> {
    let plan = view.plan;
    let led = led(view);
    let all = (0..=u16::MAX).map(SupervisorId).take(plan.supervisors.len());
    let nothing = Before { polls: Cost::ZERO, entered: Cost::ZERO };
    let mut before = vec![nothing; plan.supervisors.len()];
    let mut globals = Cost::ZERO;
    let mut locals = vec![Cost::ZERO; plan.elements.len()];
    let mut most_locals = Cost::ZERO;
    // The interrupting event, and the diversions in later looks.
    let (mut interrupted, mut diverted) = (Cost::ZERO, Cost::ZERO);
    for id in polling_order(plan, all) {
        let at = id.index();
        let budget = poll(view, id);
        match plan.supervisors[at].owner {
            None => {
                before[at] = Before {
                    polls: globals.and(&most_locals),
                    entered: interrupted.and(&diverted),
                };
                globals = globals.and(&budget);
                if let Some(led) = led.get(&id.0) {
                    interrupted = interrupted.or(&levels.all[index].interrupt);
                    diverted = diverted.and(led);
                }
            }
            // It ends with its element.
            Some(owner) if view.reached[owner.index()] => {
                let own = &mut locals[owner.index()];
                before[at].polls = globals.and(own);
                *own = own.and(&budget);
                most_locals = most_locals.or(own);
                if let Some(led) = led.get(&id.0) {
                    let (interrupt, _) = levels.interrupting(view, &plan.elements[owner.index()]);
                    interrupted = interrupted.or(&interrupt.and(led));
                }
            }
            Some(_) => {}
        }
    }
    before
}

/// For each supervisor that can make a plan enter another element: the maximum work before the next
/// look.
fn led(view: &View<'_>) -> BTreeMap<u16, Cost> {
    let costs = until_look(view);
    let mut led: BTreeMap<u16, Cost> = BTreeMap::new();
    for edge in view.edges.iter().filter(|edge| view.reached[edge.from]) {
        let by: &[SupervisorId] = match &edge.cause {
            Cause::Event(id, _) | Cause::Miss(id) | Cause::On(_, id, _) => std::slice::from_ref(id),
            // A local supervisor that fails.
            Cause::Error(id) => &view.plan.elements[id.index()].supervisors,
            Cause::State(..) | Cause::Active(_) => continue,
        };
        let Some(element) = view.element(edge.to) else { continue };
        let to = u16::try_from(edge.to).map(|to| Target::Element(ElementId(to)));
        if element.takes_time() || to.is_ok_and(|target| interrupts(view, target)) {
            for id in by {
                let known = led.entry(id.0).or_insert(Cost::ZERO);
                *known = known.or(&costs[edge.to]);
            }
        }
    }
    led
}
