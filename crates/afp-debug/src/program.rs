//! A plan as a program that can be debugged: its components and entries with their places in the
//! texts.

use std::collections::BTreeMap;
use std::fmt::Write;

use afp_core::trace::{ComponentId, Outcome, TraceEntryId, TraceHash};
use afp_dsl::graph::{Component, EntryKind, Graph, PlanId, Timing};
use afp_dsl::timing::{SupervisorTiming, timing};
use afp_dsl::unfold::{self, ComponentKind, Reaction, places, unfold};
use afp_syntax::source::{Encoding, LineColumn, Lines, Sources, Span};

/// A plan with the places of all its parts.
#[derive(Clone, Debug)]
pub struct Program {
    /// The paths of the files, by [`Place::file`].
    pub files: Vec<String>,
    /// All components by number; the first is the plan itself.
    pub units: Vec<Unit>,
    pub entries: Vec<Entry>,
    plans: Vec<Place>,
    /// The edges that begin at a place, in each use of its plan.
    edges: BTreeMap<Place, Vec<Spot>>,
    /// The events of each line of a file.
    lines: BTreeMap<(usize, u32), Vec<Spot>>,
    pub(crate) graph: Graph,
    /// Texts that differ from their files, or have none.
    texts: BTreeMap<usize, String>,
    /// Hashes of the plan's texts, by file.
    hashes: Vec<(usize, String)>,
}

/// A component: the plan, an element, a supervisor.
#[derive(Clone, Debug)]
pub struct Unit {
    /// Dotted path from the outermost plan; for the outermost plan its name.
    pub path: String,
    /// The last name of the path.
    pub name: String,
    pub template: String,
    pub kind: ComponentKind,
    /// Its plan, by the number of the plan's element.
    pub plan: ComponentId,
    /// The element of a local supervisor.
    pub owner: Option<ComponentId>,
    /// Input ports: name and SI unit, which is empty for other types.
    pub inputs: Vec<(String, String)>,
    /// Bound output ports: name, and the path of the entry.
    pub outputs: Vec<(String, String)>,
    /// States or events: name and target.
    pub outcomes: Vec<(String, String)>,
    /// Edges that override those of the plan's supervisors: supervisor, event and target.
    pub reactions: Vec<(ComponentId, Outcome, String)>,
    /// The poll times of a supervisor and their consequences.
    pub times: Option<Times>,
    pub at: Place,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Times {
    pub timing: Timing,
    /// The time from its condition until the robot has stopped, with its reliability; `None` if it
    /// interrupts nothing.
    pub bound: Option<String>,
}

#[derive(Clone, Debug)]
pub struct Entry {
    /// Dotted path from the outermost plan.
    pub path: String,
    pub name: String,
    pub plan: ComponentId,
    pub kind: EntryKind,
    /// Its type in source form.
    pub ty: String,
    /// The SI unit of its values, empty for other types.
    pub unit: String,
    pub at: Place,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// An index into [`Program::files`].
    pub file: usize,
    /// Its line, from 0.
    pub line: u32,
    /// Its column, from 0, in UTF-16 units.
    pub column: u32,
}

/// An event at a place of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Spot {
    /// The start of an actor or a sub-plan.
    Start(ComponentId),
    /// A state of an element, or an event of a supervisor.
    Outcome(ComponentId, Outcome),
    /// Any event of a supervisor, or the end of a computation.
    Reports(ComponentId),
    /// A supervisor's event during the first element, which has its own reaction to it.
    Reaction(ComponentId, ComponentId, Outcome),
    Commit(TraceEntryId),
}

impl Unit {
    /// Finds a state or event by name.
    pub(crate) fn outcome(&self, name: &str) -> Option<Outcome> {
        match (self.outcomes.iter().position(|(known, _)| known == name), name) {
            (Some(number), _) => u16::try_from(number).ok().map(Outcome::Declared),
            (None, "Error") => Some(Outcome::Error),
            (None, "DeadlineMissed") => Some(Outcome::DeadlineMissed),
            _ => None,
        }
    }
}

impl Program {
    /// Makes the program of a graph. `sources` are the texts of its spans, and `path` returns the
    /// client's name of a file.
    pub fn new(graph: &Graph, sources: &Sources, path: &dyn Fn(&str) -> String) -> Program {
        let texts = Texts::new(sources);
        let (unfolded, places) = (unfold(graph), places(graph));
        let times = times(graph);
        let units = unfolded.components.into_iter().zip(&places).map(|(names, place)| Unit {
            name: last(&names.path).to_owned(),
            path: names.path,
            template: names.template,
            kind: names.kind,
            plan: ComponentId(place.plan),
            owner: place.owner.map(ComponentId),
            inputs: names.inputs.into_iter().map(|port| (port.name, port.unit)).collect(),
            outputs: (names.outputs.into_iter()).map(|(_, port)| (port.name, port.entry)).collect(),
            outcomes: names.outcomes,
            reactions: names.reactions.into_iter().map(reaction).collect(),
            times: times.get(&place.span).cloned(),
            at: texts.place(place.span),
        });
        let entries = unfolded.entries.into_iter().map(|entry| Entry {
            name: last(&entry.path).to_owned(),
            path: entry.path,
            plan: ComponentId(entry.plan),
            kind: entry.kind,
            unit: entry.unit,
            ty: entry.type_text,
            at: texts.place(entry.span),
        });
        let (units, entries): (Vec<_>, Vec<_>) = (units.collect(), entries.collect());
        let mut program = Program {
            files: texts.names(path),
            units,
            entries,
            plans: graph.plans.iter().map(|plan| texts.place(plan.span)).collect(),
            edges: BTreeMap::new(),
            lines: BTreeMap::new(),
            graph: graph.clone(),
            texts: BTreeMap::new(),
            hashes: (graph.sources.iter())
                .map(|(file, source)| (usize::from(*file), hash(&source.text)))
                .collect(),
        };
        for (number, place) in (0..).zip(&places).skip(1) {
            program.add_component(ComponentId(number), place, &texts);
        }
        for number in 0..program.entries.len() {
            let entry = &program.entries[number];
            if entry.kind != EntryKind::Const {
                program.add(entry.at, Spot::Commit(TraceEntryId(number as u32)));
            }
        }
        program
    }

    /// Adds the events at a component and its edges.
    fn add_component(&mut self, id: ComponentId, place: &unfold::Place, texts: &Texts<'_>) {
        let Some(kind) = self.unit(id).map(|unit| unit.kind) else { return };
        let special = match kind {
            ComponentKind::Supervisor => Outcome::DeadlineMissed,
            _ => Outcome::Error,
        };
        self.add(texts.place(place.span), first(id, kind));
        let outcomes = (0..).map(Outcome::Declared).zip(&place.edges.outcomes);
        for (outcome, span) in outcomes.chain([(special, &place.edges.extra)]) {
            let at = span.map(|span| texts.place(span));
            at.into_iter().for_each(|at| self.add_edge(at, Spot::Outcome(id, outcome)));
        }
        for (edge, _, span) in &place.reactions {
            let (supervisor, event) = (ComponentId(edge.supervisor), edge.event);
            let spot = Spot::Reaction(id, supervisor, reacts_on(event));
            self.add_edge(texts.place(*span), spot);
        }
    }

    /// Keeps texts that the client's files do not have; `is_file` compares a file's text.
    pub fn keep_texts(&mut self, sources: &Sources, is_file: &dyn Fn(&str, &str) -> bool) {
        let named = self.files.iter().zip(sources.iter()).enumerate();
        let others = named.filter(|(_, (path, source))| !is_file(path, &source.text));
        self.texts = others.map(|(file, (_, source))| (file, source.text.to_string())).collect();
    }

    /// The text of a file that the client does not have.
    pub fn text_of(&self, file: usize) -> Option<&str> {
        self.texts.get(&file).map(String::as_str)
    }

    /// The plan's files with the hashes of the running texts: 64-bit FNV-1a over UTF-8 with LF line
    /// ends.
    pub fn hashes(&self) -> impl Iterator<Item = (&str, &str)> {
        self.hashes.iter().filter_map(|(file, hash)| Some((&**self.files.get(*file)?, &**hash)))
    }

    fn add_edge(&mut self, at: Place, spot: Spot) {
        self.edges.entry(at).or_default().push(spot);
        self.add(at, spot);
    }

    /// The edges that begin at a place, in each use of its plan.
    pub fn edges_at(&self, at: Place) -> &[Spot] {
        self.edges.get(&at).map_or(&[], Vec::as_slice)
    }

    /// Adds an event to a line. If a component is declared in one line, the line means its start.
    fn add(&mut self, at: Place, spot: Spot) {
        let spots = self.lines.entry((at.file, at.line)).or_default();
        let edge = |spot: &Spot| matches!(spot, Spot::Outcome(..) | Spot::Reaction(..));
        if spots.iter().all(edge) || !edge(&spot) {
            spots.retain(|known| edge(known) == edge(&spot));
            spots.push(spot);
        }
    }

    /// All components except the plan itself.
    pub fn parts(&self) -> impl Iterator<Item = (ComponentId, &Unit)> {
        (0..).map(ComponentId).zip(&self.units).skip(1)
    }

    pub fn unit(&self, id: ComponentId) -> Option<&Unit> {
        self.units.get(id.0 as usize)
    }

    pub fn file(&self, path: &str) -> Option<usize> {
        self.files.iter().position(|name| name == path)
    }

    /// The events of a line or, if it has none, of the next line with events.
    pub fn at_line(&self, file: usize, line: u32) -> Option<(u32, &[Spot])> {
        let next = self.lines.range((file, line)..(file, u32::MAX)).next();
        next.map(|((_, line), spots)| (*line, &**spots))
    }

    /// The lines of a range with events; both ends are included.
    pub fn lines(&self, file: usize, from: u32, to: u32) -> impl Iterator<Item = u32> + '_ {
        self.lines.range((file, from)..=(file, to)).map(|((_, line), _)| *line)
    }

    pub fn plan_at(&self, spot: Spot) -> ComponentId {
        let plan = match spot {
            Spot::Start(id) | Spot::Outcome(id, _) | Spot::Reports(id) | Spot::Reaction(id, ..) => {
                self.unit(id).map(|it| it.plan)
            }
            Spot::Commit(id) => self.entries.get(id.0 as usize).map(|it| it.plan),
        };
        plan.unwrap_or_default()
    }

    /// Everything around a place: each use of its plan, and the last component named before it.
    pub fn around(&self, at: Place) -> Vec<(ComponentId, Option<ComponentId>)> {
        let is_before = |place: &Place| place.file == at.file && *place <= at;
        let units = || self.parts().filter(|(_, unit)| is_before(&unit.at));
        let entries = || self.entries.iter().filter(|entry| is_before(&entry.at));
        let plans = || self.plans.iter().filter(|place| is_before(place));
        let last = units().map(|(_, unit)| unit.at).chain(entries().map(|entry| entry.at));
        let Some(last) = last.chain(plans().copied()).max() else { return Vec::new() };
        let units = units().filter(|(_, unit)| unit.at == last);
        let entries = entries().filter(|entry| entry.at == last);
        let mut found: Vec<_> = units.map(|(id, unit)| (unit.plan, Some(id))).collect();
        found.extend(entries.map(|entry| (entry.plan, None)));
        if found.is_empty() {
            let head = |id: &ComponentId| self.plan_of(*id).map(|plan| self.plans[plan.index()]);
            let all = (0..self.units.len() as u32).map(ComponentId);
            let all = all.filter(|id| {
                let kind = self.units[id.0 as usize].kind;
                matches!(kind, ComponentKind::Plan | ComponentKind::SubPlan)
            });
            found.extend(all.filter(|id| head(id) == Some(last)).map(|id| (id, None)));
        }
        found
    }

    pub(crate) fn text_from(&self, at: Place) -> Option<&str> {
        let mut sources = self.graph.sources.iter();
        let (_, source) = sources.find(|(file, _)| usize::from(*file) == at.file)?;
        let place = LineColumn { line: at.line, column: at.column };
        source.text.get(Lines::new(&source.text).offset(place, Encoding::Utf16) as usize..)
    }

    /// The plan of a sub-plan element, or the outermost one.
    pub(crate) fn plan_of(&self, plan: ComponentId) -> Option<PlanId> {
        if plan == ComponentId(0) {
            return Some(self.graph.main);
        }
        let unit = self.unit(plan)?;
        let around = self.plan_of(unit.plan)?;
        let mut elements = self.graph.plan(around).elements.iter();
        match elements.find(|element| element.name == unit.name)?.component {
            Component::SubPlan(id) => Some(id),
            _ => None,
        }
    }

    /// Finds the meaning of a path: an element (`patrol.avoid`), a supervisor, one of its states or
    /// events (`patrol.avoid.touch.TouchSensorPressed`), or the failure of the plan
    /// (`Patrol.Error`).
    pub fn find(&self, path: &str) -> Option<Spot> {
        let part = |path: &str| self.parts().find(|(_, unit)| unit.path == path);
        if let Some((id, unit)) = part(path) {
            return Some(first(id, unit.kind));
        }
        let (component, outcome) = path.rsplit_once('.')?;
        let Some((id, unit)) = part(component) else {
            let is_plan = self.units.first().is_some_and(|plan| plan.path == component);
            let fails = is_plan && outcome == "Error";
            return fails.then_some(Spot::Outcome(ComponentId(0), Outcome::Error));
        };
        Some(Spot::Outcome(id, unit.outcome(outcome)?))
    }

    /// Finds an entry by its name inside a plan, or by its full path.
    pub fn entry(&self, plan: ComponentId, name: &str) -> Option<TraceEntryId> {
        let inside = self.entries.iter().position(|it| it.plan == plan && it.name == name);
        let found = inside.or_else(|| self.entries.iter().position(|it| it.path == name))?;
        Some(TraceEntryId(found as u32))
    }
}

/// The hash of a text, independent of line ends.
fn hash(text: &str) -> String {
    let mut hash = TraceHash::default();
    // Writing to a hash cannot fail.
    let _ = hash.write_str(&text.trim_start_matches('\u{feff}').replace("\r\n", "\n"));
    hash.to_string()
}

/// The times of all supervisors, by the places of their names.
fn times(graph: &Graph) -> BTreeMap<Span, Times> {
    let row = |row: SupervisorTiming| {
        let bound = row.interruption.map(|it| {
            let total = it.total().map(afp_dsl::types::text::duration);
            let trust = it.trust.as_str();
            total.map_or_else(|| trust.to_owned(), |total| format!("{total} ({trust})"))
        });
        (row.span, Times { timing: row.timing, bound })
    };
    timing(graph, None).supervisors.into_iter().map(row).collect()
}

fn reaction((edge, target): (Reaction, String)) -> (ComponentId, Outcome, String) {
    (ComponentId(edge.supervisor), reacts_on(edge.event), target)
}

fn reacts_on(event: Option<u16>) -> Outcome {
    event.map_or(Outcome::DeadlineMissed, Outcome::Declared)
}

/// The event of a component's declaration.
fn first(id: ComponentId, kind: ComponentKind) -> Spot {
    match kind {
        ComponentKind::Supervisor | ComponentKind::Computation => Spot::Reports(id),
        ComponentKind::Plan | ComponentKind::Actor | ComponentKind::SubPlan => Spot::Start(id),
    }
}

struct Texts<'a> {
    files: Vec<(&'a str, Lines<'a>)>,
}

impl<'a> Texts<'a> {
    fn new(sources: &'a Sources) -> Texts<'a> {
        let file =
            |source: &'a afp_syntax::source::Source| (&*source.name, Lines::new(&source.text));
        Texts { files: sources.iter().map(file).collect() }
    }

    fn names(&self, path: &dyn Fn(&str) -> String) -> Vec<String> {
        self.files.iter().map(|(name, _)| path(name)).collect()
    }

    fn place(&self, span: Span) -> Place {
        let file = usize::from(span.file);
        let Some((_, lines)) = self.files.get(file) else { return Place::default() };
        let at = lines.position(span.start, Encoding::Utf16);
        Place { file, line: at.line, column: at.column }
    }
}

fn last(path: &str) -> &str {
    path.rsplit('.').next().unwrap_or(path)
}
