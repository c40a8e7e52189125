//! Callbacks for events of a plan, by name.

use std::fmt;

use afp_core::Instant;
use afp_core::ValueRef;
use afp_core::rt::NamedPlan;
use afp_core::trace::{
    ComponentId, ComponentKind, Names, Outcome, Record, Sink, TraceEntryId, declared,
};

/// A sink that calls functions when a component starts or reports a state or event, or when an
/// entry changes. Several functions for one event are called in the order of registration.
///
/// They run within a step, before its end, and must not block.
///
/// ```ignore
/// let mut calls = Callbacks::new(plan.plan())
///     .on("go.touch", "TouchSensorPressed", |at| println!("bumped at {at}"))?
///     .on_write("driven", |at, driven| println!("{driven} m after {at}"))?;
/// plan.run_until(&mut robot, &mut calls, until)?;
/// ```
pub struct Callbacks<'a, N> {
    names: N,
    calls: Vec<Call<'a>>,
}

enum Call<'a> {
    Start(ComponentId, Box<dyn FnMut(Instant) + 'a>),
    Outcome(ComponentId, Outcome, Box<dyn FnMut(Instant) + 'a>),
    Write(TraceEntryId, Box<dyn FnMut(Instant, ValueRef<'_>) + 'a>),
}

/// The plan has nothing with this name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownName {
    /// The plan or component.
    owner: String,
    /// The kind: a component, a state or event, an entry.
    what: &'static str,
    name: String,
    /// The existing names.
    known: Vec<String>,
}

impl<'a, N: Names> Callbacks<'a, N> {
    /// An empty set of callbacks for a plan.
    pub fn new(plan: &impl NamedPlan<Names = N>) -> Self {
        Callbacks { names: plan.names(), calls: Vec::new() }
    }

    /// Calls a function when a component reports a state or an event. Components are named by their
    /// path: `go` for an element, `go.touch` for its supervisor, `patrol.go` in a sub-plan. A
    /// sub-plan's states are `OK` and `Interrupted`. Every component also has `Error`, and a
    /// supervisor `DeadlineMissed`, even if unconnected.
    ///
    /// # Errors
    /// [`UnknownName`]; the component or its outcome.
    pub fn on(
        mut self,
        component: &str,
        outcome: &str,
        call: impl FnMut(Instant) + 'a,
    ) -> Result<Self, UnknownName> {
        let id = self.component(component)?;
        let known = self.outcomes(id);
        let number = known.iter().find(|(_, name)| *name == outcome).map(|(number, _)| *number);
        let number = number.ok_or_else(|| UnknownName {
            owner: format!("'{component}'"),
            what: "state or event",
            name: outcome.to_owned(),
            known: known.iter().map(|(_, name)| (*name).to_owned()).collect(),
        })?;
        self.calls.push(Call::Outcome(id, number, Box::new(call)));
        Ok(self)
    }

    /// Calls a function when an actor, a sub-plan or a supervisor starts.
    ///
    /// # Errors
    /// [`UnknownName`]; the component.
    pub fn on_start(
        mut self,
        component: &str,
        call: impl FnMut(Instant) + 'a,
    ) -> Result<Self, UnknownName> {
        let id = self.component(component)?;
        self.calls.push(Call::Start(id, Box::new(call)));
        Ok(self)
    }

    /// Calls a function with the new value when an entry is written; quantities are in SI units.
    ///
    /// # Errors
    /// [`UnknownName`]; the entry.
    pub fn on_write(
        mut self,
        entry: &str,
        call: impl FnMut(Instant, ValueRef<'_>) + 'a,
    ) -> Result<Self, UnknownName> {
        let ids = || (0..self.names.entries()).map(TraceEntryId);
        let found = ids().find(|id| self.names.entry(*id).path == entry);
        let id = found.ok_or_else(|| UnknownName {
            owner: "the plan".to_owned(),
            what: "entry",
            name: entry.to_owned(),
            known: ids().map(|id| self.names.entry(id).path.to_owned()).collect(),
        })?;
        self.calls.push(Call::Write(id, Box::new(call)));
        Ok(self)
    }

    /// Everything that a component can report.
    fn outcomes(&self, id: ComponentId) -> Vec<(Outcome, &str)> {
        let own = declared(&self.names, id);
        let is_supervisor = self.names.component(id).kind == ComponentKind::Supervisor;
        let missed = is_supervisor.then_some((Outcome::DeadlineMissed, "DeadlineMissed"));
        own.chain(missed).chain([(Outcome::Error, "Error")]).collect()
    }

    fn component(&self, path: &str) -> Result<ComponentId, UnknownName> {
        let ids = || (0..self.names.components()).map(ComponentId);
        let found = ids().find(|id| self.names.component(*id).path == path);
        found.ok_or_else(|| UnknownName {
            owner: "the plan".to_owned(),
            what: "component",
            name: path.to_owned(),
            known: ids().skip(1).map(|id| self.names.component(id).path.to_owned()).collect(),
        })
    }
}

impl<N> Sink for Callbacks<'_, N> {
    fn record(&mut self, at: Instant, record: &Record<'_>) {
        match *record {
            Record::Started { component } => self.each(|call| match call {
                Call::Start(id, call) if *id == component => call(at),
                _ => {}
            }),
            // Already reported by the record of the miss.
            Record::Event { event: Outcome::DeadlineMissed, .. } => {}
            Record::Event { supervisor: component, event: outcome, .. }
            | Record::Finished { element: component, state: outcome } => {
                self.outcome(at, component, outcome);
            }
            Record::Missed { supervisor, .. } => {
                self.outcome(at, supervisor, Outcome::DeadlineMissed);
            }
            Record::Faulted { component, .. } => self.outcome(at, component, Outcome::Error),
            Record::Committed { entry, new, .. } => self.each(|call| match call {
                Call::Write(id, call) if *id == entry => call(at, new),
                _ => {}
            }),
            _ => {}
        }
    }
}

impl<'a, N> Callbacks<'a, N> {
    fn outcome(&mut self, at: Instant, component: ComponentId, outcome: Outcome) {
        self.each(|call| match call {
            Call::Outcome(id, number, call) if (*id, *number) == (component, outcome) => call(at),
            _ => {}
        });
    }

    fn each(&mut self, call: impl FnMut(&mut Call<'a>)) {
        self.calls.iter_mut().for_each(call);
    }
}

impl<N> fmt::Debug for Callbacks<'_, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Callbacks({})", self.calls.len())
    }
}

impl fmt::Display for UnknownName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} has no {} '{}'", self.owner, self.what, self.name)?;
        match self.known.is_empty() {
            true => Ok(()),
            false => write!(f, "; there are: {}", self.known.join(", ")),
        }
    }
}

impl std::error::Error for UnknownName {}
