//! Boxed slots of components: made at load, filled and emptied by the scheduler.

use std::marker::PhantomData;

use afp_core::rt::{Args, BadValue, FromArgs, Outcome, Outputs};
use afp_core::{
    Actor, ActorTemplate, Computation, ComputationTemplate, Duration, Events, Fault, Instant,
    OnReturn, Poll, Resumable, Supervisor, SupervisorTemplate, ValueRef,
};

/// Passes inputs, by port, to the trace; `None` without a trace.
pub type See<'a> = Option<&'a mut dyn FnMut(u16, ValueRef<'_>)>;

/// The slot of an actor: the equivalent of [`Actor`] for a template known only at run time.
///
/// `start` evaluates, traces and checks all inputs, `poll` the live ones.
///
/// An actor that finishes at its first poll; slots of supervisors and computations are similar:
///
/// ```
/// use afp::load::{ActorSlot, Args, BadValue, Outputs, See};
/// use afp::{Fault, Instant};
///
/// struct AtOnce;
///
/// impl<E: ?Sized> ActorSlot<E> for AtOnce {
///     fn start(
///         &mut self,
///         _: &dyn Args,
///         _: See<'_>,
///         _: &mut E,
///         _: Instant,
///     ) -> Result<(), BadValue> {
///         Ok(())
///     }
///
///     fn poll(
///         &mut self,
///         _: &dyn Args,
///         _: &mut dyn Outputs,
///         _: &mut E,
///         _: Instant,
///     ) -> Result<Option<u16>, BadValue> {
///         Ok(Some(0))
///     }
///
///     fn interrupt(&mut self, _: &mut E, _: Instant) -> Result<(), Fault> {
///         Ok(())
///     }
///
///     fn clear(&mut self) {}
/// }
/// ```
pub trait ActorSlot<E: ?Sized>: Send {
    /// Creates and starts the actor.
    ///
    /// # Errors
    /// As [`Actor::start`].
    fn start(
        &mut self,
        args: &dyn Args,
        see: See<'_>,
        env: &mut E,
        now: Instant,
    ) -> Result<(), BadValue>;
    /// Polls the actor and passes its outputs. Returns the state, if reached.
    ///
    /// # Errors
    /// As [`Actor::poll`].
    fn poll(
        &mut self,
        args: &dyn Args,
        to: &mut dyn Outputs,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<u16>, BadValue>;
    /// Sends the stop command.
    ///
    /// # Errors
    /// As [`Actor::interrupt`].
    fn interrupt(&mut self, env: &mut E, now: Instant) -> Result<(), Fault>;
    /// Suspends the actor, if it can be suspended; otherwise it does nothing and returns `false`.
    /// The default is for actors that their toolbox does not call `resumable`.
    ///
    /// # Errors
    /// As [`Resumable::suspend`].
    fn suspend(&mut self, _env: &mut E, _now: Instant) -> Result<bool, Fault> {
        Ok(false)
    }
    /// Continues the actor, suspended `away` ago.
    ///
    /// # Errors
    /// As [`Resumable::resume`].
    fn resume(&mut self, _env: &mut E, _now: Instant, _away: Duration) -> Result<(), Fault> {
        Err(Fault::INTERNAL)
    }
    /// Drops the actor.
    fn clear(&mut self);
    /// Copies the slot with its actor; `None` if it cannot be copied.
    fn try_clone(&self) -> Option<Box<dyn ActorSlot<E>>> {
        None
    }
}

/// The slot of a supervisor, like [`ActorSlot`].
pub trait SupervisorSlot<E: ?Sized>: Send {
    /// Creates and starts the supervisor.
    ///
    /// # Errors
    /// As [`Supervisor::start`].
    fn start(
        &mut self,
        args: &dyn Args,
        see: See<'_>,
        env: &mut E,
        now: Instant,
    ) -> Result<(), BadValue>;
    /// Polls the supervisor and passes its outputs. Returns the wanted event, if seen.
    ///
    /// # Errors
    /// As [`Supervisor::poll`].
    fn poll(
        &mut self,
        args: &dyn Args,
        wanted: Events,
        to: &mut dyn Outputs,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<u16>, BadValue>;
    /// Continues the supervisor, which was not polled for `away`, unless it starts again.
    ///
    /// # Errors
    /// As [`Supervisor::resume`].
    fn resume(&mut self, _env: &mut E, _now: Instant, _away: Duration) -> Result<OnReturn, Fault> {
        Ok(OnReturn::Restarts)
    }
    /// Drops the supervisor.
    fn clear(&mut self);
    /// As [`ActorSlot::try_clone`].
    fn try_clone(&self) -> Option<Box<dyn SupervisorSlot<E>>> {
        None
    }
}

/// A computation, which is stateless.
pub trait ComputationSlot: Send {
    /// Computes and passes the outputs. Returns the state.
    ///
    /// # Errors
    /// As [`Computation::compute`].
    fn compute(&self, args: &dyn Args, see: See<'_>, to: &mut dyn Outputs)
    -> Result<u16, BadValue>;
    /// As [`ActorSlot::try_clone`].
    fn try_clone(&self) -> Option<Box<dyn ComputationSlot>> {
        None
    }
}

/// The slot of a component of type `A` and template `T`; `S` is how an actor is suspended.
pub struct Slot<T, A, S = Never> {
    running: Option<A>,
    template: PhantomData<fn() -> (T, S)>,
}

/// Calls [`Resumable`] of an actor `A`, if it has it.
pub trait Suspending<T, A, E: ?Sized> {
    fn suspend(actor: &mut A, env: &mut E, now: Instant) -> Result<bool, Fault>;
    fn resume(actor: &mut A, env: &mut E, now: Instant, away: Duration) -> Result<(), Fault>;
}

/// The actor is not resumable.
pub struct Never;

/// The actor is resumable.
pub struct Always;

impl<T, A, E: ?Sized> Suspending<T, A, E> for Never {
    fn suspend(_: &mut A, _: &mut E, _: Instant) -> Result<bool, Fault> {
        Ok(false)
    }

    fn resume(_: &mut A, _: &mut E, _: Instant, _: Duration) -> Result<(), Fault> {
        Err(Fault::INTERNAL)
    }
}

impl<T: ActorTemplate, A: Resumable<T, E>, E: ?Sized> Suspending<T, A, E> for Always {
    fn suspend(actor: &mut A, env: &mut E, now: Instant) -> Result<bool, Fault> {
        actor.suspend(env, now).map(|()| true)
    }

    fn resume(actor: &mut A, env: &mut E, now: Instant, away: Duration) -> Result<(), Fault> {
        actor.resume(env, now, away)
    }
}

impl<T, A, S> Slot<T, A, S> {
    pub fn new() -> Self {
        Slot { running: None, template: PhantomData }
    }
}

/// Evaluates, traces and checks the inputs.
#[inline(always)]
fn inputs<'a, I: FromArgs<'a>>(args: &'a dyn Args, see: See<'_>) -> Result<I, BadValue> {
    let inputs = I::from_args(args)?;
    if let Some(see) = see {
        inputs.each(see);
    }
    inputs.check()?;
    Ok(inputs)
}

fn give(outcome: impl Outcome, to: &mut dyn Outputs) -> u16 {
    let index = outcome.index();
    outcome.give(to);
    index
}

impl<T, A, S, E: ?Sized> ActorSlot<E> for Slot<T, A, S>
where
    S: Suspending<T, A, E> + 'static,
    T: ActorTemplate + 'static,
    A: Actor<T, E> + Clone + Send + 'static,
    for<'a> T::Inputs<'a>: FromArgs<'a>,
    for<'a> T::Live<'a>: FromArgs<'a>,
    T::State: Outcome,
{
    fn start(
        &mut self,
        args: &dyn Args,
        see: See<'_>,
        env: &mut E,
        now: Instant,
    ) -> Result<(), BadValue> {
        self.running = Some(A::start(inputs(args, see)?, env, now)?);
        Ok(())
    }

    fn poll(
        &mut self,
        args: &dyn Args,
        to: &mut dyn Outputs,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<u16>, BadValue> {
        let actor = self.running.as_mut().ok_or(Fault::INTERNAL)?;
        match actor.poll(inputs(args, None)?, env, now)? {
            Poll::Pending => Ok(None),
            Poll::Ready(state) => Ok(Some(give(state, to))),
        }
    }

    fn interrupt(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        self.running.as_mut().ok_or(Fault::INTERNAL)?.interrupt(env, now)
    }

    fn suspend(&mut self, env: &mut E, now: Instant) -> Result<bool, Fault> {
        S::suspend(self.running.as_mut().ok_or(Fault::INTERNAL)?, env, now)
    }

    fn resume(&mut self, env: &mut E, now: Instant, away: Duration) -> Result<(), Fault> {
        S::resume(self.running.as_mut().ok_or(Fault::INTERNAL)?, env, now, away)
    }

    fn clear(&mut self) {
        self.running = None;
    }

    fn try_clone(&self) -> Option<Box<dyn ActorSlot<E>>> {
        Some(Box::new(Slot::<T, A, S> { running: self.running.clone(), template: PhantomData }))
    }
}

impl<T, A, E: ?Sized> SupervisorSlot<E> for Slot<T, A>
where
    T: SupervisorTemplate + 'static,
    A: Supervisor<T, E> + Clone + Send + 'static,
    for<'a> T::Inputs<'a>: FromArgs<'a>,
    for<'a> T::Live<'a>: FromArgs<'a>,
    T::Event: Outcome,
{
    fn start(
        &mut self,
        args: &dyn Args,
        see: See<'_>,
        env: &mut E,
        now: Instant,
    ) -> Result<(), BadValue> {
        self.running = Some(A::start(inputs(args, see)?, env, now)?);
        Ok(())
    }

    #[inline]
    fn poll(
        &mut self,
        args: &dyn Args,
        wanted: Events,
        to: &mut dyn Outputs,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<u16>, BadValue> {
        let supervisor = self.running.as_mut().ok_or(Fault::INTERNAL)?;
        let event = supervisor.poll(inputs(args, None)?, wanted, env, now)?;
        Ok(event.map(|event| give(event, to)))
    }

    fn resume(&mut self, env: &mut E, now: Instant, away: Duration) -> Result<OnReturn, Fault> {
        self.running.as_mut().ok_or(Fault::INTERNAL)?.resume(env, now, away)
    }

    fn clear(&mut self) {
        self.running = None;
    }

    fn try_clone(&self) -> Option<Box<dyn SupervisorSlot<E>>> {
        Some(Box::new(Slot::<T, A> { running: self.running.clone(), template: PhantomData }))
    }
}

impl<T, A> ComputationSlot for Slot<T, A>
where
    T: ComputationTemplate + 'static,
    A: Computation<T> + Send + 'static,
    for<'a> T::Inputs<'a>: FromArgs<'a>,
    T::State: Outcome,
{
    fn compute(
        &self,
        args: &dyn Args,
        see: See<'_>,
        to: &mut dyn Outputs,
    ) -> Result<u16, BadValue> {
        Ok(A::compute(inputs(args, see)?).map(|state| give(state, to))?)
    }

    fn try_clone(&self) -> Option<Box<dyn ComputationSlot>> {
        Some(Box::new(Slot::<T, A>::new()))
    }
}
