//! The use counts of each part of a plan in a run.

use afp::load::PlanNames;
use afp_core::Instant;
use afp_core::trace::{Author, ComponentId, Names, Outcome, Record};
use afp_dsl::graph::Graph;
use afp_dsl::unfold::places;
use afp_log::LogData;
use afp_session::Counts;

use crate::parts::Parts;

/// The use counts of components and entries, by number.
#[derive(Clone, Debug, PartialEq)]
pub struct Hits {
    /// The writes of each entry by components or from outside.
    pub entries: Vec<u64>,
    counts: Counts,
    /// The end of the plan, in nanoseconds.
    pub(crate) ended: Option<u64>,
    /// The element of each local supervisor.
    owners: Vec<Option<u32>>,
    /// The plan of each entry, by number.
    homes: Vec<u32>,
}

/// The use counts of a component.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Touched {
    /// Its starts; for a computation, its runs.
    pub starts: u64,
    /// The counts of its states or events, by position.
    pub outcomes: Vec<u64>,
    /// The counts of its reactions to events of global supervisors.
    pub reactions: Vec<u64>,
    /// For an element, the faults of it and its supervisors; for a supervisor, missed deadlines
    /// with an edge.
    pub special: u64,
}

impl Hits {
    /// The counts before a run.
    pub(crate) fn new(graph: &Graph) -> Self {
        let homes = Parts::new(graph).entry_homes();
        Hits {
            entries: vec![0; homes.len()],
            counts: Counts::new(&PlanNames::new(graph)),
            homes,
            ended: None,
            owners: places(graph).iter().map(|place| place.owner).collect(),
        }
    }

    /// The use counts of all components.
    pub fn components(&self) -> impl Iterator<Item = Touched> {
        let all = (0..).zip(&self.counts.components);
        all.map(|(number, usage)| {
            let owned = self.owners.iter().zip(&self.counts.components);
            let of_supervisors: u64 =
                owned.filter(|(owner, _)| **owner == Some(number)).map(|(_, its)| its.faults).sum();
            let id = ComponentId(number);
            let reactions = usage.reactions.iter().map(|edge| edge.count).collect();
            if self.counts.is_supervisor(id) {
                let own = (0..).map(Outcome::Declared).take(usage.outcomes.len());
                let outcomes = own.map(|event| self.counts.by_own_edge(id, event)).collect();
                let special = self.counts.by_own_edge(id, Outcome::DeadlineMissed);
                return Touched { starts: usage.starts, outcomes, reactions, special };
            }
            let special = usage.faults + of_supervisors;
            Touched { starts: usage.starts, outcomes: usage.outcomes.clone(), reactions, special }
        })
    }

    pub(crate) fn on_record(&mut self, at: Instant, record: &Record<'_>) {
        self.counts.record(at, record);
        if let Record::Committed { author, entry, .. } = *record {
            let index = entry.0 as usize;
            // The initial values of a plan's entries are not writes.
            let home = self.homes.get(index).map(|home| Author::Component(ComponentId(*home)));
            if let Some(count) = self.entries.get_mut(index).filter(|_| home != Some(author)) {
                *count += 1;
            }
        }
    }

    /// Adds the counts of another run of the same plan.
    pub fn add(&mut self, other: &Hits) {
        self.counts.add(&other.counts);
        for (mine, other) in self.entries.iter_mut().zip(&other.entries) {
            *mine += other;
        }
    }

    /// Adds the counts of a logged run of the same plan; returns false for a log of a different
    /// plan.
    pub fn add_log(&mut self, log: &LogData) -> bool {
        if log.names.components() as usize != self.counts.components.len() {
            return false;
        }
        for event in &log.events {
            if let Some(record) = event.record() {
                self.on_record(event.at, &record);
            }
        }
        true
    }
}
