//! What a template's author writes: actors, supervisors, computations.
//!
//! The template traits (`ActorTemplate` and its siblings) are implemented by marker types that
//! `toolbox!` makes from a toolbox file; the component traits by the author. States and events
//! carry their outputs as payload, so "written only on that state" follows from the types.

use core::task::Poll;

use afp_types::Instant;

use crate::fault::Fault;

/// What every platform offers, whatever devices it has.
pub trait Environment {
    /// Gives the stop command to every motor and returns at once: called where an actor cannot start, and at the end of a plan
    /// that [`Scheduler::run`](crate::Scheduler::run) drives. What is asked for afterwards is obeyed.
    fn stop(&mut self, now: Instant);

    /// Stops by the strongest means there is that the robot can be used after, once it is opened, reset or made anew: called when the run
    /// cannot be trusted any more, and before the robot is left alone, by whoever drives a scheduler. May be called several
    /// times and without a clock.
    fn emergency_stop(&mut self);
}

/// Events of a supervisor, by position in its template.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Events(u64);

impl Events {
    /// A set from its bits: bit `n` is the template's `n`-th event.
    pub const fn from_bits(bits: u64) -> Self {
        Events(bits)
    }

    /// Whether the template's `n`-th event is one of them.
    pub const fn contains(self, n: u16) -> bool {
        n < 64 && self.0 >> n & 1 == 1
    }
}

/// The ports and states of an actor, as its toolbox file declares them.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is declared in the toolbox, but not as an actor",
    note = "an actor implements `afp::Actor`, a supervisor `afp::Supervisor`, a computation `afp::Computation`"
)]
pub trait ActorTemplate {
    /// Inputs read once, before the start.
    type Inputs<'a>;
    /// Inputs read again before every poll.
    type Live<'a>;
    /// The states with the outputs that each carries.
    type State;
}

/// The ports and events of a supervisor, as its toolbox file declares them.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is declared in the toolbox, but not as a supervisor",
    note = "an actor implements `afp::Actor`, a supervisor `afp::Supervisor`, a computation `afp::Computation`"
)]
pub trait SupervisorTemplate {
    /// Inputs read once, before the start.
    type Inputs<'a>;
    /// Inputs read again before every poll.
    type Live<'a>;
    /// The events with the outputs that each carries.
    type Event;
}

/// The ports and states of a computation, as its toolbox file declares them.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is declared in the toolbox, but not as a computation",
    note = "an actor implements `afp::Actor`, a supervisor `afp::Supervisor`, a computation `afp::Computation`"
)]
pub trait ComputationTemplate {
    /// Its inputs.
    type Inputs<'a>;
    /// The states with the outputs that each carries.
    type State;
}

/// A running actor of template `T` on platform `E`.
///
/// ```text
///   start --Ok--> running --poll: Ready--> finished
///     |              |  \---poll: Err----> interrupt, then gone
///    Err: gone       \------interrupted--> interrupt, then gone
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not implement the actor `{T}` on the platform `{E}`",
    note = "either the platform lacks what the implementation asks for, or there is no `impl Actor<{T}, _> for {Self}`"
)]
pub trait Actor<T: ActorTemplate, E: ?Sized>: Sized {
    /// Begins to act. The first poll comes one period later.
    ///
    /// # Errors
    /// A fault means that nothing runs; the scheduler calls [`Environment::stop`], not
    /// `interrupt`.
    fn start(inputs: T::Inputs<'_>, env: &mut E, now: Instant) -> Result<Self, Fault>;

    /// Goes on without blocking. An actor that is ready leaves the robot as safe as an
    /// interrupted one.
    ///
    /// # Errors
    /// A fault means that the actor cannot go on; `interrupt` follows.
    fn poll(
        &mut self,
        live: T::Live<'_>,
        env: &mut E,
        now: Instant,
    ) -> Result<Poll<T::State>, Fault>;

    /// Gives the stop command and returns. Called exactly once for an actor that was started and
    /// did not finish, before anything else starts.
    ///
    /// # Errors
    /// A fault ends the whole run: what cannot be stopped must not be followed.
    fn interrupt(&mut self, env: &mut E, now: Instant) -> Result<(), Fault>;
}

/// A watching supervisor of template `T` on platform `E`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not implement the supervisor `{T}` on the platform `{E}`",
    note = "either the platform lacks what the implementation asks for, or there is no `impl Supervisor<{T}, _> for {Self}`"
)]
pub trait Supervisor<T: SupervisorTemplate, E: ?Sized>: Sized {
    /// Begins to watch.
    ///
    /// # Errors
    /// A supervisor that cannot see is not "all clear": its actor goes to `Error`.
    fn start(inputs: T::Inputs<'_>, env: &mut E, now: Instant) -> Result<Self, Fault>;

    /// Looks without blocking; reports an event of the `wanted` ones or none, the first declared one
    /// where several hold. Wanted is what would be taken: neither ignored, nor leading to where the
    /// plan is already. That may be another set at each poll, and none.
    ///
    /// # Errors
    /// As for [`Supervisor::start`].
    fn poll(
        &mut self,
        live: T::Live<'_>,
        wanted: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<T::Event>, Fault>;
}

/// A computation of template `T`: no environment, so no side effect.
#[diagnostic::on_unimplemented(message = "`{Self}` does not implement the computation `{T}`")]
pub trait Computation<T: ComputationTemplate> {
    /// Computes at once.
    ///
    /// # Errors
    /// A fault takes the computation's `Error` edge.
    fn compute(inputs: T::Inputs<'_>) -> Result<T::State, Fault>;
}
