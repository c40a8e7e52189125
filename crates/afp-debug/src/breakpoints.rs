//! Where a run is to stand still.

use std::collections::{BTreeMap, HashMap};

use afp_core::trace::{ComponentId, DEADLINE_MISSED, ERROR};
use afp_session::{EventKind, RunEvent};

use crate::program::{Program, Spot};
use crate::state::State;
use crate::watched::Watched;

/// What a run that is held stands still at, by what it was set with.
#[derive(Debug, Default)]
pub(crate) struct Breakpoints {
    /// By the path of their file.
    lines: BTreeMap<String, Vec<Breakpoint>>,
    functions: Vec<Breakpoint>,
    data: Vec<Breakpoint>,
    /// What goes wrong.
    pub filters: Filters,
    /// Those at each spot.
    at: HashMap<Spot, Vec<u64>>,
    made: u64,
}

/// One of them.
#[derive(Clone, Debug)]
pub(crate) struct Breakpoint {
    pub id: u64,
    /// Where; nowhere while it is not known.
    pub spots: Vec<Spot>,
    /// The run stands still at the hit of that number alone, and later ones.
    pub from_hit: u64,
    /// Counts as hit only while this holds.
    pub condition: Option<Watched>,
    /// Says this in place of standing still.
    pub log: Option<String>,
    /// Hits so far.
    pub hits: u64,
}

/// What a breakpoint is set with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Line,
    Function,
    Data,
}

/// What goes wrong that a run is to stand still at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Filters {
    /// A component fails.
    pub fault: bool,
    /// A deadline is missed.
    pub deadline_missed: bool,
    /// An element is interrupted.
    pub interruption: bool,
}

/// What an event comes to.
#[derive(Debug, Default)]
pub(crate) struct Hits {
    /// Where the run is to stand still.
    pub stop: Vec<(u64, Kind)>,
    /// What is to be said, with values in the place of formulas.
    pub logs: Vec<String>,
    /// Something went wrong that is looked for.
    pub exception: Option<&'static str>,
}

impl Breakpoints {
    /// A number for a new one.
    pub fn number(&mut self) -> u64 {
        self.made += 1;
        self.made
    }

    /// Puts breakpoints in place of all of a file.
    pub fn set_lines(&mut self, file: String, all: Vec<Breakpoint>) {
        self.lines.insert(file, all);
        self.sort();
    }

    /// Puts breakpoints in place of all of their kind.
    pub fn set(&mut self, kind: Kind, all: Vec<Breakpoint>) {
        match kind {
            Kind::Function => self.functions = all,
            Kind::Data | Kind::Line => self.data = all,
        }
        self.sort();
    }

    fn sort(&mut self) {
        let mut at: HashMap<Spot, Vec<u64>> = HashMap::new();
        for each in self.all() {
            each.spots.iter().for_each(|spot| at.entry(*spot).or_default().push(each.id));
        }
        self.at = at;
    }

    fn all(&self) -> impl Iterator<Item = &Breakpoint> {
        self.lines.values().flatten().chain(&self.functions).chain(&self.data)
    }

    fn find(&mut self, id: u64) -> Option<(Kind, &mut Breakpoint)> {
        let lines = self.lines.values_mut().flatten().map(|it| (Kind::Line, it));
        let functions = self.functions.iter_mut().map(|it| (Kind::Function, it));
        let data = self.data.iter_mut().map(|it| (Kind::Data, it));
        lines.chain(functions).chain(data).find(|(_, it)| it.id == id)
    }

    /// What an event comes to, as the next hit of those that are set there.
    pub fn hits(&mut self, event: &RunEvent, program: &Program, state: &State) -> Hits {
        let mut hits = Hits { exception: self.filters.exception(event), ..Hits::default() };
        let numbers: Vec<_> = spots(event, program)
            .filter_map(|spot| self.at.get(&spot))
            .flatten()
            .copied()
            .collect();
        for id in numbers {
            let Some((kind, found)) = self.find(id) else { continue };
            if found.condition.as_ref().is_some_and(|condition| !condition.holds(program, state)) {
                continue;
            }
            found.hits += 1;
            let plan = found.spots.first().map_or(ComponentId(0), |spot| program.plan_at(*spot));
            match &found.log {
                Some(text) => hits.logs.push(filled(text, plan, program, state)),
                None if found.hits >= found.from_hit => hits.stop.push((id, kind)),
                None => {}
            }
        }
        hits
    }
}

impl Filters {
    fn exception(self, event: &RunEvent) -> Option<&'static str> {
        match event.kind {
            EventKind::Faulted if self.fault => Some("fault"),
            EventKind::Missed if self.deadline_missed => Some("deadlineMissed"),
            EventKind::Interrupted if self.interruption => Some("interruption"),
            _ => None,
        }
    }
}

/// Where an event happens.
fn spots(event: &RunEvent, program: &Program) -> impl Iterator<Item = Spot> {
    let (id, outcome) = (event.component_id, event.outcome_id);
    let all = match event.kind {
        EventKind::Started => [Some(Spot::Start(id)), None, None],
        EventKind::Finished => [Some(Spot::Reports(id)), Some(Spot::Outcome(id, outcome)), None],
        EventKind::Event => {
            let reaction = Spot::Reaction(event.element_id, id, outcome);
            [Some(Spot::Reports(id)), Some(Spot::Outcome(id, outcome)), Some(reaction)]
        }
        EventKind::Diverted => {
            let by = event.supervisor_id;
            let reaction = Spot::Reaction(id, by, outcome);
            [Some(Spot::Reports(by)), Some(Spot::Outcome(by, outcome)), Some(reaction)]
        }
        EventKind::Faulted => [Some(Spot::Outcome(id, ERROR)), None, None],
        EventKind::Missed => [Some(Spot::Outcome(id, DEADLINE_MISSED)), None, None],
        // That a plan begins with its initial values is no writing.
        EventKind::Committed => {
            let entry = program.entries.get(event.entry_id.0 as usize);
            let written = entry.is_some_and(|entry| entry.plan != id);
            [written.then_some(Spot::Commit(event.entry_id)), None, None]
        }
        _ => [None; 3],
    };
    all.into_iter().flatten()
}

/// A text in which formulas in braces are their values; one that is none stays as it is.
fn filled(text: &str, plan: ComponentId, program: &Program, state: &State) -> String {
    let mut filled = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        filled.push_str(before);
        let Some((formula, behind)) = after.split_once('}') else {
            filled.push('{');
            rest = after;
            continue;
        };
        let shown = Watched::new(program, plan, formula).and_then(|it| it.shown(program, state));
        filled += &shown.unwrap_or_else(|_| format!("{{{formula}}}"));
        rest = behind;
    }
    filled + rest
}
