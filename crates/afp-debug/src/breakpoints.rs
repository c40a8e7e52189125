//! Breakpoints: where a run pauses.

mod tripwire;
mod wanted;

use std::collections::{BTreeMap, BTreeSet, HashMap};

use afp_core::Fault;
use afp_core::trace::{Author, ComponentId, Ending, Outcome, Record};
use afp_session::{EventKind, RunEvent};

use crate::adapter::ClientId;
use crate::hit_count::HitCount;
use crate::program::{Program, Spot};
use crate::state::State;
use crate::watched::Watched;

pub(crate) use wanted::{At, Wanted};

#[derive(Debug, Default)]
pub(crate) struct Breakpoints {
    sets: BTreeMap<(ClientId, Set), Vec<Breakpoint>>,
    /// The enabled exception filters of each client, by protocol name.
    filters: BTreeMap<ClientId, BTreeSet<&'static str>>,
    at: HashMap<Spot, Vec<u64>>,
    made: u64,
    /// Whether they have changed since a live run got its tripwire.
    pub changed: bool,
}

/// Breakpoints that a client sets together.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Set {
    /// At lines of a file, by its path.
    Lines(String),
    Functions,
    Data,
}

#[derive(Clone, Debug)]
pub(crate) struct Breakpoint {
    pub id: u64,
    /// The request, for a changed text.
    pub wanted: Wanted,
    /// The place in the current program, or the reason why it has none.
    pub found: Result<Found, String>,
    pub hits: Vec<u64>,
}

/// The place of a breakpoint in a program.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    /// Events at that place, in each use of its plan.
    pub spots: Vec<Spot>,
    /// The line of a line breakpoint, from 0.
    pub line: Option<u32>,
    pub counted: HitCount,
    /// The condition of a hit, in each use of its plan.
    pub conditions: BTreeMap<ComponentId, Watched>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Line,
    Function,
    Data,
}

/// The consequences of an event.
#[derive(Debug, Default)]
pub(crate) struct Hits {
    pub stop: Vec<(u64, Kind)>,
    /// Log messages with values instead of formulas.
    pub logs: Vec<String>,
    /// A fault that a filter asks for.
    pub exception: Option<&'static str>,
}

impl Set {
    fn kind(&self) -> Kind {
        match self {
            Set::Lines(_) => Kind::Line,
            Set::Functions => Kind::Function,
            Set::Data => Kind::Data,
        }
    }
}

impl Breakpoints {
    pub fn number(&mut self) -> u64 {
        self.made += 1;
        self.made
    }

    /// Replaces a client's breakpoints of a set, and returns the old ones.
    pub fn set(&mut self, owner: ClientId, set: Set, all: Vec<Breakpoint>) -> Vec<Breakpoint> {
        let before = self.sets.insert((owner, set), all).unwrap_or_default();
        self.sort();
        before
    }

    pub fn set_filters(&mut self, owner: ClientId, filters: BTreeSet<&'static str>) {
        self.filters.insert(owner, filters);
        self.changed = true;
    }

    /// Whether a client asks to stop on collisions.
    pub fn looks_for_collisions(&self) -> bool {
        self.filters.values().any(|filters| filters.contains("collision"))
    }

    pub fn forget(&mut self, owner: ClientId) -> Vec<Breakpoint> {
        self.filters.remove(&owner);
        let own = self.sets.keys().filter(|(known, _)| *known == owner).cloned();
        let own: Vec<_> = own.collect();
        let gone = own.iter().filter_map(|key| self.sets.remove(key)).flatten().collect();
        self.sort();
        gone
    }

    pub fn of_others(&self, than: ClientId) -> impl Iterator<Item = (ClientId, &Breakpoint)> {
        let others = self.sets.iter().filter(move |((owner, _), _)| *owner != than);
        others.flat_map(|((owner, _), all)| all.iter().map(|each| (*owner, each)))
    }

    /// Locates all breakpoints in a program; returns those with a changed place, with their owners.
    pub fn find_in(&mut self, program: &Program) -> Vec<(ClientId, Breakpoint)> {
        let mut moved = Vec::new();
        for ((owner, _), all) in &mut self.sets {
            for each in all {
                let made = each.wanted.clone().made(each.id, program);
                let before = std::mem::replace(each, made);
                if before.line() != each.line() {
                    moved.push((*owner, each.clone()));
                }
            }
        }
        self.sort();
        moved
    }

    fn sort(&mut self) {
        let mut at: HashMap<Spot, Vec<u64>> = HashMap::new();
        for each in self.sets.values().flatten() {
            let spots = each.found.iter().flat_map(|found| &found.spots);
            spots.for_each(|spot| at.entry(*spot).or_default().push(each.id));
        }
        self.at = at;
        self.changed = true;
    }

    fn find(&mut self, id: u64) -> Option<(Kind, &mut Breakpoint)> {
        let all = self.sets.iter_mut().flat_map(|((_, set), all)| {
            let kind = set.kind();
            all.iter_mut().map(move |each| (kind, each))
        });
        all.into_iter().find(|(_, each)| each.id == id)
    }

    /// Forgets hits after the given number of steps.
    pub fn go_back(&mut self, steps: u64) {
        for each in self.sets.values_mut().flatten() {
            each.hits.retain(|step| *step < steps);
        }
    }

    /// Returns the consequences of an event and counts its hits; `steps` are complete before it.
    pub fn hits(&mut self, event: &RunEvent, steps: u64, program: &Program, state: &State) -> Hits {
        let exception = self.filters.values().find_map(|filters| exception(filters, event));
        let mut hits = Hits { exception, ..Hits::default() };
        let mut there = BTreeSet::new();
        let at: Vec<_> = event
            .record()
            .into_iter()
            .flat_map(|record| spots(&record, program))
            .flat_map(|spot| self.at.get(&spot).into_iter().flatten().map(move |id| (*id, spot)))
            .filter(|(id, _)| there.insert(*id))
            .collect();
        for (id, spot) in at {
            let Some((kind, each)) = self.find(id) else { continue };
            let Ok(found) = &each.found else { continue };
            let plan = program.plan_at(spot);
            if found.conditions.get(&plan).is_some_and(|it| !it.holds(program, state)) {
                continue;
            }
            each.hits.push(steps);
            if !found.counted.holds(each.hits.len() as u64) {
                continue;
            }
            match &each.wanted.log {
                Some(text) => hits.logs.push(filled(text, plan, program, state)),
                None => hits.stop.push((id, kind)),
            }
        }
        hits
    }
}

impl Breakpoint {
    /// The line of a line breakpoint, or the reason why it has no place.
    fn line(&self) -> Result<Option<u32>, &str> {
        self.found.as_ref().map(|found| found.line).map_err(|why| &**why)
    }
}

/// The fault of an event, if a filter asks for it.
fn exception(filters: &BTreeSet<&'static str>, event: &RunEvent) -> Option<&'static str> {
    let names: &[&str] = match &event.kind {
        EventKind::Faulted(fault) if fault.code == Fault::LIVELOCK.code() => &["livelock", "fault"],
        EventKind::Ended { fault, .. } if fault.code == Fault::LIVELOCK.code() => &["livelock"],
        EventKind::Faulted(_) => &["fault"],
        EventKind::Missed(_) => &["deadlineMissed"],
        EventKind::Interrupted => &["interruption"],
        _ => &[],
    };
    names.iter().find_map(|name| filters.get(name).copied())
}

fn spots(record: &Record<'_>, program: &Program) -> impl Iterator<Item = Spot> + use<> {
    let all = match *record {
        Record::Started { component } => [Some(Spot::Start(component)), None, None],
        Record::Finished { element, state } => {
            [Some(Spot::Reports(element)), Some(Spot::Outcome(element, state)), None]
        }
        Record::Event { supervisor, event, element }
        | Record::Diverted { supervisor, event, element } => reported(supervisor, event, element),
        // The plan itself ends, by its own fault or by a component's.
        Record::Faulted { component: ComponentId(0), .. } => [None; 3],
        Record::Faulted { component, .. } => {
            [Some(Spot::Outcome(component, Outcome::Error)), None, None]
        }
        Record::Ended { plan: plan @ ComponentId(0), ending: Ending::Error(_) } => {
            [Some(Spot::Outcome(plan, Outcome::Error)), None, None]
        }
        Record::Missed { supervisor, .. } => {
            [Some(Spot::Outcome(supervisor, Outcome::DeadlineMissed)), None, None]
        }
        // The initial values of a plan do not count as writes.
        Record::Committed { author, entry, .. } => {
            let declared = program.entries.get(entry.0 as usize);
            let written = declared.is_some_and(|it| Author::Component(it.plan) != author);
            [written.then_some(Spot::Commit(entry)), None, None]
        }
        _ => [None; 3],
    };
    all.into_iter().flatten()
}

/// The places of a supervisor's event while an element is active or starting.
fn reported(supervisor: ComponentId, event: Outcome, element: ComponentId) -> [Option<Spot>; 3] {
    let reaction = Spot::Reaction(element, supervisor, event);
    [Some(Spot::Reports(supervisor)), Some(Spot::Outcome(supervisor, event)), Some(reaction)]
}

/// Replaces formulas in braces by their values; an invalid formula stays unchanged.
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
