//! What a log says about deadlines, interruptions and coverage.

use afp_core::Duration;
use afp_core::trace::{ComponentId, ComponentKind, Names, Outcome};
use afp_session::{Counts, Usage};

use crate::read::LogData;

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
    /// How often it failed.
    pub faults: u64,
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
    let names = &log.names;
    let mut counts = Counts::new(names);
    for event in &log.events {
        if let Some(record) = event.record() {
            counts.record(event.at, &record);
        }
    }
    counts.finish(log.span.map(|(_, last)| last).unwrap_or_default());
    let mut all = Statistics { lost: log.lost(), ..Statistics::default() };
    for (id, usage) in (0..).map(ComponentId).zip(&counts.components) {
        let row = names.component(id);
        let path = row.path.to_owned();
        let own = (0..).map(Outcome::Declared).zip(&usage.outcomes).map(|(outcome, count)| {
            let count = match row.kind {
                ComponentKind::Supervisor => counts.by_own_edge(id, outcome),
                _ => *count,
            };
            let outcome_name = format!("{path}.{}", names.outcome(id, outcome));
            (count, names.target(id, outcome), outcome_name)
        });
        let reactions = (0..).zip(&usage.reactions).map(|(n, edge)| {
            let target = names.reaction(id, n).map_or("", |edge| edge.target);
            let watcher = names.component(edge.supervisor).path.rsplit('.').next().unwrap_or("");
            let event = names.outcome(edge.supervisor, edge.outcome);
            (edge.count, target, format!("{path}.on {watcher}.{event}"))
        });
        for (count, target, edge) in own.chain(reactions) {
            match (count, target) {
                (1.., _) => all.covered += 1,
                // What leads nowhere cannot happen.
                (0, "" | "ignore") => {}
                (0, _) => all.uncovered.push(edge),
            }
        }
        match row.kind {
            ComponentKind::Supervisor => all.supervisors.push(supervisor(path, usage)),
            ComponentKind::Plan => {}
            _ => all.elements.push(ElementStatistics {
                path,
                activations: usage.starts,
                interruptions: usage.interruptions,
                faults: usage.faults,
                active: usage.active,
            }),
        }
    }
    all
}

fn supervisor(path: String, usage: &Usage) -> SupervisorStatistics {
    SupervisorStatistics {
        path,
        activations: usage.starts,
        polls: usage.polls,
        events: usage.events(),
        faults: usage.faults,
        late_releases: usage.late_releases,
        long_polls: usage.long_polls,
        skipped: usage.skipped,
        worst_lateness: usage.worst_lateness,
    }
}
