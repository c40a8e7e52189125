//! How often a run used each part of its plan.

use afp_core::trace::{Author, ComponentId, DEADLINE_MISSED, ERROR, Record, TraceEntryId};
use afp_core::{Fault, ValueRef};
use afp_dsl::graph::Graph;
use afp_dsl::unfold::{Place, places};
use afp_log::LogData;
use afp_log::proto::afp::PlanEvent;
use afp_log::proto::afp::plan_event::Kind;

use crate::parts::Parts;

/// How often each component and entry was used, by number.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Hits {
    /// The components.
    pub components: Vec<Touched>,
    /// How often each entry was written by a component or from outside.
    pub entries: Vec<u64>,
    /// When the plan ended, nanoseconds.
    pub(crate) ended: Option<u64>,
    /// The element of each local supervisor.
    owners: Vec<Option<u32>>,
    /// The plan of each entry, by number.
    homes: Vec<u32>,
    /// Which components have started to take time; computations never do.
    lasting: Vec<bool>,
}

/// How often a component was used.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Touched {
    /// Its starts; for a computation, its runs.
    pub starts: u64,
    /// How often each of its states was reached or events taken, by position.
    pub outcomes: Vec<u64>,
    /// How often it failed (an element) or missed a deadline with a consequence (a supervisor).
    pub special: u64,
}

impl Touched {
    /// The same component, never used.
    fn none(&self) -> Touched {
        Touched { starts: 0, outcomes: vec![0; self.outcomes.len()], special: 0 }
    }
}

/// The record behind an event of a log, as far as it matters here.
fn record(event: &PlanEvent) -> Option<Record<'static>> {
    let component = ComponentId(event.component_id);
    let outcome = u16::try_from(event.outcome_id).ok()?;
    Some(match event.kind() {
        Kind::Started => Record::Started { component },
        Kind::Finished => Record::Finished { element: component, state: outcome },
        Kind::Event => Record::Event { supervisor: component, event: outcome },
        Kind::Faulted => Record::Faulted { component, fault: Fault::INTERNAL },
        Kind::Committed => Record::Committed {
            author: match event.component_id {
                u32::MAX => Author::Outside,
                _ => Author::Component(component),
            },
            entry: TraceEntryId(event.entry_id),
            old: ValueRef::Unset,
            new: ValueRef::Unset,
        },
        _ => return None,
    })
}

impl Hits {
    /// Nothing was used of a plan yet.
    pub(crate) fn new(graph: &Graph) -> Self {
        let (places, homes) = (places(graph), Parts::new(graph).entry_homes());
        let touched = |place: &Place| {
            let outcomes = vec![0; place.outcomes.len()];
            Touched { starts: 0, outcomes, special: 0 }
        };
        Hits {
            components: places.iter().map(touched).collect(),
            entries: vec![0; homes.len()],
            homes,
            ended: None,
            owners: places.iter().map(|place| place.owner).collect(),
            lasting: vec![false; places.len()],
        }
    }

    pub(crate) fn hear(&mut self, record: &Record<'_>) {
        match *record {
            Record::Started { component } => {
                if let Some(lasting) = self.lasting.get_mut(component.0 as usize) {
                    *lasting = true;
                }
                self.start(component);
            }
            Record::Finished { element, state } => {
                // A computation is over when it starts.
                if self.lasting.get(element.0 as usize) == Some(&false) {
                    self.start(element);
                }
                self.reach(element, state);
            }
            Record::Event { supervisor, event } => self.reach(supervisor, event),
            Record::Faulted { component, .. } => {
                let owner = self.owners.get(component.0 as usize).copied().flatten();
                self.reach(owner.map_or(component, ComponentId), ERROR);
            }
            Record::Committed { author, entry, .. } => {
                let place = entry.0 as usize;
                // A plan gives its own entries their first values.
                let home = self.homes.get(place).map(|home| Author::Component(ComponentId(*home)));
                if let Some(count) = self.entries.get_mut(place).filter(|_| home != Some(author)) {
                    *count += 1;
                }
            }
            _ => {}
        }
    }

    /// Adds what another run of the same plan used.
    pub fn add(&mut self, other: &Hits) {
        for (mine, other) in self.components.iter_mut().zip(&other.components) {
            mine.starts += other.starts;
            mine.special += other.special;
            for (mine, other) in mine.outcomes.iter_mut().zip(&other.outcomes) {
                *mine += other;
            }
        }
        for (mine, other) in self.entries.iter_mut().zip(&other.entries) {
            *mine += other;
        }
    }

    /// Adds what a logged run of the same plan used; `false` when the log is of another plan.
    pub fn add_log(&mut self, log: &LogData) -> bool {
        if log.table.components.len() != self.components.len() {
            return false;
        }
        let mut other = Hits {
            components: self.components.iter().map(Touched::none).collect(),
            entries: vec![0; self.entries.len()],
            ended: None,
            homes: self.homes.clone(),
            owners: self.owners.clone(),
            lasting: vec![false; self.components.len()],
        };
        log.events.iter().filter_map(record).for_each(|record| other.hear(&record));
        self.add(&other);
        true
    }

    fn touched(&mut self, id: ComponentId) -> Option<&mut Touched> {
        self.components.get_mut(id.0 as usize)
    }

    fn start(&mut self, id: ComponentId) {
        if let Some(touched) = self.touched(id) {
            touched.starts += 1;
        }
    }

    fn reach(&mut self, id: ComponentId, outcome: u16) {
        let Some(touched) = self.touched(id) else { return };
        match outcome {
            DEADLINE_MISSED | ERROR => touched.special += 1,
            outcome => {
                if let Some(count) = touched.outcomes.get_mut(usize::from(outcome)) {
                    *count += 1;
                }
            }
        }
    }
}
