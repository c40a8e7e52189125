//! An instance of a graph: the interpreter's side of the scheduler's contract.

mod carry;
mod element;
mod entry;
mod loader;
mod testing;
mod watch;

use std::sync::Arc;

use afp_core::rt::{
    BadValue, Committer, Cx, ElementId, Events, Fired, Kept, NamedPlan, OnReturn, Plan, Polled,
    Run, SetAside, Slot, Started, SupervisorId, Tables, Unit, initial,
};
use afp_core::trace::{Outcome, Sink};
use afp_core::{Duration, Environment, Fault, PlanState, Value, ValueRef, WriteError};
use afp_dsl::graph::{EntryKind, Graph};
use afp_dsl::types::Type;

use super::config::{Config, ObjectCell};
use super::error::LoadError;
use super::formula::Formula;
use super::names::PlanNames;
use super::numbered;
use super::outputs::{Stage, limit};
use super::registry::Registry;
use super::tables::LoadedTables;
use carry::Carried;
use element::ElementSlot;
use entry::{EntryInfo, fit};
use loader::Loader;
use watch::WatchSlot;

/// A plan loaded at run time, for platform `E`.
pub struct LoadedPlan<E: ?Sized + 'static> {
    tables: LoadedTables,
    config: Config,
    entries: Arc<[EntryInfo]>,
    /// Entries with an initial value, in the order of initialisation.
    initial: Arc<[(u16, Formula)]>,
    /// Values taken over from a replaced plan, or from a moment of another run.
    carried: Vec<Carried>,
    /// The element at which the next start begins, if it is not the first.
    begins_at: Option<ElementId>,
    elements: Vec<ElementSlot<E>>,
    supervisors: Vec<WatchSlot<E>>,
    /// The names of the outermost plan.
    names: PlanNames,
}

impl<E: Environment + ?Sized + 'static> LoadedPlan<E> {
    /// Makes an instance of the graph's main plan and of all its sub-plans.
    ///
    /// # Errors
    /// The registry lacks a template or object type.
    pub fn new(graph: &Graph, registry: &Registry<E>) -> Result<Self, LoadError> {
        let names = PlanNames::new(graph);
        let mut plan = Loader { graph, registry, names }.plan(graph.main, graph.moment.as_ref())?;
        // Inputs must be set before the start.
        plan.put_carried(|kind| kind == EntryKind::In);
        Ok(plan)
    }

    /// The index of an entry.
    pub fn entry_number(&self, name: &str) -> Option<u16> {
        numbered(&*self.entries).find(|(_, entry)| entry.name == name).map(|(number, _)| number)
    }

    /// The names of the entries, in their order.
    pub fn entry_names(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().map(|entry| entry.name.as_str())
    }

    /// The value of an entry; `Unset` before the first write, `None` for an unknown entry.
    pub fn get(&self, name: &str) -> Option<ValueRef<'_>> {
        self.entry_number(name).map(|entry| self.config.values.show(entry))
    }

    /// Sets the `port`-th `in` entry for the next activation.
    ///
    /// # Errors
    /// [`Fault::RANGE`].
    pub(super) fn pass(
        &mut self,
        port: usize,
        value: Value,
        object: Option<&dyn ObjectCell>,
    ) -> Result<(), BadValue> {
        let mut inputs = numbered(&*self.entries).filter(|(_, entry)| entry.kind == EntryKind::In);
        if let Some((entry, info)) = inputs.nth(port) {
            self.config.values.set(entry, limit(info.range, value)?, object);
        }
        Ok(())
    }

    /// Stages the `port`-th `in` entry for the next step, if it is live and its value has changed;
    /// returns whether it has.
    ///
    /// # Errors
    /// [`Fault::RANGE`].
    pub(super) fn pass_live(
        &mut self,
        port: usize,
        value: impl FnOnce() -> Result<Value, BadValue>,
        object: Option<&dyn ObjectCell>,
    ) -> Result<bool, BadValue> {
        let mut inputs = numbered(&*self.entries).filter(|(_, entry)| entry.kind == EntryKind::In);
        let Some((entry, info)) = inputs.nth(port).filter(|(_, info)| info.live) else {
            return Ok(false);
        };
        let value = limit(info.range, value()?)?;
        if self.config.values.is_still(entry, &value) {
            return Ok(false);
        }
        match (value, object) {
            (Value::Object(commit), Some(from)) => {
                self.config.staged.put_known(entry, commit, |to| to.copy(from));
            }
            (value, _) => self.config.staged.put(entry, value),
        }
        Ok(true)
    }

    /// The set `out` entries with their positions.
    pub(super) fn results(&self) -> impl Iterator<Item = (u16, u16)> {
        let outs = numbered(&*self.entries).filter(|(_, entry)| entry.kind == EntryKind::Out);
        let outs = numbered(outs).map(|(port, (entry, _))| (port, entry));
        outs.filter(|(_, entry)| self.config.values.is_set(*entry))
    }

    /// Reports an injected outcome. Separate from the poll, which is the hot path.
    #[cold]
    #[inline(never)]
    fn report_injected<R: Run<Env = E>>(
        &mut self,
        supervisor: SupervisorId,
        cx: &mut Cx<'_, R>,
    ) -> Fired {
        let part = self.elements.len() as u32 + u32::from(supervisor.0);
        let watch = self.supervisors.get_mut(supervisor.index());
        let Some((watch, injected)) = watch.and_then(|watch| {
            let injected = watch.injected.take()?;
            Some((watch, injected))
        }) else {
            return Fired::NOTHING;
        };
        cx.show_injected(part, injected.outcome);
        let Outcome::Declared(event) = injected.outcome else { return Fired::missed() };
        let mut stage = Stage::new(&watch.outputs, &mut self.config.staged);
        injected.stage(&mut stage);
        Fired::event(event, cx.noted(stage.result()))
    }

    pub(super) fn cell(&self, entry: u16) -> Option<&dyn ObjectCell> {
        self.config.values.cell(entry)
    }
}

impl<E: ?Sized + 'static> PlanState for LoadedPlan<E> {
    type Tables = LoadedTables;
    type Slots = Box<[Slot]>;
    type Aside = Option<SetAside>;
    const HOLDS: bool = true;

    fn tables(&self) -> LoadedTables {
        self.tables.clone()
    }

    fn try_clone(&self) -> Option<Self> {
        Some(LoadedPlan {
            tables: self.tables.clone(),
            config: self.config.clone(),
            entries: self.entries.clone(),
            initial: self.initial.clone(),
            carried: self.carried.clone(),
            begins_at: self.begins_at,
            elements: self.elements.iter().map(ElementSlot::try_clone).collect::<Option<_>>()?,
            supervisors: self
                .supervisors
                .iter()
                .map(WatchSlot::try_clone)
                .collect::<Option<_>>()?,
            names: self.names.clone(),
        })
    }

    fn slots(&self) -> Box<[Slot]> {
        vec![Slot::default(); self.tables.table().slots()].into_boxed_slice()
    }

    fn missing_input(&self) -> Option<u16> {
        let missing = |(number, entry): &(u16, &EntryInfo)| {
            entry.kind == EntryKind::In
                && !self.config.values.is_set(*number)
                && !self.initial.iter().any(|(with, _)| with == number)
        };
        numbered(&*self.entries).find(missing).map(|(number, _)| number)
    }

    fn initialise(&mut self) -> Result<(), BadValue> {
        for (number, entry) in numbered(&*self.entries) {
            if entry.kind != EntryKind::In {
                self.config.values.clear(number);
            }
        }
        for (entry, formula) in &*self.initial {
            let info = &self.entries[usize::from(*entry)];
            let given = info.kind == EntryKind::In && self.config.values.is_set(*entry);
            if given {
                continue;
            }
            let value = formula.finite(&self.config.values);
            let value = value.and_then(|value| limit(info.range, value));
            let value = initial(*entry, || value)?;
            match (formula.entry(), value) {
                (Some(from), Value::Object(_)) => self.config.values.copy(from, *entry),
                (_, value) => self.config.values.set(*entry, value, None),
            }
        }
        self.put_carried(|_| true);
        Ok(())
    }

    fn begins_at(&mut self) -> Option<ElementId> {
        self.begins_at.take()
    }

    fn entry(&self, entry: u16) -> ValueRef<'_> {
        self.config.values.show(entry)
    }

    fn accepts(&self, entry: u16, value: &Value) -> Result<(), WriteError> {
        let info = self.entries.get(usize::from(entry)).ok_or(WriteError::Unknown)?;
        let ty = self.config.values.ty(entry).ok_or(WriteError::Unknown)?;
        if matches!(info.kind, EntryKind::Const | EntryKind::Out) {
            return Err(WriteError::ReadOnly);
        }
        match (ty, value) {
            (Type::Bool, Value::Bool(_)) | (Type::Text, Value::Text(_)) => Ok(()),
            (Type::Int | Type::Quantity(_), Value::Int(_)) => Ok(()),
            (Type::Quantity(_), Value::Float(number)) if number.is_finite() => Ok(()),
            (Type::Quantity(_), Value::Float(_)) => Err(WriteError::NotFinite),
            (Type::Enum(choices), Value::Choice(index))
                if usize::from(*index) < choices.variants.len() =>
            {
                Ok(())
            }
            _ => Err(WriteError::Type),
        }?;
        limit(info.range, fit(Some(ty), value)).map(|_| ()).map_err(|_| WriteError::Range)
    }

    fn set_input(&mut self, entry: u16, value: &Value) -> Result<(), WriteError> {
        self.accepts(entry, value)?;
        if self.entries.get(usize::from(entry)).is_some_and(|info| info.kind != EntryKind::In) {
            return Err(WriteError::NotStarted);
        }
        let value = fit(self.config.values.ty(entry), value);
        self.config.values.set(entry, value, None);
        Ok(())
    }

    fn stage(&mut self, entry: u16, value: &Value) {
        let value = fit(self.config.values.ty(entry), value);
        self.config.staged.put(entry, value);
    }

    #[inline]
    fn commit<S: Sink>(&mut self, to: &mut Committer<'_, S>) {
        self.config.commit(to);
    }

    #[inline]
    fn discard(&mut self) {
        self.config.staged.discard();
    }
}

impl<E: ?Sized + 'static> NamedPlan for LoadedPlan<E> {
    type Names = PlanNames;

    fn names(&self) -> PlanNames {
        self.names.clone()
    }

    fn units(&self, entry: u16) -> impl Iterator<Item = Unit<'_>> {
        let units = self.entries.get(usize::from(entry)).map_or(&[][..], |info| &info.units);
        units.iter().map(|(name, scale)| Unit { name, scale: *scale })
    }
}

impl<E: Environment + ?Sized + 'static> Plan<E> for LoadedPlan<E> {
    fn start_supervisor<R: Run<Env = E>>(
        &mut self,
        supervisor: SupervisorId,
        cx: &mut Cx<'_, R>,
    ) -> Result<(), Fault> {
        let watch = self.supervisors.get_mut(supervisor.index()).ok_or(Fault::INTERNAL)?;
        let args = watch.inputs.pull(&self.config.values);
        let started = cx.show_inputs(|see, env, now| watch.slot.start(&args, see, env, now));
        cx.noted(started)
    }

    // Every step calls it for every supervisor that is due.
    #[inline(always)]
    fn poll_supervisor<R: Run<Env = E>>(
        &mut self,
        supervisor: SupervisorId,
        wanted: Events,
        cx: &mut Cx<'_, R>,
    ) -> Fired {
        let Some(watch) = self.supervisors.get_mut(supervisor.index()) else {
            return Fired::fault(Fault::INTERNAL);
        };
        if watch.injected.is_some() {
            return self.report_injected(supervisor, cx);
        }
        let mut stage = Stage::new(&watch.outputs, &mut self.config.staged);
        let args = watch.inputs.pull(&self.config.values);
        match watch.slot.poll(&args, wanted, &mut stage, cx.env, cx.now) {
            Ok(None) => Fired::NOTHING,
            Ok(Some(event)) => Fired::event(event, cx.noted(stage.result())),
            Err(why) => Fired::fault(cx.note(why)),
        }
    }

    fn start_element<R: Run<Env = E>>(
        &mut self,
        element: ElementId,
        cx: &mut Cx<'_, R>,
    ) -> Started {
        let Some(slot) = self.elements.get_mut(element.index()) else {
            return Started::Failed(Fault::INTERNAL);
        };
        slot.start(&mut self.config, cx)
    }

    #[inline]
    fn poll_element<R: Run<Env = E>>(&mut self, element: ElementId, cx: &mut Cx<'_, R>) -> Polled {
        let Some(slot) = self.elements.get_mut(element.index()) else {
            return Polled::Failed(Fault::INTERNAL);
        };
        match slot.injected {
            None => slot.poll(&mut self.config, cx),
            Some(_) => slot.finish(element, &mut self.config, cx),
        }
    }

    fn interrupt_element<R: Run<Env = E>>(
        &mut self,
        element: ElementId,
        cx: &mut Cx<'_, R>,
    ) -> Result<(), Fault> {
        let slot = self.elements.get_mut(element.index()).ok_or(Fault::INTERNAL)?;
        slot.interrupt(cx)
    }

    fn suspend_element<R: Run<Env = E>>(
        &mut self,
        element: ElementId,
        cx: &mut Cx<'_, R>,
    ) -> Result<Kept, Fault> {
        self.elements.get_mut(element.index()).ok_or(Fault::INTERNAL)?.suspend(cx)
    }

    fn refresh_element<R: Run<Env = E>>(
        &mut self,
        element: ElementId,
        cx: &mut Cx<'_, R>,
    ) -> Result<(), Fault> {
        let slot = self.elements.get_mut(element.index()).ok_or(Fault::INTERNAL)?;
        slot.refresh(&mut self.config, cx)
    }

    fn resume_element<R: Run<Env = E>>(
        &mut self,
        element: ElementId,
        away: Duration,
        cx: &mut Cx<'_, R>,
    ) -> Started {
        let Some(slot) = self.elements.get_mut(element.index()) else {
            return Started::Failed(Fault::INTERNAL);
        };
        slot.resume(away, &mut self.config, cx)
    }

    fn resume_supervisor<R: Run<Env = E>>(
        &mut self,
        supervisor: SupervisorId,
        away: Duration,
        cx: &mut Cx<'_, R>,
    ) -> Result<OnReturn, Fault> {
        let watch = self.supervisors.get_mut(supervisor.index()).ok_or(Fault::INTERNAL)?;
        match watch.resumable {
            true => watch.slot.resume(cx.env, cx.now, away),
            false => Ok(OnReturn::Restarts),
        }
    }

    fn leave(&mut self, element: ElementId) {
        if let Some(slot) = self.elements.get_mut(element.index()) {
            slot.clear();
        }
        let locals = self.tables.table().element(element).map(|row| row.locals);
        for local in locals.unwrap_or_default().supervisors() {
            if let Some(watch) = self.supervisors.get_mut(local.index()) {
                watch.clear();
            }
        }
    }

    fn end(&mut self) {
        self.elements.iter_mut().for_each(ElementSlot::clear);
        self.supervisors.iter_mut().for_each(WatchSlot::clear);
    }
}

#[cfg(test)]
mod tests {
    use afp_core::Scheduler;

    use super::LoadedPlan;

    #[test]
    fn a_running_plan_can_be_sent_to_another_thread() {
        fn sent<T: Send>() {}
        sent::<LoadedPlan<std::rc::Rc<()>>>();
        sent::<Scheduler<LoadedPlan<()>>>();
    }
}
