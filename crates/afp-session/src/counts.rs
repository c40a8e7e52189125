//! Counts how often a run used each part of its plan, and records how it ended.

use std::collections::BTreeMap;

use afp_core::trace::{
    self, Cause, ComponentId, ComponentKind, Ending, Names, Outcome, Record, declared,
};
use afp_core::{Duration, Failure, Fault, Instant};

use crate::observer::{NamedRecord, Observer};

/// Counts how often a run used each part of its plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Counts {
    /// The components, by id.
    pub components: Vec<Usage>,
    /// Interruptions of actors.
    pub interruptions: u64,
    /// The ending of the plan, if it has ended.
    pub ending: Option<Ending>,
    /// The active actor.
    pub actor: Option<ComponentId>,
    kinds: Vec<ComponentKind>,
    /// The element of each supervisor, and the sub-plan of each inner component.
    owners: Vec<Option<ComponentId>>,
    left: Option<ComponentId>,
    cause: Option<LeftFor>,
    failure: Option<Failure>,
}

/// The use of a component.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Usage {
    /// Its starts; for a computation, its runs.
    pub starts: u64,
    /// The count of each of its states or events, by position.
    pub outcomes: Vec<u64>,
    /// Deadlines of a supervisor that were missed and taken as an event.
    pub deadline_events: u64,
    /// Its faults.
    pub faults: u64,
    /// The count of each edge (`on`) of the element, for events and missed deadlines, in the order
    /// of [`Names::reaction`].
    pub reactions: Vec<Reaction>,
    /// Its interruptions.
    pub interruptions: u64,
    /// The polls of a supervisor, if polls without an event are reported.
    pub polls: u64,
    /// Deadlines missed because the poll began too late.
    pub late_releases: u64,
    /// Deadlines missed because the poll took too long.
    pub long_polls: u64,
    /// Deadlines missed because no poll began in the period.
    pub skipped: u64,
    /// The greatest lateness.
    pub worst_lateness: Duration,
    /// The total time that it was active.
    pub active: Duration,
    /// The start of the current activity.
    since: Option<Instant>,
}

/// An edge of an element that replaces an edge of a global supervisor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reaction {
    /// The supervisor.
    pub supervisor: ComponentId,
    /// The event.
    pub outcome: Outcome,
    /// The number of times that it was taken.
    pub count: u64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum LeftFor {
    /// A state or event.
    Outcome(ComponentId, Outcome),
    /// A fault of a component.
    Fault(ComponentId, Fault),
    Stop,
}

impl Usage {
    /// Events taken, missed deadlines included.
    pub fn events(&self) -> u64 {
        self.outcomes.iter().sum::<u64>() + self.deadline_events
    }
}

impl Counts {
    /// Counts of zero.
    pub fn new(names: &dyn Names) -> Self {
        let ids = || (0..names.components()).map(ComponentId);
        let reactions = |id| {
            let edges = (0..u16::MAX).map_while(move |n| names.reaction(id, n));
            let none = |edge: trace::Reaction<'_>| Reaction {
                supervisor: edge.supervisor,
                outcome: edge.outcome,
                count: 0,
            };
            edges.map(none).collect()
        };
        let usage = |id| Usage {
            outcomes: vec![0; declared(names, id).count()],
            reactions: reactions(id),
            ..Usage::default()
        };
        Counts {
            components: ids().map(usage).collect(),
            interruptions: 0,
            ending: None,
            actor: None,
            kinds: ids().map(|id| names.component(id).kind).collect(),
            owners: owners(names),
            left: None,
            cause: None,
            failure: None,
        }
    }

    /// Counts a record.
    pub fn record(&mut self, at: Instant, record: &Record<'_>) {
        match *record {
            Record::Started { component } => self.started(at, component),
            Record::Interrupted { element } => {
                self.with(element, |usage| usage.interruptions += 1);
                if self.kind(element) == Some(ComponentKind::Actor) {
                    self.interruptions += 1;
                }
                self.stopped(at, element);
                self.leave(element);
            }
            Record::Suspended { element, started: true, .. }
            | Record::Held { element, started: true } => self.suspended(at, element),
            Record::Returned { component, .. } => self.returned(at, component),
            Record::Abandoned { element, started: true } => {
                self.with(element, |usage| usage.interruptions += 1);
                if self.kind(element) == Some(ComponentKind::Actor) {
                    self.interruptions += 1;
                }
            }
            Record::Finished { element, state } => {
                // A computation has no record of its start.
                if self.kind(element) == Some(ComponentKind::Computation) {
                    self.with(element, |usage| usage.starts += 1);
                }
                self.reached(element, state);
                self.stopped(at, element);
                if self.leave(element) {
                    self.cause = Some(LeftFor::Outcome(element, state));
                }
            }
            Record::Faulted { component, fault, detail } => {
                self.failure = Some(Failure { component, fault, detail });
                self.with(component, |usage| usage.faults += 1);
                let active = self.actor;
                self.leave(component);
                let failed = if component == ComponentId(0) { active } else { Some(component) };
                self.cause = Some(LeftFor::Fault(failed.unwrap_or(component), fault));
            }
            Record::Event { supervisor, event, element } => {
                self.reached(supervisor, event);
                self.reacted(supervisor, event, element);
                self.cause = Some(LeftFor::Outcome(supervisor, event));
            }
            Record::Polled { supervisor, .. } => self.with(supervisor, |usage| usage.polls += 1),
            Record::Missed { supervisor, lateness, cause, skipped } => {
                self.with(supervisor, |usage| usage.missed(lateness, cause, skipped));
            }
            Record::StopRequested => self.cause = Some(LeftFor::Stop),
            Record::Ended { plan, ending } => {
                self.stopped(at, plan);
                if plan == ComponentId(0) {
                    self.ending = Some(ending);
                }
            }
            _ => {}
        }
    }

    /// Whether the component is a supervisor.
    pub fn is_supervisor(&self, id: ComponentId) -> bool {
        self.kind(id) == Some(ComponentKind::Supervisor)
    }

    /// Adds the counts of another run of the same plan.
    pub fn add(&mut self, other: &Counts) {
        for (mine, other) in self.components.iter_mut().zip(&other.components) {
            mine.starts += other.starts;
            mine.deadline_events += other.deadline_events;
            mine.faults += other.faults;
            mine.interruptions += other.interruptions;
            mine.polls += other.polls;
            mine.late_releases += other.late_releases;
            mine.long_polls += other.long_polls;
            mine.skipped += other.skipped;
            mine.worst_lateness = mine.worst_lateness.max(other.worst_lateness);
            mine.active += other.active;
            for (mine, other) in mine.outcomes.iter_mut().zip(&other.outcomes) {
                *mine += other;
            }
            for (mine, other) in mine.reactions.iter_mut().zip(&other.reactions) {
                mine.count += other.count;
            }
        }
        self.interruptions += other.interruptions;
    }

    /// Ends the active time of all components.
    pub fn finish(&mut self, end: Instant) {
        for id in 0..self.components.len() as u32 {
            self.stopped(end, ComponentId(id));
        }
    }

    /// The path of the actor, computation or supervisor that failed or ended last.
    pub fn last<'n>(&self, names: &'n dyn Names) -> &'n str {
        let failed = match self.cause {
            Some(LeftFor::Fault(id, _)) => Some(id),
            _ => None,
        };
        failed.or(self.left).map_or("", |id| names.component(id).path)
    }

    /// The fault that ended the plan, as text for people; `None` without one.
    pub fn why(&self, names: &dyn Names) -> Option<String> {
        let Some(Ending::Error(fault)) = self.ending else { return None };
        let detail = self.fatal().and_then(|failure| failure.detail);
        Some(fault.explained(detail, names).to_string())
    }

    /// The component and the fault that ended the plan; `None` without one, or if an edge to `fail`
    /// replaced it.
    pub fn fatal(&self) -> Option<Failure> {
        let Some(Ending::Error(fault)) = self.ending else { return None };
        self.failure.filter(|failure| failure.fault == fault)
    }

    /// The cause of the end: a state or event with its component, the code of a fault, or `stop`.
    pub fn cause(&self, names: &dyn Names) -> String {
        match self.cause {
            None => String::new(),
            Some(LeftFor::Outcome(id, outcome)) => {
                format!("{}.{}", names.component(id).path, names.outcome(id, outcome))
            }
            Some(LeftFor::Fault(_, fault)) => fault.code().to_owned(),
            Some(LeftFor::Stop) => "stop".to_owned(),
        }
    }

    fn kind(&self, id: ComponentId) -> Option<ComponentKind> {
        self.kinds.get(id.0 as usize).copied()
    }

    fn with(&mut self, id: ComponentId, count: impl FnOnce(&mut Usage)) {
        if let Some(usage) = self.components.get_mut(id.0 as usize) {
            count(usage);
        }
    }

    fn started(&mut self, at: Instant, id: ComponentId) {
        self.with(id, |usage| {
            usage.starts += 1;
            usage.since = Some(at);
        });
        if self.kind(id) == Some(ComponentKind::Actor) {
            self.actor = Some(id);
        }
    }

    /// Ends the active time of an element and of everything inside it.
    fn suspended(&mut self, at: Instant, element: ComponentId) {
        for id in (0..self.owners.len() as u32).map(ComponentId) {
            let owner = |id: &ComponentId| self.owners.get(id.0 as usize).copied().flatten();
            if std::iter::successors(Some(id), owner).any(|id| id == element) {
                self.stopped(at, id);
            }
        }
        self.actor = None;
    }

    fn returned(&mut self, at: Instant, id: ComponentId) {
        self.with(id, |usage| usage.since = Some(at));
        if self.kind(id) == Some(ComponentKind::Actor) {
            self.actor = Some(id);
        }
    }

    fn stopped(&mut self, at: Instant, id: ComponentId) {
        self.with(id, |usage| {
            if let Some(since) = usage.since.take() {
                usage.active += at.since(since);
            }
        });
    }

    /// Notes that an element ended; false for a plan or sub-plan.
    fn leave(&mut self, id: ComponentId) -> bool {
        if self.actor == Some(id) {
            self.actor = None;
        }
        let inner = !matches!(self.kind(id), Some(ComponentKind::Plan | ComponentKind::SubPlan));
        if inner {
            self.left = Some(id);
        }
        inner
    }

    fn reached(&mut self, id: ComponentId, outcome: Outcome) {
        self.with(id, |usage| match outcome {
            Outcome::DeadlineMissed => usage.deadline_events += 1,
            Outcome::Declared(position) => {
                if let Some(count) = usage.outcomes.get_mut(usize::from(position)) {
                    *count += 1;
                }
            }
            Outcome::Error => {}
        });
    }
}

impl Counts {
    /// The number of times that an event or missed deadline of a supervisor took the supervisor's
    /// own edge.
    pub fn by_own_edge(&self, supervisor: ComponentId, outcome: Outcome) -> u64 {
        let Some(usage) = self.components.get(supervisor.0 as usize) else { return 0 };
        let all = match outcome {
            Outcome::DeadlineMissed => usage.deadline_events,
            Outcome::Declared(position) => {
                usage.outcomes.get(usize::from(position)).copied().unwrap_or(0)
            }
            Outcome::Error => 0,
        };
        let edges = self.components.iter().flat_map(|usage| &usage.reactions);
        let replaced =
            edges.filter(|edge| (edge.supervisor, edge.outcome) == (supervisor, outcome));
        all - replaced.map(|edge| edge.count).sum::<u64>().min(all)
    }

    fn reacted(&mut self, supervisor: ComponentId, outcome: Outcome, element: ComponentId) {
        self.with(element, |usage| {
            let mut edges = usage.reactions.iter_mut();
            let edge = edges.find(|each| (each.supervisor, each.outcome) == (supervisor, outcome));
            if let Some(edge) = edge {
                edge.count += 1;
            }
        });
    }
}

/// The component whose path is that of each component without its last name.
fn owners(names: &(impl Names + ?Sized)) -> Vec<Option<ComponentId>> {
    let ids = || (0..names.components()).map(ComponentId);
    let paths: BTreeMap<_, _> = ids().map(|id| (names.component(id).path, id)).collect();
    let owner = |id| paths.get(names.component(id).path.rsplit_once('.')?.0).copied();
    ids().map(owner).collect()
}

impl Usage {
    /// The lateness is zero if only releases were skipped and the poll itself was in time.
    fn missed(&mut self, lateness: Duration, cause: Cause, skipped: u64) {
        let late = u64::from(lateness > Duration::ZERO);
        match cause {
            Cause::LateRelease => self.late_releases += late,
            Cause::LongPoll => self.long_polls += late,
        }
        self.skipped += skipped;
        self.worst_lateness = self.worst_lateness.max(lateness);
    }
}

impl Observer for Counts {
    fn on_record(&mut self, named: &NamedRecord<'_>) {
        self.record(named.at, named.record);
    }
}
