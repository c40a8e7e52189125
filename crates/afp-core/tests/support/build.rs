//! Builds plans from elements, supervisors and edges by name, as rows of the scheduler.

use std::sync::Arc;

use afp_core::rt::{
    Child, ElementId, ElementKind, ElementRow, Events, PlanTable, Range, ReasonId, SupervisorId,
    SupervisorRow, Target, Timing,
};
use afp_core::trace::EntryKind;
use afp_core::{Duration, Fault, Reason, Value};

/// The reason of every `fail`.
pub const STUCK: Fault = Fault::new(&Reason { code: Fault::FAILED, text: "stuck" });

/// A complete plan.
pub struct Spec {
    pub name: String,
    pub start: u16,
    pub globals: u16,
    pub entries: Vec<EntrySpec>,
    pub elements: Vec<ElementSpec>,
    pub supervisors: Vec<SupervisorSpec>,
    pub element_rows: Vec<ElementRow>,
    pub supervisor_rows: Vec<SupervisorRow>,
    pub edges: Vec<Option<Target>>,
    pub sweeps: Vec<u16>,
}

#[derive(Clone)]
pub struct EntrySpec {
    pub name: &'static str,
    pub kind: EntryKind,
    pub init: Value,
    /// Initialisation fails.
    pub broken: bool,
}

/// Outcome of an element or supervisor, written entry, and value.
type Write = (&'static str, &'static str, Value);

#[derive(Clone)]
pub struct ElementSpec {
    pub name: &'static str,
    pub kind: ElementKind,
    period: u64,
    pub states: Vec<(&'static str, &'static str)>,
    pub on_error: Option<&'static str>,
    pub guards: Vec<SupervisorSpec>,
    pub reads: Vec<&'static str>,
    pub live: Option<&'static str>,
    pub writes: Vec<Write>,
    pub plan: Option<Arc<Spec>>,
    pub ins: Vec<(&'static str, &'static str)>,
    pub outs: Vec<(&'static str, &'static str)>,
    /// Targets of a global supervisor's events while the element is active.
    pub reactions: Vec<(&'static str, &'static str, &'static str)>,
}

#[derive(Clone)]
pub struct SupervisorSpec {
    pub name: &'static str,
    period: u64,
    deadline: u64,
    budget: u64,
    pub events: Vec<(&'static str, &'static str)>,
    pub on_miss: Option<&'static str>,
    pub live: Option<&'static str>,
    pub writes: Vec<Write>,
    /// It continues when its element returns.
    pub continues: bool,
}

/// A plan under construction; the first element added runs first.
pub struct Builder {
    name: &'static str,
    entries: Vec<EntrySpec>,
    elements: Vec<ElementSpec>,
    globals: Vec<SupervisorSpec>,
}

pub fn plan(name: &'static str) -> Builder {
    Builder { name, entries: Vec::new(), elements: Vec::new(), globals: Vec::new() }
}

fn element(name: &'static str, kind: ElementKind) -> ElementSpec {
    ElementSpec {
        name,
        kind,
        period: 10,
        states: Vec::new(),
        on_error: None,
        guards: Vec::new(),
        reads: Vec::new(),
        live: None,
        writes: Vec::new(),
        plan: None,
        ins: Vec::new(),
        outs: Vec::new(),
        reactions: Vec::new(),
    }
}

pub fn actor(name: &'static str) -> ElementSpec {
    element(name, ElementKind::Actor)
}

pub fn computation(name: &'static str) -> ElementSpec {
    element(name, ElementKind::Computation)
}

pub fn sub_plan(name: &'static str, plan: Builder) -> ElementSpec {
    ElementSpec { plan: Some(plan.build()), ..element(name, ElementKind::SubPlan) }
}

/// A supervisor with a period and deadline in milliseconds.
pub fn guard(name: &'static str, period: u64) -> SupervisorSpec {
    SupervisorSpec {
        name,
        period,
        deadline: period,
        budget: 0,
        events: Vec::new(),
        on_miss: None,
        live: None,
        writes: Vec::new(),
        continues: false,
    }
}

impl ElementSpec {
    pub fn every(mut self, period: u64) -> Self {
        self.period = period;
        self
    }

    /// A state and its target; for sub-plans the first is `OK`, the second `Interrupted`.
    pub fn on(mut self, state: &'static str, target: &'static str) -> Self {
        self.states.push((state, target));
        self
    }

    pub fn on_error(mut self, target: &'static str) -> Self {
        self.on_error = Some(target);
        self
    }

    pub fn guarded(mut self, guard: SupervisorSpec) -> Self {
        self.guards.push(guard);
        self
    }

    /// The target of a global supervisor's event while the element is active.
    pub fn reacts(mut self, guard: &'static str, event: &'static str, to: &'static str) -> Self {
        self.reactions.push((guard, event, to));
        self
    }

    pub fn reads(mut self, entry: &'static str) -> Self {
        self.reads.push(entry);
        self
    }

    /// An entry recorded at every poll.
    pub fn live(mut self, entry: &'static str) -> Self {
        self.live = Some(entry);
        self
    }

    pub fn writes(mut self, state: &'static str, entry: &'static str, value: i64) -> Self {
        self.writes.push((state, entry, Value::Int(value)));
        self
    }

    /// The set of all states.
    pub fn all(&self) -> Events {
        Events::from_bits((1 << self.states.len()) - 1)
    }

    /// A sub-plan's `in` entry and the outer entry that it reads.
    pub fn input(mut self, inner: &'static str, outer: &'static str) -> Self {
        self.ins.push((inner, outer));
        self
    }

    /// A sub-plan's `out` entry and the outer entry that it writes.
    pub fn output(mut self, inner: &'static str, outer: &'static str) -> Self {
        self.outs.push((inner, outer));
        self
    }
}

impl SupervisorSpec {
    pub fn deadline(mut self, deadline: u64) -> Self {
        self.deadline = deadline;
        self
    }

    pub fn budget(mut self, budget: u64) -> Self {
        self.budget = budget;
        self
    }

    pub fn on(mut self, event: &'static str, target: &'static str) -> Self {
        self.events.push((event, target));
        self
    }

    pub fn on_miss(mut self, target: &'static str) -> Self {
        self.on_miss = Some(target);
        self
    }

    pub fn continues(mut self) -> Self {
        self.continues = true;
        self
    }

    /// An entry recorded at every poll.
    pub fn live(mut self, entry: &'static str) -> Self {
        self.live = Some(entry);
        self
    }

    pub fn writes(mut self, event: &'static str, entry: &'static str, value: i64) -> Self {
        self.writes.push((event, entry, Value::Int(value)));
        self
    }
}

impl Builder {
    pub fn entry(mut self, name: &'static str, kind: EntryKind, init: Value) -> Self {
        self.entries.push(EntrySpec { name, kind, init, broken: false });
        self
    }

    pub fn var(self, name: &'static str) -> Self {
        self.entry(name, EntryKind::Var, Value::Unset)
    }

    /// An entry whose initial value cannot be computed.
    pub fn broken(mut self, name: &'static str) -> Self {
        let init = Value::Unset;
        self.entries.push(EntrySpec { name, kind: EntryKind::Var, init, broken: true });
        self
    }

    pub fn guarded(mut self, guard: SupervisorSpec) -> Self {
        self.globals.push(guard);
        self
    }

    pub fn with(mut self, element: ElementSpec) -> Self {
        self.elements.push(element);
        self
    }

    pub fn build(self) -> Arc<Spec> {
        let mut spec = Spec {
            name: self.name.to_owned(),
            start: 0,
            globals: self.globals.len() as u16,
            entries: self.entries,
            elements: self.elements,
            supervisors: self.globals,
            element_rows: Vec::new(),
            supervisor_rows: Vec::new(),
            edges: Vec::new(),
            sweeps: Vec::new(),
        };
        let globals = spec.supervisors.len();
        for index in 0..globals {
            spec.add_supervisor(index, index);
        }
        let mut child = Child { components: spec.components(), entries: spec.entries.len() as u32 };
        for index in 0..spec.elements.len() {
            spec.add_element(index, child);
            if let Some(plan) = &spec.elements[index].plan {
                child.components += plan.components_below();
                child.entries += plan.entries_below();
            }
        }
        for index in 0..spec.elements.len() {
            spec.add_reactions(index);
        }
        Arc::new(spec)
    }
}

impl Spec {
    pub fn table(&self) -> PlanTable<'_> {
        PlanTable {
            start: ElementId(self.start),
            globals: self.globals,
            entries: self.entries.len() as u16,
            elements: &self.element_rows,
            supervisors: &self.supervisor_rows,
            reasons: &[STUCK],
            edges: &self.edges,
            sweeps: &self.sweeps,
        }
    }

    pub fn entry(&self, name: &str) -> u16 {
        let index = self.entries.iter().position(|entry| entry.name == name);
        index.unwrap_or_else(|| panic!("no entry {name}")) as u16
    }

    fn components(&self) -> u32 {
        let guards: usize = self.elements.iter().map(|element| element.guards.len()).sum();
        (self.elements.len() + usize::from(self.globals) + guards) as u32
    }

    fn components_below(&self) -> u32 {
        let plans = self.elements.iter().filter_map(|element| element.plan.as_ref());
        self.components() + plans.map(|plan| plan.components_below()).sum::<u32>()
    }

    fn entries_below(&self) -> u32 {
        let plans = self.elements.iter().filter_map(|element| element.plan.as_ref());
        self.entries.len() as u32 + plans.map(|plan| plan.entries_below()).sum::<u32>()
    }

    pub fn target(&self, name: &str) -> Target {
        match name {
            "terminate" => Target::Terminate,
            "fail" => Target::Fail(ReasonId(0)),
            "resume" => Target::Resume,
            "ignore" => Target::Ignore,
            "return" => Target::Return,
            name => match name.strip_prefix("suspend ") {
                Some(name) => Target::Suspend(self.element(name)),
                None => Target::Element(self.element(name)),
            },
        }
    }

    fn element(&self, name: &str) -> ElementId {
        let index = self.elements.iter().position(|element| element.name == name);
        ElementId(index.unwrap_or_else(|| panic!("no element {name}")) as u16)
    }

    /// Rows of the global supervisors whose events have other targets at an element.
    fn add_reactions(&mut self, index: usize) {
        let reactions = self.elements[index].reactions.clone();
        for row in self.element_rows[index].sweep.indices() {
            let guard = self.supervisors[usize::from(self.sweeps[row])].clone();
            let here: Vec<_> = reactions.iter().filter(|(of, ..)| *of == guard.name).collect();
            if here.is_empty() || self.sweeps[row] >= self.globals {
                continue;
            }
            let target = |(event, to): &(&'static str, &'static str)| {
                (*event, here.iter().find(|it| it.1 == *event).map_or(*to, |it| it.2))
            };
            let events: Vec<_> = guard.events.iter().map(target).collect();
            let events = self.add_edges(&events);
            let own = self.supervisor_rows[usize::from(self.sweeps[row])];
            self.sweeps[row] = self.supervisor_rows.len() as u16;
            self.supervisor_rows.push(SupervisorRow { events, ..own });
        }
    }

    fn optional(&self, name: Option<&str>) -> Option<Target> {
        name.map(|name| self.target(name))
    }

    fn add_edges(&mut self, outcomes: &[(&str, &str)]) -> Range {
        let first = self.edges.len() as u16;
        for (_, target) in outcomes {
            let target = self.target(target);
            self.edges.push(Some(target));
        }
        Range { first, len: outcomes.len() as u16 }
    }

    fn add_supervisor(&mut self, index: usize, slot: usize) {
        let guard = self.supervisors[index].clone();
        let events = self.add_edges(&guard.events);
        let connected = guard.events.iter().enumerate().filter(|(_, (_, to))| *to != "ignore");
        let wanted = connected.fold(0, |bits, (n, _)| bits | 1 << n);
        self.supervisor_rows.push(SupervisorRow {
            instance: SupervisorId(index as u16),
            timing: Timing {
                period: Duration::from_millis(guard.period),
                deadline: Duration::from_millis(guard.deadline),
                budget: Duration::from_millis(guard.budget),
            },
            slot: slot as u16,
            events,
            on_miss: self.optional(guard.on_miss),
            wanted: Events::from_bits(wanted),
            wanted_in_look: Events::from_bits(wanted),
        });
    }

    fn add_element(&mut self, index: usize, child: Child) {
        let element = self.elements[index].clone();
        let states = self.add_edges(&element.states);
        let first = self.supervisors.len();
        for (n, guard) in element.guards.iter().enumerate() {
            self.supervisors.push(guard.clone());
            self.add_supervisor(first + n, usize::from(self.globals) + n);
        }
        let own = first..self.supervisors.len();
        let mut sweep: Vec<usize> = (0..usize::from(self.globals)).chain(own.clone()).collect();
        sweep.sort_by_key(|&supervisor| self.supervisors[supervisor].deadline);
        let sweep_row = Range { first: self.sweeps.len() as u16, len: sweep.len() as u16 };
        self.sweeps.extend(sweep.into_iter().map(|supervisor| supervisor as u16));
        self.element_rows.push(ElementRow {
            kind: element.kind,
            period: Duration::from_millis(element.period),
            states,
            on_error: self.optional(element.on_error),
            resumes: self.computes(index, &mut Vec::new(), |to| {
                matches!(to, Target::Resume | Target::Suspend(_))
            }),
            returns: self.computes(index, &mut Vec::new(), |to| to == Target::Return),
            handler: self.is_handler(index),
            locals: Range { first: first as u16, len: own.len() as u16 },
            sweep: sweep_row,
            child,
        });
    }

    /// Position of the element that owns a local supervisor.
    pub fn owner(&self, supervisor: u16) -> Option<usize> {
        let holds = |row: &ElementRow| row.locals.indices().contains(&usize::from(supervisor));
        self.element_rows.iter().position(holds)
    }

    pub fn error_target(&self, element: usize) -> &'static str {
        self.elements[element].on_error.unwrap_or("")
    }

    pub fn miss_target(&self, supervisor: usize) -> &'static str {
        self.supervisors[supervisor].on_miss.unwrap_or("")
    }
}
