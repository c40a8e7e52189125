//! What the scheduler asks of a plan.

use afp_types::{Value, ValueRef};

use crate::component::Events;
use crate::fault::{BadValue, Fault};
use crate::rt::plan::{Committer, Cx, Fired, Polled, Slot, Started};
use crate::rt::run::Run;
use crate::rt::table::{ElementId, SupervisorId, Tables};
use crate::rt::write::WriteError;
use crate::trace::Sink;

/// A plan, whatever its platform: its rows, entries, staged outputs. `plan!` and the loader of plans
/// implement it; programs name it in bounds.
pub trait PlanState: Sized {
    /// Its rows.
    #[doc(hidden)]
    type Tables: Tables + Send;
    /// Storage for the releases of its supervisors, [`crate::rt::PlanTable::slots`] of them.
    #[doc(hidden)]
    type Slots: AsRef<[Slot]> + AsMut<[Slot]> + Clone + Send;

    /// Its rows.
    #[doc(hidden)]
    fn tables(&self) -> Self::Tables;

    /// Runs `run` at an element. A compiled plan spells the elements out, so that each has a step
    /// of its own with its rows folded in.
    #[doc(hidden)]
    #[inline(always)]
    fn at_element<A: AtElement>(element: ElementId, run: A) -> A::Out {
        run.any(element)
    }

    /// A copy that goes on from here by itself; `None` where a component cannot be copied.
    #[doc(hidden)]
    fn try_clone(&self) -> Option<Self>;

    /// Fresh storage for releases.
    #[doc(hidden)]
    fn slots(&self) -> Self::Slots;

    /// The number of the first `in` entry that has neither a value nor a default.
    #[doc(hidden)]
    fn missing_input(&self) -> Option<u16>;

    /// Gives every entry but the `in` ones that were set its initial value, or makes it unset.
    ///
    /// # Errors
    /// The fault of a formula; the plan then ends in `Error`.
    #[doc(hidden)]
    fn initialise(&mut self) -> Result<(), BadValue>;

    /// An entry's committed value.
    #[doc(hidden)]
    fn entry(&self, entry: u16) -> ValueRef<'_>;

    /// Whether a writer from outside may give an entry this value.
    ///
    /// # Errors
    /// Why not.
    #[doc(hidden)]
    fn accepts(&self, entry: u16, value: &Value) -> Result<(), WriteError>;

    /// Gives an `in` entry, by position, a value before the start.
    ///
    /// # Errors
    /// Why not; [`WriteError::NotStarted`] for a `var` entry.
    #[doc(hidden)]
    fn set_input(&mut self, entry: u16, value: &Value) -> Result<(), WriteError>;

    /// Stages a value that [`PlanState::accepts`] let pass.
    #[doc(hidden)]
    fn stage(&mut self, entry: u16, value: &Value);

    /// Writes everything that is staged, in the order of the entries.
    #[doc(hidden)]
    fn commit<S: Sink>(&mut self, to: &mut Committer<'_, S>);

    /// Forgets everything that is staged.
    #[doc(hidden)]
    fn discard(&mut self);
}

/// Work to be done at an element.
pub trait AtElement: Sized {
    /// What it gives.
    type Out;

    /// Does it at an element known when the plan is compiled.
    fn at<const ELEMENT: u16>(self) -> Self::Out;

    /// Does it at any element.
    fn any(self, element: ElementId) -> Self::Out;

    /// There is no such element.
    fn unknown(self) -> Self::Out;
}

/// A plan on platform `E`: its components. `plan!` and the loader of plans implement it; programs name
/// it in bounds.
///
/// Polls stage the outputs of what they report; the scheduler then commits or discards them.
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

    /// Polls a supervisor for the events that would be taken.
    #[doc(hidden)]
    fn poll_supervisor<R: Run<Env = E>>(
        &mut self,
        supervisor: SupervisorId,
        wanted: Events,
        cx: &mut Cx<'_, R>,
    ) -> Fired;

    /// Starts an element: inputs, then the component; runs a computation.
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

    /// Drops an element's instance and its supervisors.
    #[doc(hidden)]
    fn leave(&mut self, element: ElementId);

    /// Drops everything that is left when the plan ends.
    #[doc(hidden)]
    fn end(&mut self);
}
