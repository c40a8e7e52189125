//! An instance of a graph: the interpreter's side of the contract with the scheduler.

mod loader;

use std::sync::Arc;

use afp_core::rt::{
    Committer, Cx, Events, Fired, NamedPlan, Plan, Polled, Scale, Slot, Started, Tables, Unit,
    int_to_float,
};
use afp_core::trace::{ComponentId, Sink};
use afp_core::{Clock, Environment, Fault, PlanState, Value, ValueRef, WriteError};
use afp_dsl::graph::{self, EntryKind, Graph};
use afp_dsl::types::Type;

use super::config::{Config, ObjectCell};
use super::element::ElementSlot;
use super::error::{InputError, LoadError};
use super::formula::{Formula, spellings};
use super::inject::{Injected, Injection, NotActive};
use super::names::PlanNames;
use super::outputs::{Binding, Inputs, Stage};
use super::registry::Registry;
use super::slots::SupervisorSlot;
use super::tables::LoadedTables;
use loader::Loader;

/// A plan loaded at run time, for platform `E`.
pub struct LoadedPlan<E: ?Sized + 'static> {
    tables: LoadedTables,
    config: Config,
    entries: Arc<[EntryInfo]>,
    /// Entries with an initial value, in the order in which they get it.
    initial: Arc<[(u16, Formula)]>,
    elements: Vec<ElementSlot<E>>,
    supervisors: Vec<WatchSlot<E>>,
    /// The names of the outermost plan.
    names: PlanNames,
}

struct EntryInfo {
    name: String,
    kind: EntryKind,
    /// The units that a value from outside may carry.
    units: Vec<(String, Scale)>,
}

impl EntryInfo {
    fn new(entry: &graph::Entry) -> Self {
        let units = match (&entry.ty, entry.kind) {
            (Type::Quantity(dimension), EntryKind::In) => spellings(*dimension),
            _ => Vec::new(),
        };
        EntryInfo { name: entry.name.clone(), kind: entry.kind, units }
    }
}

struct WatchSlot<E: ?Sized + 'static> {
    inputs: Inputs,
    outputs: Arc<[Binding]>,
    wanted: Events,
    slot: Box<dyn SupervisorSlot<E>>,
    injected: Injected,
}

impl<E: ?Sized + 'static> WatchSlot<E> {
    fn clear(&mut self) {
        self.slot.clear();
        self.injected = None;
    }

    fn try_clone(&self) -> Option<Self> {
        Some(WatchSlot {
            inputs: self.inputs.clone(),
            outputs: self.outputs.clone(),
            wanted: self.wanted,
            slot: self.slot.try_clone()?,
            injected: self.injected.clone(),
        })
    }
}

impl<E: Environment + ?Sized + 'static> LoadedPlan<E> {
    /// Makes an instance of the graph's main plan and of all its sub-plans.
    ///
    /// # Errors
    /// A template or object type that the registry does not know.
    pub fn new(graph: &Graph, registry: &Registry<E>) -> Result<Self, LoadError> {
        let names = PlanNames::new(graph);
        Loader { graph, registry, names }.plan(graph.main)
    }

    /// The number of an entry.
    pub fn entry_number(&self, name: &str) -> Option<u16> {
        numbered(&*self.entries).find(|(_, entry)| entry.name == name).map(|(number, _)| number)
    }

    /// The names of the entries, in their order.
    pub fn entry_names(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().map(|entry| entry.name.as_str())
    }

    /// The value of an entry; `Unset` while nobody has written it, `None` where there is none.
    pub fn get(&self, name: &str) -> Option<ValueRef<'_>> {
        self.entry_number(name).map(|entry| self.config.values.show(entry))
    }

    /// Sets an `in` entry before the start.
    ///
    /// # Errors
    /// No such entry, or not such a value.
    pub fn set_input(&mut self, name: &str, value: &Value) -> Result<(), InputError> {
        let entry = self.entry_number(name).ok_or_else(|| InputError::Unknown(name.to_owned()))?;
        let refused = |why| InputError::Refused(name.to_owned(), why);
        NamedPlan::set_input(self, entry, value).map_err(refused)
    }

    /// Makes a component of the running plan report an outcome at its next poll, whatever it sees: for
    /// tests. An actor is interrupted once the outputs are staged, so that it leaves the robot at rest.
    ///
    /// `active` is the active element of the plan, as its scheduler has it.
    ///
    /// # Errors
    /// [`NotActive`] when the component is not being polled; nothing changes then.
    pub fn inject(&mut self, active: Option<u16>, injection: &Injection) -> Result<(), NotActive> {
        let part = injection.component.0.checked_sub(1).ok_or(NotActive)?;
        self.inject_at(active, part, injection)
    }

    /// As [`LoadedPlan::inject`]; `part` counts from this plan's first element.
    pub(super) fn inject_at(
        &mut self,
        active: Option<u16>,
        part: u32,
        injection: &Injection,
    ) -> Result<(), NotActive> {
        let active = active.ok_or(NotActive)?;
        let (elements, supervisors) = (self.elements.len() as u32, self.supervisors.len() as u32);
        if part < elements {
            let slot = self.elements.get_mut(part as usize).ok_or(NotActive)?;
            return match u32::from(active) == part {
                true => slot.inject(injection),
                false => Err(NotActive),
            };
        }
        if let Some(number) = part.checked_sub(elements).filter(|number| *number < supervisors) {
            let table = self.tables.table();
            let locals = table.element(active).map(|row| row.locals).ok_or(NotActive)?;
            let local = u32::from(locals.first)..u32::from(locals.first) + u32::from(locals.len);
            if number >= u32::from(table.globals) && !local.contains(&number) {
                return Err(NotActive);
            }
            let watch = self.supervisors.get_mut(number as usize).ok_or(NotActive)?;
            watch.injected = injection.boxed();
            return Ok(());
        }
        self.elements.get_mut(usize::from(active)).ok_or(NotActive)?.inject_inside(part, injection)
    }

    /// Makes an actor, or all actors of a sub-plan, do nothing from their next start on: for tests. They
    /// are active all the same, until they are interrupted or made to report a state. Without an
    /// element it is about all actors.
    ///
    /// Gives whether there is such an element.
    pub fn idle(&mut self, element: Option<ComponentId>) -> bool {
        let Some(element) = element else {
            self.idle_all();
            return true;
        };
        element.0.checked_sub(1).is_some_and(|part| self.idle_at(part))
    }

    pub(super) fn idle_all(&mut self) {
        self.elements.iter_mut().for_each(ElementSlot::idle);
    }

    /// As [`LoadedPlan::idle`]; `part` counts from this plan's first element.
    pub(super) fn idle_at(&mut self, part: u32) -> bool {
        match self.elements.get_mut(part as usize) {
            Some(element) => {
                element.idle();
                true
            }
            // The parts of a sub-plan follow one another, so that one sub-plan at most has it.
            None => self.elements.iter_mut().any(|element| element.idle_inside(part)),
        }
    }

    /// Gives the `port`-th `in` entry its value for the next activation.
    pub(super) fn pass(&mut self, port: usize, value: Value, object: Option<&dyn ObjectCell>) {
        let mut inputs = numbered(&*self.entries).filter(|(_, entry)| entry.kind == EntryKind::In);
        if let Some((entry, _)) = inputs.nth(port) {
            self.config.values.set(entry, value, object);
        }
    }

    /// The `out` entries that are set, each with its position among the `out` entries.
    pub(super) fn results(&self) -> impl Iterator<Item = (u16, u16)> {
        let outs = numbered(&*self.entries).filter(|(_, entry)| entry.kind == EntryKind::Out);
        let outs = numbered(outs).map(|(port, (entry, _))| (port, entry));
        outs.filter(|(_, entry)| self.config.values.is_set(*entry))
    }

    /// A supervisor reports what was put there. Apart from the poll, which is done in every step.
    #[cold]
    #[inline(never)]
    fn report_injected<S: Sink, C: Clock>(
        &mut self,
        supervisor: u16,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Fired {
        let part = self.elements.len() as u32 + u32::from(supervisor);
        let watch = self.supervisors.get_mut(usize::from(supervisor));
        let Some((watch, injected)) = watch.and_then(|watch| {
            let injected = watch.injected.take()?;
            Some((watch, injected))
        }) else {
            return Fired::NOTHING;
        };
        let mut stage = Stage::new(&watch.outputs, &mut self.config.staged);
        injected.stage(&mut stage);
        cx.show_injected(part, injected.outcome);
        Fired::event(injected.outcome, stage.result())
    }

    /// The cell of an object entry.
    pub(super) fn cell(&self, entry: u16) -> Option<&dyn ObjectCell> {
        self.config.values.cell(entry)
    }
}

/// Items with their 16-bit numbers, of which the tables of a plan have no more.
pub(super) fn numbered<T>(items: impl IntoIterator<Item = T>) -> impl Iterator<Item = (u16, T)> {
    (0..=u16::MAX).zip(items)
}

/// A value of the entry's own type: an `int` given to a `float` becomes one.
fn fit(ty: Option<&Type>, value: &Value) -> Value {
    match (ty, value) {
        (Some(Type::Quantity(_)), Value::Int(int)) => Value::Float(int_to_float(*int)),
        _ => value.clone(),
    }
}

impl<E: ?Sized + 'static> PlanState for LoadedPlan<E> {
    type Tables = LoadedTables;
    type Slots = Box<[Slot]>;

    fn tables(&self) -> LoadedTables {
        self.tables.clone()
    }

    fn try_clone(&self) -> Option<Self> {
        Some(LoadedPlan {
            tables: self.tables.clone(),
            config: self.config.clone(),
            entries: self.entries.clone(),
            initial: self.initial.clone(),
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

    fn initialise(&mut self) -> Result<(), Fault> {
        for (number, entry) in numbered(&*self.entries) {
            if entry.kind != EntryKind::In {
                self.config.values.clear(number);
            }
        }
        for (entry, formula) in &*self.initial {
            let given = self.entries[usize::from(*entry)].kind == EntryKind::In
                && self.config.values.is_set(*entry);
            if !given {
                let value = formula.finite(&self.config.values)?;
                self.config.values.set(*entry, value, None);
            }
        }
        Ok(())
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
        }
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

    fn set_input(&mut self, entry: u16, value: &Value) -> Result<(), WriteError> {
        let info = self.entries.get(usize::from(entry)).ok_or(WriteError::Unknown)?;
        if info.kind != EntryKind::In {
            return Err(WriteError::ReadOnly);
        }
        self.accepts(entry, value)?;
        let value = fit(self.config.values.ty(entry), value);
        self.config.values.set(entry, value, None);
        Ok(())
    }

    fn units(&self, entry: u16) -> impl Iterator<Item = Unit<'_>> {
        let units = self.entries.get(usize::from(entry)).map_or(&[][..], |info| &info.units);
        units.iter().map(|(name, scale)| Unit { name, scale: *scale })
    }
}

impl<E: Environment + ?Sized + 'static> Plan<E> for LoadedPlan<E> {
    fn start_supervisor<S: Sink, C: Clock>(
        &mut self,
        supervisor: u16,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Result<(), Fault> {
        let watch = self.supervisors.get_mut(usize::from(supervisor)).ok_or(Fault::INTERNAL)?;
        let args = watch.inputs.pull(&self.config.values);
        cx.show_inputs(|see, env, now| watch.slot.start(&args, watch.wanted, see, env, now))
    }

    #[inline]
    fn poll_supervisor<S: Sink, C: Clock>(
        &mut self,
        supervisor: u16,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Fired {
        let Some(watch) = self.supervisors.get_mut(usize::from(supervisor)) else {
            return Fired::fault(Fault::INTERNAL);
        };
        if watch.injected.is_some() {
            return self.report_injected(supervisor, cx);
        }
        let mut stage = Stage::new(&watch.outputs, &mut self.config.staged);
        let args = watch.inputs.pull(&self.config.values);
        match watch.slot.poll(&args, &mut stage, cx.env, cx.now) {
            Ok(None) => Fired::NOTHING,
            Ok(Some(event)) => Fired::event(event, stage.result()),
            Err(fault) => Fired::fault(fault),
        }
    }

    fn start_element<S: Sink, C: Clock>(
        &mut self,
        element: u16,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Started {
        let Some(slot) = self.elements.get_mut(usize::from(element)) else {
            return Started::Failed(Fault::INTERNAL);
        };
        slot.start(&mut self.config, cx)
    }

    fn poll_element<S: Sink, C: Clock>(
        &mut self,
        element: u16,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Polled {
        let Some(slot) = self.elements.get_mut(usize::from(element)) else {
            return Polled::Failed(Fault::INTERNAL);
        };
        match slot.injected {
            None => slot.poll(&mut self.config, cx),
            Some(_) => slot.finish(element, &mut self.config, cx),
        }
    }

    fn interrupt_element<S: Sink, C: Clock>(
        &mut self,
        element: u16,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Result<(), Fault> {
        let slot = self.elements.get_mut(usize::from(element)).ok_or(Fault::INTERNAL)?;
        slot.interrupt(cx)
    }

    fn leave(&mut self, element: u16) {
        if let Some(slot) = self.elements.get_mut(usize::from(element)) {
            slot.clear();
        }
        let locals = self.tables.table().element(element).map(|row| row.locals);
        for local in locals.map_or(0..0, |range| range.first..range.first + range.len) {
            if let Some(watch) = self.supervisors.get_mut(usize::from(local)) {
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
