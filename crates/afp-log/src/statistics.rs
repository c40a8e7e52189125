//! Statistics of a log.

use afp_core::trace::{ComponentId, ComponentKind, Names, Outcome};
use afp_session::{Counts, Usage};

use crate::read::LogData;

/// The deadlines, interruptions and coverage in a log.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// The elements in the order of the plan, by their dotted paths.
    pub elements: Vec<(String, Usage)>,
    /// The supervisors in the order of the plan, by their dotted paths.
    pub supervisors: Vec<(String, Usage)>,
    /// States and events, as `component.outcome`, that never happened; elements that never ran.
    pub uncovered: Vec<String>,
    /// The number of states and events that happened.
    pub covered: u64,
    /// The number of records lost during writing.
    pub lost: u64,
}

/// Computes the statistics of a log.
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
                // An unconnected outcome cannot happen.
                (0, "" | "ignore") => {}
                (0, _) => all.uncovered.push(edge),
            }
        }
        match row.kind {
            ComponentKind::Supervisor => all.supervisors.push((path, usage.clone())),
            ComponentKind::Plan => {}
            _ => all.elements.push((path, usage.clone())),
        }
    }
    all
}
