//! What a log says about deadlines, interruptions and coverage.

use afp_core::Duration;

use crate::proto::afp::plan_event::{Cause, Kind};
use crate::proto::afp::{PlanEvent, PlanTable, plan_table};
use crate::read::{LogData, instant};

/// A supervisor's record.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SupervisorStatistics {
    /// Dotted path.
    pub path: String,
    /// How often it was started.
    pub activations: u64,
    /// How often it was polled.
    pub polls: u64,
    /// Events taken, the missed deadlines among them where connected.
    pub events: u64,
    /// Deadlines missed because the poll began too late.
    pub late_releases: u64,
    /// Deadlines missed because the poll took too long.
    pub long_polls: u64,
    /// Releases that passed without a poll.
    pub skipped: u64,
    /// The longest time after a deadline.
    pub worst_lateness: Duration,
}

/// An element's record.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ElementStatistics {
    /// Dotted path.
    pub path: String,
    /// How often it was started.
    pub activations: u64,
    /// How often it was interrupted.
    pub interruptions: u64,
    /// How often it failed.
    pub faults: u64,
    /// For how long it was active.
    pub active: Duration,
}

/// What a log says about deadlines, interruptions and coverage.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// The elements in the order of the plan.
    pub elements: Vec<ElementStatistics>,
    /// The supervisors in the order of the plan.
    pub supervisors: Vec<SupervisorStatistics>,
    /// States and events, as `component.outcome`, that never came; elements that never ran.
    pub uncovered: Vec<String>,
    /// States and events that did come.
    pub covered: u64,
    /// Records lost while the log was written.
    pub lost: u64,
}

/// Counts what happened.
pub fn statistics(log: &LogData) -> Statistics {
    let mut count = Count::new(&log.table);
    for event in &log.events {
        count.take(event);
    }
    let end = log.span.map(|(_, last)| last).unwrap_or_default();
    for id in 0..count.components.len() {
        count.stop(id, end);
    }
    count.finish(&log.table)
}

#[derive(Clone, Default)]
struct Component {
    activations: u64,
    interruptions: u64,
    faults: u64,
    active: Duration,
    since: Option<afp_core::Instant>,
    supervisor: SupervisorStatistics,
    outcomes: Vec<bool>,
}

struct Count {
    components: Vec<Component>,
    lost: u64,
}

impl Count {
    fn new(table: &PlanTable) -> Self {
        let component = |row: &plan_table::Component| Component {
            outcomes: vec![false; row.outcomes.len()],
            ..Component::default()
        };
        Count { components: table.components.iter().map(component).collect(), lost: 0 }
    }

    fn take(&mut self, event: &PlanEvent) {
        let at = instant(&event.time);
        self.lost += event.lost;
        let id = event.component_id as usize;
        if matches!(event.kind(), Kind::Interrupted | Kind::Finished | Kind::Ended) {
            self.stop(id, at);
        }
        let Some(component) = self.components.get_mut(id) else { return };
        match event.kind() {
            Kind::Started => {
                component.activations += 1;
                component.since = Some(at);
            }
            Kind::Interrupted => component.interruptions += 1,
            Kind::Faulted => component.faults += 1,
            Kind::Polled => component.supervisor.polls += 1,
            Kind::Missed => component.missed(event),
            Kind::Event => {
                component.supervisor.events += 1;
                component.reached(event.outcome_id);
            }
            Kind::Finished => component.reached(event.outcome_id),
            _ => {}
        }
    }

    fn stop(&mut self, id: usize, at: afp_core::Instant) {
        if let Some(component) = self.components.get_mut(id)
            && let Some(since) = component.since.take()
        {
            component.active = component.active + at.since(since);
        }
    }

    fn finish(self, table: &PlanTable) -> Statistics {
        let mut all = Statistics { lost: self.lost, ..Statistics::default() };
        for (component, row) in self.components.into_iter().zip(&table.components) {
            let path = row.path.clone();
            for (seen, outcome) in component.outcomes.iter().zip(&row.outcomes) {
                match seen {
                    true => all.covered += 1,
                    // What leads nowhere cannot happen.
                    false if outcome.target.is_empty() || outcome.target == "ignore" => {}
                    false => all.uncovered.push(format!("{path}.{}", outcome.name)),
                }
            }
            let Component { activations, interruptions, faults, active, supervisor, .. } =
                component;
            match row.kind() {
                plan_table::Kind::Supervisor => {
                    all.supervisors.push(SupervisorStatistics { path, activations, ..supervisor });
                }
                plan_table::Kind::Plan | plan_table::Kind::Unknown => {}
                _ => all.elements.push(ElementStatistics {
                    path,
                    activations,
                    interruptions,
                    faults,
                    active,
                }),
            }
        }
        all
    }
}

impl Component {
    fn reached(&mut self, outcome: u32) {
        if let Some(seen) = self.outcomes.get_mut(outcome as usize) {
            *seen = true;
        }
    }

    fn missed(&mut self, event: &PlanEvent) {
        let lateness = Duration::from_nanos(event.lateness_ns);
        let own = &mut self.supervisor;
        match event.cause() {
            Cause::LateRelease => own.late_releases += 1,
            Cause::LongPoll => own.long_polls += 1,
            Cause::NoCause => {}
        }
        own.skipped += event.skipped;
        own.worst_lateness = own.worst_lateness.max(lateness);
    }
}
