//! A plan with rows made at run time; the [`World`] answers for its components.

use std::sync::Arc;

use afp_core::rt::{
    BadValue, Committer, Cx, ElementId, ElementKind, Events, Fired, Kept, Machine, OnReturn, Plan,
    PlanState, PlanTable, Polled, Run, SetAside, Slot, Started, SupervisorId, Tables,
};
use afp_core::trace::{EntryKind, Sink};
use afp_core::{Duration, Fault, Instant, Value, ValueRef, WriteError};

use super::build::{ElementSpec, Spec};
use super::world::{Phase, World};

#[derive(Clone)]
pub struct SharedTables(Arc<Spec>);

impl Tables for SharedTables {
    fn table(&self) -> PlanTable<'_> {
        self.0.table()
    }
}

pub struct Scripted {
    spec: Arc<Spec>,
    entries: Vec<Value>,
    staged: Vec<Option<Value>>,
    children: Vec<Option<Machine<Scripted>>>,
    /// The elements that were started and not left: a handler or not.
    running: [Option<ElementId>; 2],
    suspended: Vec<bool>,
    watching: Vec<bool>,
    /// The last poll of each supervisor since it started or continued; [`SILENT`] if its element is
    /// suspended.
    asked: Vec<Option<Instant>>,
}

const SILENT: Option<Instant> = Some(Instant::MAX);

impl Scripted {
    pub fn new(spec: Arc<Spec>) -> Self {
        let child = |element: &ElementSpec| {
            element.plan.as_ref().map(|plan| Machine::new(Scripted::new(plan.clone())))
        };
        Scripted {
            entries: spec.entries.iter().map(|_| Value::Unset).collect(),
            staged: spec.entries.iter().map(|_| None).collect(),
            children: spec.elements.iter().map(child).collect(),
            running: [None; 2],
            suspended: vec![false; spec.elements.len()],
            watching: vec![false; spec.supervisors.len()],
            asked: vec![None; spec.supervisors.len()],
            spec,
        }
    }

    pub fn set(&mut self, entry: &str, value: Value) {
        let index = self.spec.entry(entry);
        self.entries[usize::from(index)] = value;
    }

    pub fn get(&self, entry: &str) -> Value {
        self.entries[usize::from(self.spec.entry(entry))].clone()
    }

    /// Checks that all supervisors of an element were polled in the look before it starts or
    /// continues.
    fn looked(&self, element: ElementId, now: Instant) {
        let locals = self.spec.element_rows[element.index()].locals.indices();
        let all = self.asked[locals].iter().all(|asked| *asked == Some(now));
        assert!(all, "{} moves without a look", self.spec.elements[element.index()].name);
    }

    /// Whether no component is left.
    pub fn is_empty(&self) -> bool {
        self.running == [None; 2] && !self.suspended.contains(&true)
    }

    pub fn spec(&self) -> &Arc<Spec> {
        &self.spec
    }

    fn place(&mut self, element: ElementId) -> &mut Option<ElementId> {
        &mut self.running[usize::from(self.spec.element_rows[element.index()].handler)]
    }

    fn stage_writes(&mut self, writes: &[(&str, &str, Value)], outcome: &str) {
        for (_, entry, value) in writes.iter().filter(|(on, ..)| *on == outcome) {
            self.staged[usize::from(self.spec.entry(entry))] = Some(value.clone());
        }
    }

    fn see<R: Run<Env = World>>(&self, live: Option<&'static str>, who: &str, cx: &mut Cx<'_, R>) {
        if let Some(entry) = live {
            let value = format!("{}", self.entries[usize::from(self.spec.entry(entry))].as_deref());
            cx.env.saw(cx.now, who, &value);
        }
    }

    /// Runs a sub-plan's machine, then passes its set `out` entries to `take`.
    fn with_child<R>(
        &mut self,
        element: ElementId,
        run: impl FnOnce(&mut Self, &mut Machine<Self>) -> R,
    ) -> R {
        let index = element.index();
        let mut machine = self.children[index].take().expect("a sub-plan");
        let result = run(self, &mut machine);
        self.children[index] = Some(machine);
        result
    }

    fn stage_results(&mut self, element: &ElementSpec, inner: &Scripted) -> Result<(), Fault> {
        for (from, to) in &element.outs {
            match inner.get(from) {
                Value::Unset => {}
                // A value that tests use as one that does not convert.
                Value::Int(666) => return Err(Fault::CONVERSION),
                value => self.staged[usize::from(self.spec.entry(to))] = Some(value),
            }
        }
        Ok(())
    }
}

impl PlanState for Scripted {
    type Tables = SharedTables;
    type Slots = Vec<Slot>;
    type Aside = Option<SetAside>;

    fn tables(&self) -> SharedTables {
        SharedTables(self.spec.clone())
    }

    fn try_clone(&self) -> Option<Self> {
        let copy = |child: &Option<Machine<Scripted>>| match child {
            Some(machine) => machine.try_clone().map(Some),
            None => Some(None),
        };
        Some(Scripted {
            spec: self.spec.clone(),
            entries: self.entries.clone(),
            staged: self.staged.clone(),
            children: self.children.iter().map(copy).collect::<Option<_>>()?,
            running: self.running,
            suspended: self.suspended.clone(),
            watching: self.watching.clone(),
            asked: self.asked.clone(),
        })
    }

    fn slots(&self) -> Vec<Slot> {
        vec![Slot::default(); self.spec.table().slots()]
    }

    fn missing_input(&self) -> Option<u16> {
        let mut entries = self.spec.entries.iter().zip(&self.entries);
        let missing = entries.position(|(spec, value)| {
            spec.kind == EntryKind::In && *value == Value::Unset && spec.init == Value::Unset
        });
        missing.map(|index| index as u16)
    }

    fn initialise(&mut self) -> Result<(), BadValue> {
        for (spec, value) in self.spec.entries.iter().zip(&mut self.entries) {
            if spec.broken {
                return Err(Fault::ARITHMETIC.into());
            }
            if spec.kind != EntryKind::In || *value == Value::Unset {
                *value = spec.init.clone();
            }
        }
        Ok(())
    }

    fn entry(&self, entry: u16) -> ValueRef<'_> {
        self.entries[usize::from(entry)].as_deref()
    }

    fn accepts(&self, entry: u16, value: &Value) -> Result<(), WriteError> {
        let spec = self.spec.entries.get(usize::from(entry)).ok_or(WriteError::Unknown)?;
        match (spec.kind, value) {
            (EntryKind::Const | EntryKind::Out, _) => Err(WriteError::ReadOnly),
            (_, Value::Int(_)) => Ok(()),
            _ => Err(WriteError::Type),
        }
    }

    fn set_input(&mut self, entry: u16, value: &Value) -> Result<(), WriteError> {
        self.accepts(entry, value)?;
        if self.spec.entries[usize::from(entry)].kind != EntryKind::In {
            return Err(WriteError::NotStarted);
        }
        self.entries[usize::from(entry)] = value.clone();
        Ok(())
    }

    fn stage(&mut self, entry: u16, value: &Value) {
        self.staged[usize::from(entry)] = Some(value.clone());
    }

    fn commit<S: Sink>(&mut self, to: &mut Committer<'_, S>) {
        for (index, staged) in self.staged.iter_mut().enumerate() {
            if let Some(new) = staged.take() {
                to.wrote(index as u16, self.entries[index].as_deref(), new.as_deref());
                self.entries[index] = new;
            }
        }
    }

    fn discard(&mut self) {
        self.staged.fill(None);
    }
}

impl Plan<World> for Scripted {
    fn start_supervisor<R: Run<Env = World>>(
        &mut self,
        supervisor: SupervisorId,
        cx: &mut Cx<'_, R>,
    ) -> Result<(), Fault> {
        let name = self.spec.supervisors[supervisor.index()].name;
        cx.env.call(name, Phase::Start, cx.now)?;
        self.watching[supervisor.index()] = true;
        self.asked[supervisor.index()] = None;
        Ok(())
    }

    fn resume_supervisor<R: Run<Env = World>>(
        &mut self,
        supervisor: SupervisorId,
        away: Duration,
        cx: &mut Cx<'_, R>,
    ) -> Result<OnReturn, Fault> {
        let guard = &self.spec.supervisors[supervisor.index()];
        assert!(self.watching[supervisor.index()], "{} resumes but does not watch", guard.name);
        if !guard.continues {
            return Ok(OnReturn::Restarts);
        }
        cx.env.resumes(guard.name, away, cx.now)?;
        self.asked[supervisor.index()] = None;
        Ok(OnReturn::Continues)
    }

    fn suspend_element<R: Run<Env = World>>(
        &mut self,
        element: ElementId,
        cx: &mut Cx<'_, R>,
    ) -> Result<Kept, Fault> {
        let spec = self.spec.clone();
        let row = &spec.elements[element.index()];
        assert_eq!(*self.place(element), Some(element), "{} is suspended, not running", row.name);
        let suspended = std::mem::replace(&mut self.suspended[element.index()], true);
        assert!(!suspended, "{} is suspended twice", row.name);
        self.asked[spec.element_rows[element.index()].locals.indices()].fill(SILENT);
        if row.kind == ElementKind::SubPlan {
            let child = spec.element_rows[element.index()].child;
            return self.with_child(element, |_, machine| {
                machine.plan_mut().asked.fill(SILENT);
                cx.inside(child, |cx| machine.suspend(cx))
            });
        }
        cx.env.call(row.name, Phase::Suspend, cx.now)?;
        cx.env.rests();
        Ok(Kept::Yes)
    }

    fn refresh_element<R: Run<Env = World>>(
        &mut self,
        element: ElementId,
        cx: &mut Cx<'_, R>,
    ) -> Result<(), Fault> {
        cx.env.call(self.spec.elements[element.index()].name, Phase::Refresh, cx.now)
    }

    fn resume_element<R: Run<Env = World>>(
        &mut self,
        element: ElementId,
        away: Duration,
        cx: &mut Cx<'_, R>,
    ) -> Started {
        let spec = self.spec.clone();
        let row = &spec.elements[element.index()];
        let suspended = std::mem::replace(&mut self.suspended[element.index()], false);
        assert!(suspended, "{} resumes but is not suspended", row.name);
        self.looked(element, cx.now);
        if row.kind == ElementKind::SubPlan {
            let child = spec.element_rows[element.index()].child;
            return self.with_child(element, |plan, machine| {
                let flow = cx.resume_sub_plan(child, machine, away);
                Started::sub_plan(
                    flow,
                    || plan.stage_results(row, machine.plan()).map_err(BadValue::from),
                    cx,
                )
            });
        }
        match cx.env.resumes(row.name, away, cx.now) {
            Ok(()) => {
                cx.env.moves(row.name);
                Started::Running
            }
            Err(fault) => {
                self.suspended[element.index()] = true;
                Started::Failed(fault)
            }
        }
    }

    fn poll_supervisor<R: Run<Env = World>>(
        &mut self,
        supervisor: SupervisorId,
        wanted: Events,
        cx: &mut Cx<'_, R>,
    ) -> Fired {
        let spec = self.spec.clone();
        let index = supervisor.index();
        let guard = &spec.supervisors[index];
        assert!(self.watching[index], "{} is polled but does not watch", guard.name);
        assert_ne!(self.asked[index], SILENT, "{} is polled while suspended", guard.name);
        self.asked[index] = Some(cx.now);
        if let Err(fault) = cx.env.call(guard.name, Phase::Poll, cx.now) {
            return Fired::fault(fault);
        }
        self.see(guard.live, guard.name, cx);
        let Some(event) = cx.env.outcome(guard.name, wanted, cx.now) else {
            return Fired::NOTHING;
        };
        self.stage_writes(&guard.writes, guard.events[usize::from(event)].0);
        Fired::event(event, cx.env.output(guard.name, cx.now))
    }

    fn start_element<R: Run<Env = World>>(
        &mut self,
        element: ElementId,
        cx: &mut Cx<'_, R>,
    ) -> Started {
        let spec = self.spec.clone();
        let row = &spec.elements[element.index()];
        let computes = row.kind == ElementKind::Computation;
        let runs = |at: Option<ElementId>| at.is_some_and(|at| !self.suspended[at.index()]);
        assert!(computes || !self.running.into_iter().any(runs), "two elements run at once");
        for entry in &row.reads {
            let value = format!("{}", self.entries[usize::from(self.spec.entry(entry))].as_deref());
            cx.env.saw(cx.now, row.name, &value);
        }
        if !computes {
            self.looked(element, cx.now);
        }
        if row.kind == ElementKind::SubPlan {
            let child = spec.element_rows[element.index()].child;
            *self.place(element) = Some(element);
            return self.with_child(element, |plan, machine| {
                for (inner, outer) in &row.ins {
                    machine.plan_mut().set(inner, plan.get(outer));
                }
                let flow = cx.start_sub_plan(child, machine);
                Started::sub_plan(
                    flow,
                    || plan.stage_results(row, machine.plan()).map_err(BadValue::from),
                    cx,
                )
            });
        }
        if let Err(fault) = cx.env.call(row.name, Phase::Start, cx.now) {
            return Started::Failed(fault);
        }
        if row.kind == ElementKind::Actor {
            cx.env.moves(row.name);
            *self.place(element) = Some(element);
            return Started::Running;
        }
        let state = cx.env.outcome(row.name, row.all(), cx.now).unwrap_or(0);
        self.stage_writes(&row.writes, row.states[usize::from(state)].0);
        match cx.env.output(row.name, cx.now) {
            Ok(()) => Started::Done(state),
            Err(fault) => Started::Failed(fault),
        }
    }

    fn poll_element<R: Run<Env = World>>(
        &mut self,
        element: ElementId,
        cx: &mut Cx<'_, R>,
    ) -> Polled {
        let spec = self.spec.clone();
        let row = &spec.elements[element.index()];
        assert_eq!(*self.place(element), Some(element), "{} is polled, not running", row.name);
        assert!(!self.suspended[element.index()], "{} is polled while suspended", row.name);
        if row.kind == ElementKind::SubPlan {
            let child = spec.element_rows[element.index()].child;
            return self.with_child(element, |plan, machine| {
                let flow = cx.inside(child, |cx| machine.step(cx));
                Polled::sub_plan(
                    flow,
                    || plan.stage_results(row, machine.plan()).map_err(BadValue::from),
                    cx,
                )
            });
        }
        if let Err(fault) = cx.env.call(row.name, Phase::Poll, cx.now) {
            return Polled::Failed(fault);
        }
        self.see(row.live, row.name, cx);
        let Some(state) = cx.env.outcome(row.name, row.all(), cx.now) else {
            return Polled::Pending;
        };
        self.stage_writes(&row.writes, row.states[usize::from(state)].0);
        match cx.env.output(row.name, cx.now) {
            Ok(()) => {
                cx.env.rests();
                Polled::Done(state)
            }
            Err(fault) => Polled::Failed(fault),
        }
    }

    fn interrupt_element<R: Run<Env = World>>(
        &mut self,
        element: ElementId,
        cx: &mut Cx<'_, R>,
    ) -> Result<(), Fault> {
        let spec = self.spec.clone();
        let row = &spec.elements[element.index()];
        assert_eq!(*self.place(element), Some(element), "{} is interrupted, not running", row.name);
        if row.kind == ElementKind::SubPlan {
            let child = spec.element_rows[element.index()].child;
            return self
                .with_child(element, |_, machine| cx.inside(child, |cx| machine.interrupt(cx)));
        }
        cx.env.call(row.name, Phase::Interrupt, cx.now)?;
        cx.env.rests();
        Ok(())
    }

    fn leave(&mut self, element: ElementId) {
        if *self.place(element) == Some(element) {
            *self.place(element) = None;
        }
        self.suspended[element.index()] = false;
        let locals = self.spec.element_rows[element.index()].locals;
        self.watching[locals.indices()].fill(false);
    }

    fn end(&mut self) {
        self.running = [None; 2];
        self.suspended.fill(false);
        self.watching.fill(false);
    }
}
