//! Coverage of a plan by its scenarios.

use std::fmt::Write;

use afp_draw::Usage;
use afp_dsl::graph::{EntryKind, Graph};
use afp_dsl::unfold::{
    ComponentKind, ComponentNames, EntryNames, Goal, Place, Reaction, places, unfold,
};
use afp_log::LogData;

use crate::parts::Parts;
use crate::watch::hits::{Hits, Touched};

/// The use counts of a plan's parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Coverage {
    /// The plan's name.
    pub plan: String,
    /// Elements, then outcomes of each component, then entries.
    pub parts: Vec<Part>,
    /// The counts for drawings, plan by plan; several uses of a plan are added up.
    pub usage: Usage,
}

/// A part of a plan with its number of uses.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// The part's kind.
    pub kind: PartKind,
    /// Its name: `go`, `go.touch.TouchSensorPressed`, `walldist`.
    pub name: String,
    /// The number of uses.
    pub count: u64,
}

/// The kinds of parts that coverage counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PartKind {
    /// A started actor, computation or sub-plan.
    Element,
    /// A state of an element.
    State,
    /// An event of a supervisor.
    Event,
    /// A connected `DeadlineMissed`.
    Deadline,
    /// A connected `Error`.
    Error,
    /// An entry of the configuration.
    Entry,
}

impl PartKind {
    /// Every kind, in the order of the table.
    pub const ALL: [PartKind; 6] = [
        PartKind::Element,
        PartKind::State,
        PartKind::Event,
        PartKind::Deadline,
        PartKind::Error,
        PartKind::Entry,
    ];

    /// The name of several parts of this kind.
    pub fn plural(self) -> &'static str {
        match self {
            PartKind::Element => "elements",
            PartKind::State => "states",
            PartKind::Event => "events",
            PartKind::Deadline => "deadlines",
            PartKind::Error => "errors",
            PartKind::Entry => "entries",
        }
    }
}

impl Coverage {
    /// Makes the coverage of a plan from the `hits` of all runs.
    pub fn new(graph: &Graph, hits: &Hits) -> Coverage {
        let all = unfold(graph);
        let mut parts = Vec::new();
        let places = places(graph);
        let components = all.components.iter().zip(&places).zip(hits.components());
        for ((names, place), touched) in components.skip(1) {
            add(names, place, &touched, &mut parts);
            let reactions = place.reactions.iter().zip(&touched.reactions);
            parts.extend(reactions.filter_map(|((reaction, goal, _), count)| {
                let edge = own_edge(&names.path, reaction, &all.components)?;
                (*goal != Goal::Ignore).then_some(Part { count: *count, ..edge })
            }));
        }
        let entries = all.entries.iter().zip(&hits.entries);
        parts.extend(entries.filter_map(|(entry, count)| of_entry(entry, *count)));
        Coverage { plan: graph.main().name.clone(), parts, usage: Parts::new(graph).usage(hits) }
    }

    /// Makes the coverage of a logged run; `None` for a log of a different plan.
    pub fn of_log(graph: &Graph, log: &LogData) -> Option<Coverage> {
        let mut hits = Hits::new(graph);
        hits.add_log(log).then(|| Coverage::new(graph, &hits))
    }

    /// The number of a kind's parts, and the number of used ones.
    pub fn of(&self, kind: PartKind) -> (usize, usize) {
        let parts = || self.parts.iter().filter(|part| part.kind == kind);
        (parts().count(), parts().filter(|part| part.count > 0).count())
    }

    /// The parts that no run used.
    pub fn unused(&self) -> impl Iterator<Item = &Part> {
        self.parts.iter().filter(|part| part.count == 0)
    }

    /// A table, followed by the unused parts.
    pub fn text(&self) -> String {
        let mut text = format!("coverage of {}\n", self.plan);
        for kind in PartKind::ALL {
            let (all, used) = self.of(kind);
            if all > 0 {
                let _ = writeln!(text, "{:>10}  {used} of {all}", kind.plural());
            }
        }
        for part in self.unused() {
            let _ = writeln!(text, "     never  {}", part.name);
        }
        text
    }
}

fn add(names: &ComponentNames, place: &Place, touched: &Touched, parts: &mut Vec<Part>) {
    let (kind, special, path) = (names.kind, &place.special, &names.path);
    let watches = kind == ComponentKind::Supervisor;
    let mut part = |kind, name: String, count| parts.push(Part { kind, name, count });
    if !watches {
        part(PartKind::Element, path.clone(), touched.starts);
    }
    let leads = |goal: &Option<Goal>| !matches!(goal, None | Some(Goal::Ignore));
    for (((name, _), goal), count) in
        names.outcomes.iter().zip(&place.outcomes).zip(&touched.outcomes)
    {
        if leads(goal) {
            let kind = if watches { PartKind::Event } else { PartKind::State };
            part(kind, format!("{path}.{name}"), *count);
        }
    }
    if leads(special) {
        let (kind, name) = match watches {
            true => (PartKind::Deadline, "DeadlineMissed"),
            false => (PartKind::Error, "Error"),
        };
        part(kind, format!("{path}.{name}"), touched.special);
    }
}

/// The part for an element's reaction to an event of its plan's supervisor: `wait.on keys.Start`.
fn own_edge(path: &str, reaction: &Reaction, components: &[ComponentNames]) -> Option<Part> {
    let watcher = components.get(usize::try_from(reaction.supervisor).ok()?)?;
    let name = watcher.path.rsplit('.').next()?;
    let (kind, event) = match reaction.event {
        Some(event) => (PartKind::Event, watcher.outcomes.get(usize::from(event))?.0.as_str()),
        None => (PartKind::Deadline, "DeadlineMissed"),
    };
    Some(Part { kind, name: format!("{path}.on {name}.{event}"), count: 0 })
}

/// The part for an entry, if a run can write it.
fn of_entry(entry: &EntryNames, count: u64) -> Option<Part> {
    let written = matches!(entry.kind, EntryKind::Var | EntryKind::Out);
    written.then(|| Part { kind: PartKind::Entry, name: entry.path.clone(), count })
}
