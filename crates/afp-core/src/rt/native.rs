//! Steps of a component's life as one call each, so that generated code is short.

use core::task::Poll;

use afp_types::{Duration, Text, Value, ValueRef, parse_choice};

use crate::component::{
    Actor, ActorTemplate, Computation, ComputationTemplate, Events, OnReturn, Resumable,
    Supervisor, SupervisorTemplate,
};
use crate::fault::{BadValue, Fault};
use crate::rt::plan::{Cx, Fired, Kept, Polled, Started};
use crate::rt::ports::{Outcome, Ports};
use crate::rt::run::Run;
use crate::rt::store::{Choice, Entry, Stored, Writable};
use crate::rt::write::WriteError;

impl<R: Run> Cx<'_, R> {
    /// Starts an actor.
    ///
    /// # Errors
    /// The fault of an input or of the actor.
    #[inline]
    pub fn start_actor<'i, T, A>(
        &mut self,
        inputs: Result<T::Inputs<'i>, BadValue>,
    ) -> Result<A, Fault>
    where
        T: ActorTemplate,
        T::Inputs<'i>: Ports,
        A: Actor<T, R::Env>,
    {
        let inputs = self.read(inputs)?;
        A::start(inputs, self.env, self.now)
    }

    /// Polls an actor.
    ///
    /// # Errors
    /// The fault of a live input or of the actor.
    #[inline]
    pub fn poll_actor<'i, T, A>(
        &mut self,
        actor: &mut A,
        live: Result<T::Live<'i>, BadValue>,
    ) -> Result<Poll<T::State>, Fault>
    where
        T: ActorTemplate,
        T::Live<'i>: Ports,
        A: Actor<T, R::Env>,
    {
        let live = self.checked(live)?;
        actor.poll(live, self.env, self.now)
    }

    pub fn interrupt_actor<T, A>(&mut self, actor: &mut A) -> Result<(), Fault>
    where
        T: ActorTemplate,
        A: Actor<T, R::Env>,
    {
        actor.interrupt(self.env, self.now)
    }

    /// Suspends an actor.
    ///
    /// # Errors
    /// The fault of the actor.
    pub fn suspend_actor<T, A>(&mut self, actor: &mut A) -> Result<Kept, Fault>
    where
        T: ActorTemplate,
        A: Resumable<T, R::Env>,
    {
        actor.suspend(self.env, self.now).map(|()| Kept::Yes)
    }

    /// Continues an actor that was suspended `away` ago.
    pub fn resume_actor<T, A>(&mut self, actor: &mut A, away: Duration) -> Started
    where
        T: ActorTemplate,
        A: Resumable<T, R::Env>,
    {
        actor.resume(self.env, self.now, away).map_or_else(Started::Failed, |()| Started::Running)
    }

    /// Continues a supervisor that was not polled for `away`, unless it starts again.
    ///
    /// # Errors
    /// The fault of the supervisor.
    pub fn resume_supervisor<T, A>(
        &mut self,
        supervisor: &mut Option<A>,
        away: Duration,
    ) -> Result<OnReturn, Fault>
    where
        T: SupervisorTemplate,
        A: Supervisor<T, R::Env>,
    {
        supervisor.as_mut().ok_or(Fault::INTERNAL)?.resume(self.env, self.now, away)
    }

    /// Starts a supervisor.
    ///
    /// # Errors
    /// The fault of an input or of the supervisor.
    #[inline]
    pub fn start_supervisor<'i, T, A>(
        &mut self,
        inputs: Result<T::Inputs<'i>, BadValue>,
    ) -> Result<Option<A>, Fault>
    where
        T: SupervisorTemplate,
        T::Inputs<'i>: Ports,
        A: Supervisor<T, R::Env>,
    {
        let inputs = self.read(inputs)?;
        A::start(inputs, self.env, self.now).map(Some)
    }

    /// Polls a supervisor.
    ///
    /// # Errors
    /// The fault of a live input or of the supervisor.
    #[inline]
    pub fn poll_supervisor<'i, T, A>(
        &mut self,
        supervisor: &mut Option<A>,
        live: Result<T::Live<'i>, BadValue>,
        wanted: Events,
    ) -> Result<Option<T::Event>, Fault>
    where
        T: SupervisorTemplate,
        T::Live<'i>: Ports,
        A: Supervisor<T, R::Env>,
    {
        let supervisor = supervisor.as_mut().ok_or(Fault::INTERNAL)?;
        let live = self.checked(live)?;
        supervisor.poll(live, wanted, self.env, self.now)
    }

    /// Runs a computation.
    ///
    /// # Errors
    /// The fault of an input or of the computation.
    pub fn compute<'i, T, A>(
        &mut self,
        inputs: Result<T::Inputs<'i>, BadValue>,
    ) -> Result<T::State, Fault>
    where
        T: ComputationTemplate,
        T::Inputs<'i>: Ports,
        A: Computation<T>,
    {
        let inputs = self.read(inputs)?;
        let mut state = None;
        A::compute_in(inputs, &mut state).map_err(|fault| match state {
            Some(state) => self.note(BadValue::from(fault).for_state(state)),
            None => fault,
        })
    }
}

impl Started {
    /// Converts a computation's result; `stage` stages its outputs.
    pub fn computed<O: Outcome, R: Run>(
        computed: Result<O, Fault>,
        stage: impl FnOnce(O) -> Result<(), BadValue>,
        cx: &mut Cx<'_, R>,
    ) -> Self {
        let done = computed.and_then(|state| {
            let index = state.index();
            cx.noted(stage(state)).map(|()| index)
        });
        done.map_or_else(Started::Failed, Started::Done)
    }
}

impl Polled {
    /// Converts an actor's poll; `stage` stages its outputs.
    #[inline]
    pub fn actor<O: Outcome, R: Run>(
        polled: Result<Poll<O>, Fault>,
        stage: impl FnOnce(O) -> Result<(), BadValue>,
        cx: &mut Cx<'_, R>,
    ) -> Self {
        match polled {
            Ok(Poll::Pending) => Polled::Pending,
            Ok(Poll::Ready(state)) => {
                let index = state.index();
                cx.noted(stage(state)).map_or_else(Polled::Failed, |()| Polled::Done(index))
            }
            Err(fault) => Polled::Failed(fault),
        }
    }
}

impl Fired {
    /// Converts a supervisor's poll; `stage` stages its outputs.
    #[inline]
    pub fn supervisor<O: Outcome, R: Run>(
        polled: Result<Option<O>, Fault>,
        stage: impl FnOnce(O) -> Result<(), BadValue>,
        cx: &mut Cx<'_, R>,
    ) -> Self {
        match polled {
            Ok(None) => Fired::NOTHING,
            Ok(Some(event)) => {
                let index = event.index();
                Fired::event(index, cx.noted(stage(event)))
            }
            Err(fault) => Fired::fault(fault),
        }
    }
}

/// Evaluates the formula of an input port, by position in the template.
///
/// # Errors
/// Those of the formula, with the port.
#[inline]
pub fn input<T>(port: u16, value: impl FnOnce() -> Result<T, BadValue>) -> Result<T, BadValue> {
    value().map_err(|why| why.for_input(port))
}

/// Converts the value of an output port, by position in the template, for its entry.
///
/// # Errors
/// Those of conversion and range, with the port.
#[inline]
pub fn output<T>(port: u16, value: impl FnOnce() -> Result<T, BadValue>) -> Result<T, BadValue> {
    value().map_err(|why| why.for_output(port))
}

/// Evaluates the initial value of an entry, by position in its plan.
///
/// # Errors
/// Those of formula and range, with the entry.
pub fn initial<T>(entry: u16, value: impl FnOnce() -> Result<T, BadValue>) -> Result<T, BadValue> {
    value().map_err(|why| why.for_entry(entry))
}

/// Checks that a number is finite.
///
/// # Errors
/// [`Fault::ARITHMETIC`].
#[inline]
pub fn finite<T: Stored>(value: T) -> Result<T, BadValue> {
    finite_value(value.as_value()).map(|()| value)
}

/// Checks that a number is finite and in its entry's range.
///
/// # Errors
/// [`Fault::ARITHMETIC`] or [`Fault::RANGE`].
#[inline]
pub fn limited<T: Stored>(value: T, least: f64, greatest: f64) -> Result<T, BadValue> {
    match value.as_value() {
        ValueRef::Float(number) => between(number, least, greatest)?,
        // The bounds come from integers; larger ones saturate.
        ValueRef::Int(number) => between_ints(number, least as i64, greatest as i64)?,
        _ => {}
    }
    Ok(value)
}

/// Checks that an input port's number is finite and in range.
///
/// # Errors
/// [`Fault::ARITHMETIC`] or [`Fault::RANGE`].
#[inline]
pub fn within(port: u16, value: f64, least: f64, greatest: f64) -> Result<(), BadValue> {
    between(value, least, greatest).map_err(|why| why.for_input(port))
}

/// Checks that an input port's integer is in range.
///
/// # Errors
/// [`Fault::RANGE`].
#[inline]
pub fn within_int(port: u16, value: i64, least: i64, greatest: i64) -> Result<(), BadValue> {
    between_ints(value, least, greatest).map_err(|why| why.for_input(port))
}

/// Checks that an input port's value is finite if it is a number.
///
/// # Errors
/// [`Fault::ARITHMETIC`].
#[inline]
pub fn within_value(port: u16, value: ValueRef<'_>) -> Result<(), BadValue> {
    finite_value(value).map_err(|why| why.for_input(port))
}

#[inline]
fn between(value: f64, least: f64, greatest: f64) -> Result<(), BadValue> {
    if !value.is_finite() {
        Err(BadValue::number(Fault::ARITHMETIC, value))
    } else if (least..=greatest).contains(&value) {
        Ok(())
    } else {
        Err(BadValue::number(Fault::RANGE, value))
    }
}

#[inline]
fn between_ints(value: i64, least: i64, greatest: i64) -> Result<(), BadValue> {
    if (least..=greatest).contains(&value) {
        Ok(())
    } else {
        Err(BadValue::number(Fault::RANGE, value as f64))
    }
}

#[inline]
fn finite_value(value: ValueRef<'_>) -> Result<(), BadValue> {
    match value {
        ValueRef::Float(number) if !number.is_finite() => {
            Err(BadValue::number(Fault::ARITHMETIC, number))
        }
        _ => Ok(()),
    }
}

/// Stores a computed string in `scratch`, for inputs to borrow.
pub fn store_text(scratch: &mut Text, text: Text) -> &str {
    *scratch = text;
    scratch.as_str()
}

/// Returns the name of an enum value.
///
/// # Errors
/// [`Fault::TOO_LONG`].
pub fn print_choice<T: Choice>(value: T) -> Result<Text, Fault> {
    let name = T::NAMES.get(usize::from(value.index())).ok_or(Fault::INTERNAL)?;
    Ok(Text::try_from(*name)?)
}

/// Parses an enum value.
///
/// # Errors
/// [`Fault::CONVERSION`].
pub fn read_choice<T: Choice>(text: &str) -> Result<T, Fault> {
    let index = parse_choice(text, T::NAMES.iter().copied())?;
    T::from_index(index).ok_or(Fault::INTERNAL)
}

/// Stages a value from outside if [`Writable::from_value`] accepts it.
pub fn stage_outside<T: Writable>(staged: &mut Option<T>, value: &Value) {
    if let Ok(value) = T::from_value(value) {
        *staged = Some(value);
    }
}

/// Sets an `in` entry before the start.
///
/// # Errors
/// [`WriteError::Type`] or [`WriteError::NotFinite`].
pub fn set_input<T: Writable>(entry: &mut Entry<T>, value: &Value) -> Result<(), WriteError> {
    entry.set(T::from_value(value)?);
    Ok(())
}

impl WriteError {
    /// Checks that `value` fits an entry of type `T`.
    ///
    /// # Errors
    /// The reason.
    pub fn check<T: Writable>(value: &Value) -> Result<(), WriteError> {
        T::from_value(value).map(|_| ())
    }

    /// Checks that `value` fits an entry of type `T` with a range.
    ///
    /// # Errors
    /// The reason.
    pub fn check_within<T: Writable>(
        value: &Value,
        least: f64,
        greatest: f64,
    ) -> Result<(), WriteError> {
        let value = T::from_value(value)?;
        limited(value, least, greatest).map(|_| ()).map_err(WriteError::of)
    }

    /// Converts the fault of an invalid value.
    pub fn of(why: BadValue) -> WriteError {
        if why.fault == Fault::ARITHMETIC { WriteError::NotFinite } else { WriteError::Range }
    }
}
