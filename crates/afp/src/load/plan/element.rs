//! One element of a loaded plan: formulas, bindings, component.

use std::sync::Arc;

use afp_core::rt::{
    BadValue, Child, Cx, ElementId, Flow, Kept, Machine, Plan, PlanState, Polled, Run, Started,
    input,
};
use afp_core::trace::Outcome;
use afp_core::{Duration, Environment, Fault};
use afp_dsl::graph;

use super::LoadedPlan;
use crate::load::config::Config;
use crate::load::inject::{Injected, Injection, NotInjected};
use crate::load::numbered;
use crate::load::outputs::{Binding, Inputs, Stage};
use crate::load::slots::{ActorSlot, ComputationSlot};

pub struct ElementSlot<E: ?Sized + 'static> {
    inputs: Inputs,
    outputs: Arc<[Binding]>,
    running: Running<E>,
    /// The injected outcome of its next poll.
    pub(super) injected: Injected,
    idle: Idle,
}

/// Whether an actor is idle, for tests.
#[derive(Clone, Copy, Debug, Default)]
struct Idle {
    /// From its next start on.
    next: bool,
    /// Since its last start.
    now: bool,
}

/// The component of an element.
pub enum Running<E: ?Sized + 'static> {
    /// An actor.
    Actor(Box<dyn ActorSlot<E>>),
    /// A computation.
    Computation(Box<dyn ComputationSlot>),
    /// A sub-plan, made at load and restarted at each activation.
    SubPlan {
        /// First ids.
        child: Child,
        machine: Box<Machine<LoadedPlan<E>>>,
    },
}

impl<E: ?Sized + 'static> ElementSlot<E> {
    /// A copy that runs independently; `None` if the component cannot be copied.
    pub fn try_clone(&self) -> Option<Self> {
        Some(ElementSlot {
            inputs: self.inputs.clone(),
            outputs: self.outputs.clone(),
            running: match &self.running {
                Running::Actor(actor) => Running::Actor(actor.try_clone()?),
                Running::Computation(computation) => Running::Computation(computation.try_clone()?),
                Running::SubPlan { child, machine } => {
                    let machine = Box::new(machine.try_clone()?);
                    Running::SubPlan { child: *child, machine }
                }
            },
            injected: self.injected.clone(),
            idle: self.idle,
        })
    }
}

impl<E: Environment + ?Sized + 'static> ElementSlot<E> {
    pub fn new(element: &graph::Element, entries: &[graph::Entry], running: Running<E>) -> Self {
        let inputs = Inputs::new(&element.inputs);
        let outputs = Binding::all(&element.outputs, entries);
        ElementSlot { inputs, outputs, running, injected: None, idle: Idle::default() }
    }

    /// Starts it: inputs, then the component.
    pub fn start<R: Run<Env = E>>(&mut self, config: &mut Config, cx: &mut Cx<'_, R>) -> Started {
        self.idle.now = self.idle.next;
        let started = match &mut self.running {
            Running::Actor(_) if self.idle.now => Ok(Started::Running),
            Running::Actor(actor) => {
                let args = self.inputs.pull(&config.values);
                let start = cx.show_inputs(|see, env, now| actor.start(&args, see, env, now));
                cx.noted(start).map(|()| Started::Running)
            }
            Running::Computation(computation) => {
                let args = self.inputs.pull(&config.values);
                let mut stage = Stage::new(&self.outputs, &mut config.staged);
                stage.passed = Some(&args);
                let state = cx.show_inputs(|see, _, _| computation.compute(&args, see, &mut stage));
                let state = state.and_then(|state| stage.result().map(|()| state));
                cx.noted(state).map(Started::Done)
            }
            Running::SubPlan { child, machine } => {
                cx.noted(pass_inputs(&self.inputs, config, machine.plan_mut())).map(|()| {
                    let flow = cx.start_sub_plan(*child, machine);
                    let plan = machine.plan();
                    Started::sub_plan(flow, || stage_results(plan, &self.outputs, config), cx)
                })
            }
        };
        started.unwrap_or_else(Started::Failed)
    }

    #[inline]
    pub fn poll<R: Run<Env = E>>(&mut self, config: &mut Config, cx: &mut Cx<'_, R>) -> Polled {
        match &mut self.running {
            Running::Actor(_) if self.idle.now => Polled::Pending,
            Running::Actor(actor) => {
                let mut stage = Stage::new(&self.outputs, &mut config.staged);
                let args = self.inputs.pull(&config.values);
                match actor.poll(&args, &mut stage, cx.env, cx.now) {
                    Ok(None) => Polled::Pending,
                    Ok(Some(state)) => match stage.result() {
                        Ok(()) => Polled::Done(state),
                        Err(why) => Polled::Failed(cx.note(why)),
                    },
                    Err(why) => Polled::Failed(cx.note(why)),
                }
            }
            Running::Computation(_) => Polled::Failed(Fault::INTERNAL),
            Running::SubPlan { .. } => self.poll_inside(config, cx),
        }
    }

    /// Polls the sub-plan. It is separate, so that the poll of an actor needs few registers.
    #[inline(never)]
    fn poll_inside<R: Run<Env = E>>(&mut self, config: &mut Config, cx: &mut Cx<'_, R>) -> Polled {
        let Running::SubPlan { child, machine } = &mut self.running else {
            return Polled::Failed(Fault::INTERNAL);
        };
        if let Err(fault) = pass_live(*child, machine, &self.inputs, config, cx) {
            return Polled::Failed(fault);
        }
        let flow: Flow = cx.inside(*child, |cx| machine.step(cx));
        let plan = machine.plan();
        Polled::sub_plan(flow, || stage_results(plan, &self.outputs, config), cx)
    }

    /// Suspends it, innermost first.
    pub fn suspend<R: Run<Env = E>>(&mut self, cx: &mut Cx<'_, R>) -> Result<Kept, Fault> {
        match &mut self.running {
            Running::Actor(_) if self.idle.now => Ok(Kept::Yes),
            Running::Actor(actor) => {
                let kept = actor.suspend(cx.env, cx.now)?;
                Ok(if kept { Kept::Yes } else { Kept::No })
            }
            Running::Computation(_) => Err(Fault::INTERNAL),
            Running::SubPlan { child, machine } => cx.inside(*child, |cx| machine.suspend(cx)),
        }
    }

    /// Passes the live inputs of a sub-plan that is set aside.
    pub fn refresh<R: Run<Env = E>>(
        &mut self,
        config: &mut Config,
        cx: &mut Cx<'_, R>,
    ) -> Result<(), Fault> {
        match &mut self.running {
            Running::Actor(_) | Running::Computation(_) => Ok(()),
            Running::SubPlan { child, machine } => {
                pass_live(*child, machine, &self.inputs, config, cx)
            }
        }
    }

    /// Continues it after a suspension.
    pub fn resume<R: Run<Env = E>>(
        &mut self,
        away: Duration,
        config: &mut Config,
        cx: &mut Cx<'_, R>,
    ) -> Started {
        match &mut self.running {
            Running::Actor(_) if self.idle.now => Started::Running,
            Running::Actor(actor) => match actor.resume(cx.env, cx.now, away) {
                Ok(()) => Started::Running,
                Err(fault) => Started::Failed(fault),
            },
            Running::Computation(_) => Started::Failed(Fault::INTERNAL),
            Running::SubPlan { child, machine } => {
                let flow = cx.resume_sub_plan(*child, machine, away);
                let plan = machine.plan();
                Started::sub_plan(flow, || stage_results(plan, &self.outputs, config), cx)
            }
        }
    }

    /// Reaches an injected state, or fails; the scheduler then interrupts the component.
    #[cold]
    #[inline(never)]
    pub fn finish<R: Run<Env = E>>(
        &mut self,
        element: ElementId,
        config: &mut Config,
        cx: &mut Cx<'_, R>,
    ) -> Polled {
        let Some(injected) = self.injected.take() else { return Polled::Pending };
        cx.show_injected(element.0.into(), injected.outcome);
        let Outcome::Declared(state) = injected.outcome else {
            return Polled::Failed(Fault::INJECTED);
        };
        let mut stage = Stage::new(&self.outputs, &mut config.staged);
        injected.stage(&mut stage);
        match stage.result() {
            Ok(()) => Polled::Forced(state),
            Err(why) => Polled::Failed(cx.note(why)),
        }
    }

    /// Injects a state for the next poll of an active actor.
    pub fn inject(&mut self, injection: &Injection) -> Result<(), NotInjected> {
        match self.running {
            Running::Actor(_) => injection.put(&mut self.injected),
            Running::Computation(_) | Running::SubPlan { .. } => Err(NotInjected::NotActive),
        }
    }

    /// Passes an injection to the running sub-plan; `part` counts from the outer plan's first
    /// element.
    pub fn inject_inside(&mut self, part: u32, injection: &Injection) -> Result<(), NotInjected> {
        let Running::SubPlan { child, machine } = &mut self.running else {
            return Err(NotInjected::NotActive);
        };
        let part = part.checked_sub(child.components).ok_or(NotInjected::NotActive)?;
        let active = machine.active();
        machine.plan_mut().inject_at(active, part, injection)
    }

    /// Makes an actor, or all actors of a sub-plan, idle from the next start on.
    pub fn idle(&mut self) {
        match &mut self.running {
            Running::Actor(_) => self.idle.next = true,
            Running::Computation(_) => {}
            Running::SubPlan { machine, .. } => machine.plan_mut().idle_all(),
        }
    }

    /// As [`ElementSlot::idle`] for a part of the sub-plan; `part` as in
    /// [`ElementSlot::inject_inside`].
    pub fn idle_inside(&mut self, part: u32) -> bool {
        let Running::SubPlan { child, machine } = &mut self.running else { return false };
        let part = part.checked_sub(child.components);
        part.is_some_and(|part| machine.plan_mut().idle_at(part))
    }

    /// Interrupts it, innermost first.
    pub fn interrupt<R: Run<Env = E>>(&mut self, cx: &mut Cx<'_, R>) -> Result<(), Fault> {
        match &mut self.running {
            Running::Actor(_) if self.idle.now => Ok(()),
            Running::Actor(actor) => actor.interrupt(cx.env, cx.now),
            Running::Computation(_) => Err(Fault::INTERNAL),
            Running::SubPlan { child, machine } => cx.inside(*child, |cx| machine.interrupt(cx)),
        }
    }

    pub fn clear(&mut self) {
        self.injected = None;
        match &mut self.running {
            Running::Actor(actor) => actor.clear(),
            Running::Computation(_) => {}
            Running::SubPlan { machine, .. } => Plan::<E>::end(machine.plan_mut()),
        }
    }
}

/// Evaluates the inputs of a sub-plan into its `in` entries.
fn pass_inputs<E: Environment + ?Sized + 'static>(
    inputs: &Inputs,
    config: &Config,
    plan: &mut LoadedPlan<E>,
) -> Result<(), BadValue> {
    for (port, formula) in numbered(inputs.formulas()) {
        let object = formula.entry().and_then(|entry| config.values.cell(entry));
        let value = formula.finite(&config.values);
        let passed = value.and_then(|value| plan.pass(port.into(), value, object));
        input(port, || passed)?;
    }
    Ok(())
}

/// Evaluates the live inputs of a sub-plan and stages those that have changed; returns whether
/// there are any.
fn stage_live<E: Environment + ?Sized + 'static>(
    inputs: &Inputs,
    config: &Config,
    plan: &mut LoadedPlan<E>,
) -> Result<bool, BadValue> {
    let mut any = false;
    for (port, formula) in numbered(inputs.formulas()) {
        let object = formula.entry().and_then(|entry| config.values.cell(entry));
        let value = || formula.finite(&config.values);
        any |= input(port, || plan.pass_live(port.into(), value, object))?;
    }
    Ok(any)
}

/// Commits the live inputs of a sub-plan that have changed.
fn pass_live<E: Environment + ?Sized + 'static, R: Run<Env = E>>(
    child: Child,
    machine: &mut Machine<LoadedPlan<E>>,
    inputs: &Inputs,
    config: &Config,
    cx: &mut Cx<'_, R>,
) -> Result<(), Fault> {
    match stage_live(inputs, config, machine.plan_mut()) {
        Ok(false) => {}
        Ok(true) => cx.pass_live(child, machine, |plan, to| {
            plan.commit(to);
            true
        }),
        Err(why) => {
            machine.plan_mut().discard();
            return Err(cx.note(why));
        }
    }
    Ok(())
}

/// Stages the `out` entries of a sub-plan that are set.
fn stage_results<E: Environment + ?Sized + 'static>(
    plan: &LoadedPlan<E>,
    outputs: &[Binding],
    config: &mut Config,
) -> Result<(), BadValue> {
    let mut stage = Stage::new(outputs, &mut config.staged);
    for (port, entry) in plan.results() {
        match plan.cell(entry) {
            Some(cell) => stage.put_object(port, |to| to.copy(cell)),
            None => stage.put(port, plan.entry(entry).to_value()?),
        }
    }
    stage.result()
}
