//! The surroundings of a running plan.

use crate::clock::Clock;
use crate::component::Environment;
use crate::trace::Sink;

/// The surroundings of a running plan: the platform, the trace sink, and the clock that times
/// polls.
///
/// A tuple of the three, borrowed, implements it. Use [`NoTrace`](crate::trace::NoTrace) and
/// [`StillClock`](crate::StillClock) if you do not need a trace or deadlines:
///
/// ```
/// # use afp_core::{Environment, Instant, Plan, Scheduler, StartError, StillClock, Wake, trace::NoTrace};
/// # fn drive<E: Environment, P: Plan<E>>(robot: &mut E, plan: P) -> Result<(), StartError> {
/// let mut plan = Scheduler::new(plan);
/// let mut wake = plan.start((&mut *robot, &mut NoTrace, &StillClock), Instant::ZERO)?;
/// while let Wake::At(due) = wake {
///     wake = plan.step((&mut *robot, &mut NoTrace, &StillClock), due);
/// }
/// # Ok(())
/// # }
/// ```
#[diagnostic::on_unimplemented(
    message = "a plan cannot run with `{Self}`",
    note = "write three references: `(&mut platform, &mut sink, &clock)`"
)]
pub trait Run {
    /// The platform.
    type Env: Environment + ?Sized;
    /// The trace sink.
    type Sink: Sink;
    /// The clock that times polls.
    type Clock: Clock;

    /// Borrows all three.
    #[doc(hidden)]
    fn parts(&mut self) -> (&mut Self::Env, &mut Self::Sink, &Self::Clock);
}

impl<E: Environment + ?Sized, S: Sink, C: Clock> Run for (&mut E, &mut S, &C) {
    type Env = E;
    type Sink = S;
    type Clock = C;

    #[inline(always)]
    fn parts(&mut self) -> (&mut E, &mut S, &C) {
        (self.0, self.1, self.2)
    }
}
