//! What a plan runs with.

use core::marker::PhantomData;

use crate::clock::Clock;
use crate::component::Environment;
use crate::trace::Sink;

/// The platform, the trace and the clock of a run, as one type parameter of all that a step goes through.
pub trait Run {
    /// The platform.
    type Env: Environment + ?Sized;
    /// What takes the trace.
    type Sink: Sink;
    /// What times polls.
    type Clock: Clock;
}

/// The run with these three. There is no value of it.
pub(crate) struct With<E: ?Sized, S, C>(PhantomData<fn(&E, &S, &C)>);

impl<E: Environment + ?Sized, S: Sink, C: Clock> Run for With<E, S, C> {
    type Env = E;
    type Sink = S;
    type Clock = C;
}
