//! A guard around each call of the machine. A panic marks the plan as broken, by a component or by
//! code outside of the plan.

use core::cell::Cell;

use afp_types::Instant;

use super::State;
use crate::clock::Clock;
use crate::trace::{ComponentId, Record, Sink};

/// Whether a sink or a clock is being called.
#[derive(Default)]
struct Outside(Cell<bool>);

/// A sink or a clock whose panics are attributed to it.
pub(super) struct Watched<'a, T> {
    inner: T,
    outside: &'a Outside,
}

impl Outside {
    #[inline]
    fn call<R>(&self, call: impl FnOnce() -> R) -> R {
        self.0.set(true);
        let result = call();
        self.0.set(false);
        result
    }
}

impl<S: Sink> Sink for Watched<'_, &mut S> {
    const ENABLED: bool = S::ENABLED;

    #[inline]
    fn record(&mut self, at: Instant, record: &Record<'_>) {
        self.outside.call(|| self.inner.record(at, record));
    }

    #[inline]
    fn calls(&mut self, component: ComponentId) {
        self.inner.calls(component);
    }
}

impl<C: Clock> Clock for Watched<'_, &C> {
    #[inline]
    fn now(&self, step: Instant) -> Instant {
        self.outside.call(|| self.inner.now(step))
    }
}

/// Marks the plan as broken if a panic unwinds.
struct Unwinding<'a> {
    state: &'a mut State,
    outside: &'a Outside,
}

impl Drop for Unwinding<'_> {
    fn drop(&mut self) {
        *self.state = State::Broken { outside: self.outside.0.get() };
    }
}

/// Runs `call` with a sink and a clock; a panic leaves the state broken.
#[inline(always)]
pub(super) fn guarded<S, C, R>(
    state: &mut State,
    (sink, clock): (&mut S, &C),
    call: impl FnOnce(&mut Watched<'_, &mut S>, &Watched<'_, &C>) -> R,
) -> R {
    let outside = Outside::default();
    let unwinding = Unwinding { state, outside: &outside };
    let mut sink = Watched { inner: sink, outside: &outside };
    let clock = Watched { inner: clock, outside: &outside };
    let result = call(&mut sink, &clock);
    core::mem::forget(unwinding);
    result
}
