//! The scheduler's interface of a plan.

use afp_types::{Duration, Value, ValueRef};

use crate::component::{Events, OnReturn};
use crate::fault::{BadValue, Fault};
use crate::rt::aside::Aside;
use crate::rt::plan::{Committer, Cx, Fired, Kept, Polled, Slot, Started};
use crate::rt::run::Run;
use crate::rt::table::{ElementId, SupervisorId, Tables};
use crate::rt::write::WriteError;
use crate::trace::Sink;

/// A plan, independent of its platform: rows, entries, staged outputs. `plan!` and the plan loader
/// implement it; programs use it in bounds.
pub trait PlanState: Sized {
    /// The type of its rows.
    #[doc(hidden)]
    type Tables: Tables + Send;
    /// Storage for the releases of its [`crate::rt::PlanTable::slots`] supervisors.
    #[doc(hidden)]
    type Slots: AsRef<[Slot]> + AsMut<[Slot]> + Clone + Send;

    /// Storage for the element that is set aside: `()` without `suspend`.
    #[doc(hidden)]
    type Aside: Aside;

    /// Whether a debugger can hold the plan. Otherwise no code for it is linked.
    #[doc(hidden)]
    const HOLDS: bool = false;

    /// Returns the rows.
    #[doc(hidden)]
    fn tables(&self) -> Self::Tables;

    /// Runs `run` for an element. A compiled plan matches each element, so that each has its own
    /// step with folded rows.
    #[doc(hidden)]
    #[inline(always)]
    fn at_element<A: AtElement>(element: ElementId, run: A) -> A::Out {
        run.any(element)
    }

    /// A copy that runs independently; `None` if a component cannot be copied.
    #[doc(hidden)]
    fn try_clone(&self) -> Option<Self>;

    /// New storage for releases.
    #[doc(hidden)]
    fn slots(&self) -> Self::Slots;

    /// Position of the first `in` entry without a value or default.
    #[doc(hidden)]
    fn missing_input(&self) -> Option<u16>;

    /// Sets every entry, except `in` entries that are set, to its initial value, or unsets it.
    ///
    /// # Errors
    /// The fault of a formula; the plan then ends in `Error`.
    #[doc(hidden)]
    fn initialise(&mut self) -> Result<(), BadValue>;

    /// The element at which the next start begins, if it is not the first.
    #[doc(hidden)]
    #[inline(always)]
    fn begins_at(&mut self) -> Option<ElementId> {
        None
    }

    /// An entry's committed value.
    #[doc(hidden)]
    fn entry(&self, entry: u16) -> ValueRef<'_>;

    /// Checks whether an entry accepts this value from outside.
    ///
    /// # Errors
    /// The reason.
    #[doc(hidden)]
    fn accepts(&self, entry: u16, value: &Value) -> Result<(), WriteError>;

    /// Sets an `in` entry, by position, before the start.
    ///
    /// # Errors
    /// The reason; [`WriteError::NotStarted`] for a `var` entry.
    #[doc(hidden)]
    fn set_input(&mut self, entry: u16, value: &Value) -> Result<(), WriteError>;

    /// Stages a value that [`PlanState::accepts`] accepted.
    #[doc(hidden)]
    fn stage(&mut self, entry: u16, value: &Value);

    /// Writes all staged values, in the order of the entries.
    #[doc(hidden)]
    fn commit<S: Sink>(&mut self, to: &mut Committer<'_, S>);

    /// Drops all staged values.
    #[doc(hidden)]
    fn discard(&mut self);
}

/// Work for one element.
pub trait AtElement: Sized {
    /// The result.
    type Out;

    /// Runs for an element known at compile time.
    fn at<const ELEMENT: u16>(self) -> Self::Out;

    /// Runs for any element.
    fn any(self, element: ElementId) -> Self::Out;

    /// Runs for an unknown element.
    fn unknown(self) -> Self::Out;
}

/// A plan on platform `E`, with its components. `plan!` and the plan loader implement it; programs
/// use it in bounds.
///
/// Polls stage the outputs of their results; the scheduler then commits or discards them.
pub trait Plan<E: ?Sized>: PlanState {
    /// Starts a supervisor: inputs, then the component.
    ///
    /// # Errors
    /// The fault of an input or of the component.
    #[doc(hidden)]
    fn start_supervisor<R: Run<Env = E>>(
        &mut self,
        supervisor: SupervisorId,
        cx: &mut Cx<'_, R>,
    ) -> Result<(), Fault>;

    /// Polls a supervisor for the wanted events.
    #[doc(hidden)]
    fn poll_supervisor<R: Run<Env = E>>(
        &mut self,
        supervisor: SupervisorId,
        wanted: Events,
        cx: &mut Cx<'_, R>,
    ) -> Fired;

    /// Starts an element: inputs, then the component. Runs a computation.
    #[doc(hidden)]
    fn start_element<R: Run<Env = E>>(&mut self, element: ElementId, cx: &mut Cx<'_, R>)
    -> Started;

    /// Polls the active element.
    #[doc(hidden)]
    fn poll_element<R: Run<Env = E>>(&mut self, element: ElementId, cx: &mut Cx<'_, R>) -> Polled;

    /// Interrupts the active element.
    ///
    /// # Errors
    /// A failed interrupt ends the whole run.
    #[doc(hidden)]
    fn interrupt_element<R: Run<Env = E>>(
        &mut self,
        element: ElementId,
        cx: &mut Cx<'_, R>,
    ) -> Result<(), Fault>;

    /// Suspends the active element, unless it cannot be suspended. It is kept until
    /// [`Plan::leave`].
    ///
    /// # Errors
    /// The fault of an actor, which must be interrupted.
    #[doc(hidden)]
    fn suspend_element<R: Run<Env = E>>(
        &mut self,
        _: ElementId,
        _: &mut Cx<'_, R>,
    ) -> Result<Kept, Fault> {
        Ok(Kept::No)
    }

    /// Continues an element that was suspended `away` ago.
    #[doc(hidden)]
    fn resume_element<R: Run<Env = E>>(
        &mut self,
        _: ElementId,
        _away: Duration,
        _: &mut Cx<'_, R>,
    ) -> Started {
        Started::Failed(Fault::INTERNAL)
    }

    /// Passes the live inputs of a sub-plan that is set aside.
    ///
    /// # Errors
    /// The fault of an input.
    #[doc(hidden)]
    fn refresh_element<R: Run<Env = E>>(
        &mut self,
        _: ElementId,
        _: &mut Cx<'_, R>,
    ) -> Result<(), Fault> {
        Ok(())
    }

    /// Continues a supervisor that was not polled for `away`, unless its template starts again.
    ///
    /// # Errors
    /// The fault of the component.
    #[doc(hidden)]
    fn resume_supervisor<R: Run<Env = E>>(
        &mut self,
        _: SupervisorId,
        _away: Duration,
        _: &mut Cx<'_, R>,
    ) -> Result<OnReturn, Fault> {
        Ok(OnReturn::Restarts)
    }

    /// Drops an element's instance and its supervisors.
    #[doc(hidden)]
    fn leave(&mut self, element: ElementId);

    /// Drops all remaining components at the plan's end.
    #[doc(hidden)]
    fn end(&mut self);
}
