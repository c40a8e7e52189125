//! Breakpoints of a live run, decided on its control thread.

use std::collections::HashMap;
use std::sync::Arc;

use afp_core::trace::{ComponentId, Record};
use afp_core::{Fault, Instant};
use afp_dsl::types::Constant;
use afp_session::Tripwire;

use super::{Breakpoints, Found, spots};
use crate::hit_count::HitCount;
use crate::program::{Program, Spot};
use crate::state::State;
use crate::watched::Watched;

/// The breakpoints of all clients. It has its own values of all entries, and counts the same hits
/// as [`Breakpoints`].
struct Trips {
    program: Arc<Program>,
    at: HashMap<Spot, Vec<usize>>,
    stops: Vec<Stop>,
    filters: Filters,
    entries: Vec<Constant>,
}

struct Stop {
    counted: HitCount,
    hits: u64,
    /// The condition in each use of the plan.
    conditions: Vec<(ComponentId, Watched)>,
}

/// The exceptions that stop the run.
#[derive(Clone, Copy, Default)]
struct Filters {
    fault: bool,
    missed: bool,
    interruption: bool,
    livelock: bool,
}

impl Breakpoints {
    /// The places that stop the run; `None` if there are none.
    pub(crate) fn tripwire(
        &self,
        program: &Arc<Program>,
        state: &State,
    ) -> Option<Box<dyn Tripwire>> {
        let has = |name: &str| self.filters.values().any(|filters| filters.contains(name));
        let filters = Filters {
            fault: has("fault"),
            missed: has("deadlineMissed"),
            interruption: has("interruption"),
            livelock: has("livelock"),
        };
        let (mut at, mut stops): (HashMap<Spot, Vec<usize>>, Vec<Stop>) = Default::default();
        let all = self.sets.values().flatten().filter(|each| each.wanted.log.is_none());
        for each in all {
            let Ok(Found { spots, counted, conditions, .. }) = &each.found else { continue };
            spots.iter().for_each(|spot| at.entry(*spot).or_default().push(stops.len()));
            let conditions = conditions.iter().map(|(plan, it)| (*plan, it.clone())).collect();
            let hits = each.hits.len() as u64;
            stops.push(Stop { counted: *counted, hits, conditions });
        }
        let none = !(filters.fault || filters.missed || filters.interruption || filters.livelock);
        if stops.is_empty() && none {
            return None;
        }
        let entries = state.constants(program);
        Some(Box::new(Trips { program: program.clone(), at, stops, filters, entries }))
    }
}

impl Filters {
    fn stop(self, record: &Record<'_>) -> bool {
        match record {
            Record::Faulted { fault, .. } => {
                self.fault || self.livelock && *fault == Fault::LIVELOCK
            }
            Record::Missed { .. } => self.missed,
            Record::Interrupted { .. } => self.interruption,
            _ => false,
        }
    }
}

impl Tripwire for Trips {
    fn trips(&mut self, _: Instant, record: &Record<'_>) -> bool {
        if let Record::Committed { entry, new, .. } = *record
            && let Some(kept) = self.entries.get_mut(entry.0 as usize)
        {
            // Texts of a plan always fit into an entry.
            *kept = new.to_value().unwrap_or_default();
        }
        let mut stop = self.filters.stop(record);
        for spot in spots(record, &self.program) {
            let plan = self.program.plan_at(spot);
            for number in self.at.get(&spot).into_iter().flatten() {
                let Some(each) = self.stops.get_mut(*number) else { continue };
                let condition = each.conditions.iter().find(|(known, _)| *known == plan);
                if condition.is_none_or(|(_, it)| it.holds_for(&self.entries)) {
                    each.hits += 1;
                    stop |= each.counted.holds(each.hits);
                }
            }
        }
        stop
    }
}
