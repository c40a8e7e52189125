//! Measures the calls of components and the reactions to events in a real robot's control loop.

use afp_core::rt::NamedPlan;
use afp_core::trace::{ComponentId, Record, Sink};
use afp_core::{Clock, Instant};

use super::Session;
use crate::loop_times::LoopTimes;
use crate::robot::Robot;

/// The times of a control loop, with the calls and events of the current step.
pub(super) struct Meter {
    pub times: LoopTimes,
    /// The component that was called last in this step, and the time of the call.
    called: Option<(ComponentId, Instant)>,
    /// The times of the last two calls of each component.
    last: Box<[[Option<Instant>; 2]]>,
    /// The supervisor whose event was taken in this step, and the time of its poll before.
    event: Option<(ComponentId, Instant)>,
}

impl Meter {
    pub fn new(components: u32) -> Self {
        let last = vec![[None; 2]; components as usize].into_boxed_slice();
        Meter { times: LoopTimes::new(components), called: None, last, event: None }
    }

    fn calls(&mut self, component: ComponentId, now: Instant) {
        self.returns(now);
        self.called = Some((component, now));
        if let Some(last) = self.last.get_mut(component.0 as usize) {
            *last = [last[1], Some(now)];
        }
    }

    /// Notes the end of a call.
    fn returns(&mut self, now: Instant) {
        if let Some((component, since)) = self.called.take()
            && let Some(times) = self.times.calls.get_mut(component.0 as usize)
        {
            times.note(now.since(since));
        }
    }

    fn takes(&mut self, supervisor: ComponentId, now: Instant) {
        self.reacts(now);
        let before = self.last.get(supervisor.0 as usize).and_then(|[before, _]| *before);
        self.event = before.map(|before| (supervisor, before));
    }

    /// Notes that the commands of a reaction are given.
    fn reacts(&mut self, now: Instant) {
        if let Some((supervisor, since)) = self.event.take()
            && let Some(times) = self.times.reactions.get_mut(supervisor.0 as usize)
        {
            times.note(now.since(since));
        }
    }
}

impl<P: NamedPlan, R: Robot, S> Session<P, R, S> {
    #[inline]
    pub(super) fn note_wake_up(&mut self, target: Instant, before: Instant, now: Instant) {
        if let Some(meter) = &mut self.meter {
            meter.times.woke(target, before, now);
        }
    }

    /// Notes that the scheduler has finished a step.
    #[inline]
    pub(super) fn note_reaction(&mut self, now: Instant) {
        if let Some(meter) = &mut self.meter {
            let now = self.clock.now(now);
            meter.returns(now);
            meter.reacts(now);
        }
    }

    /// Notes that a step has ended, and its records are in the queue.
    #[inline]
    pub(super) fn note_step(&mut self, now: Instant) {
        if let Some(meter) = &mut self.meter {
            meter.times.steps.note(self.clock.now(now).since(now));
        }
    }
}

/// A sink that also tells the meter of a real robot, if there is one.
pub(super) struct Metered<'a, S, C> {
    pub sink: &'a mut S,
    pub clock: &'a C,
    pub meter: Option<&'a mut Meter>,
}

impl<S: Sink, C: Clock> Sink for Metered<'_, S, C> {
    const ENABLED: bool = S::ENABLED;

    #[inline]
    fn record(&mut self, at: Instant, record: &Record<'_>) {
        if let (Some(meter), Record::Event { supervisor, .. }) = (&mut self.meter, record) {
            meter.takes(*supervisor, self.clock.now(at));
        }
        self.sink.record(at, record);
    }

    #[inline]
    fn calls(&mut self, component: ComponentId) {
        self.sink.calls(component);
        if let Some(meter) = &mut self.meter {
            meter.calls(component, self.clock.now(Instant::ZERO));
        }
    }
}
