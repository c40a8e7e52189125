//! Signs of life of a real robot's control loop, for another thread.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, Ordering};

use afp_core::trace::ComponentId;
use afp_core::{Duration, Instant};

/// The signs of life of a control loop.
#[derive(Debug, Default)]
pub(crate) struct Pulse {
    /// The last time at which time passed, in nanoseconds.
    beat: AtomicU64,
    /// The component that was called last.
    called: AtomicU32,
    /// Whether another thread stopped the robot.
    cut: AtomicBool,
}

impl Pulse {
    pub(crate) fn beat(&self, now: Instant) {
        self.beat.store(now.as_nanos(), Ordering::Relaxed);
    }

    #[inline]
    pub(crate) fn calls(&self, component: ComponentId) {
        self.called.store(component.0, Ordering::Relaxed);
    }

    pub(crate) fn is_cut(&self) -> bool {
        self.cut.load(Ordering::Relaxed)
    }
}

/// Watches the control loop of a real robot from another thread.
pub struct Watch {
    pulse: Arc<Pulse>,
    clock: Box<dyn Fn() -> Instant + Send>,
}

impl Watch {
    pub(crate) fn new(pulse: Arc<Pulse>, clock: Box<dyn Fn() -> Instant + Send>) -> Self {
        Watch { pulse, clock }
    }

    /// Starts the watch when the control loop begins.
    pub fn begin(&self) {
        self.pulse.beat((self.clock)());
    }

    /// The time since the last sign of life.
    pub fn late(&self) -> Duration {
        let beat = Instant::from_nanos(self.pulse.beat.load(Ordering::Relaxed));
        (self.clock)().since(beat)
    }

    /// The component that was called last.
    pub fn called(&self) -> ComponentId {
        ComponentId(self.pulse.called.load(Ordering::Relaxed))
    }

    /// Ends the run at the next sign of life, because another thread stopped the robot.
    pub fn cut(&self) {
        self.pulse.cut.store(true, Ordering::Relaxed);
    }
}
