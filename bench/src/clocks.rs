//! A robot's clock and trace.

use std::time;

use afp_core::trace::{ComponentId, Record, Sink, Verdict};
use afp_core::{Clock, Instant};

/// The machine's monotonic clock, read after every poll.
///
/// Steps of a benchmark are nominally ten milliseconds apart and run without a pause. The clock
/// therefore counts from the step of its last reading, but reads the real clock every time.
pub struct Monotonic(time::Instant);

impl Monotonic {
    pub fn new() -> Self {
        Monotonic(time::Instant::now())
    }
}

impl Clock for Monotonic {
    #[inline]
    fn now(&self, step: Instant) -> Instant {
        // Less than one period of all measured plans, so no deadline is missed.
        let nanos = self.0.elapsed().as_nanos() as u64;
        Instant::from_nanos(step.as_nanos() + (nanos & 0xf_ffff))
    }
}

/// Keeps the latest records in place: time, component, event.
pub struct Ring {
    slots: Box<[(u64, u32, u32); 1024]>,
    next: usize,
}

impl Ring {
    pub fn new() -> Self {
        Ring { slots: Box::new([(0, 0, 0); 1024]), next: 0 }
    }
}

impl Sink for Ring {
    #[inline]
    fn record(&mut self, at: Instant, record: &Record<'_>) {
        let (component, what) = match *record {
            Record::Polled { supervisor, verdict: Verdict::Clear } => (supervisor, 1),
            Record::Polled { supervisor, .. } => (supervisor, 2),
            Record::Missed { supervisor, .. } => (supervisor, 3),
            Record::Started { component } => (component, 4),
            Record::Finished { element, .. } => (element, 5),
            _ => (ComponentId(0), 0),
        };
        self.slots[self.next & 1023] = (at.as_nanos(), component.0, what);
        self.next = self.next.wrapping_add(1);
    }
}
