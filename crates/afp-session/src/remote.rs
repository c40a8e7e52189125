//! A debugger on another thread: its requests, and the places where it stops the plan.
//!
//! The control thread and the debugger's thread meet in bounded queues, and neither waits for the
//! other. The control thread takes a few requests between two steps, so a busy debugger does not
//! delay the plan.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use afp_core::Instant;
use afp_core::trace::Record;
use rtrb::{Consumer, Producer, RingBuffer};

use crate::any::AnySession;
use crate::observer::{Applied, NamedRecord, Observer};
use crate::request::{Request, RequestId};
use crate::stimulus::Stimulus;

/// The most requests that wait for the control thread.
const WAITING: usize = 64;
/// The most requests that are made between two steps.
const PER_STEP: usize = 8;
/// The most tripwires that wait for the control thread.
const TRIPWIRES: usize = 8;

/// Decides which records stop the plan. It is called on the control thread, so it must not wait or
/// allocate.
pub trait Tripwire: Send {
    /// Whether the plan must be held because of this record.
    fn trips(&mut self, at: Instant, record: &Record<'_>) -> bool;
}

/// The debugger's end.
pub struct Remote {
    requests: Producer<Request>,
    tripwires: Producer<Option<Box<dyn Tripwire>>>,
    /// Replaced tripwires, to be dropped here.
    used: Consumer<Box<dyn Tripwire>>,
    shared: Arc<Shared>,
}

/// The control thread's end: makes the requests in the session.
pub struct Steering {
    requests: Consumer<Request>,
    shared: Arc<Shared>,
}

/// Applies the tripwire to all records. It is an observer on the control thread.
pub struct Wire {
    tripwires: Consumer<Option<Box<dyn Tripwire>>>,
    used: Producer<Box<dyn Tripwire>>,
    current: Option<Box<dyn Tripwire>>,
    shared: Arc<Shared>,
}

/// Whether a [`Steering`] has work, for a gate that waits.
#[derive(Clone)]
pub struct Asked(Arc<Shared>);

/// The queue to the control thread is full.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the robot has too many requests waiting: try again")]
pub struct Busy;

#[derive(Default)]
struct Shared {
    waiting: AtomicUsize,
    tripped: AtomicBool,
}

/// Makes the three ends.
pub fn remote() -> (Remote, Steering, Wire) {
    let (to_session, requests) = RingBuffer::new(WAITING);
    let (to_wire, tripwires) = RingBuffer::new(TRIPWIRES);
    // Room for all that wait and the current tripwire.
    let (back, used) = RingBuffer::new(TRIPWIRES + 1);
    let shared: Arc<Shared> = Arc::default();
    (
        Remote { requests: to_session, tripwires: to_wire, used, shared: shared.clone() },
        Steering { requests, shared: shared.clone() },
        Wire { tripwires, used: back, current: None, shared },
    )
}

impl Remote {
    /// Makes a request, as soon as the control thread can take it.
    ///
    /// # Errors
    /// The queue is full.
    pub fn ask(&mut self, request: Request) -> Result<(), Busy> {
        self.requests.push(request).map_err(|_| Busy)?;
        self.shared.waiting.fetch_add(1, Ordering::Release);
        Ok(())
    }

    /// Replaces the tripwire.
    ///
    /// # Errors
    /// The queue is full.
    pub fn watch(&mut self, tripwire: Option<Box<dyn Tripwire>>) -> Result<(), Busy> {
        while self.used.pop().is_ok() {}
        self.tripwires.push(tripwire).map_err(|_| Busy)
    }
}

impl Steering {
    /// Whether there is a request or a hit.
    #[inline]
    pub fn is_asked(&self) -> bool {
        self.shared.is_asked()
    }

    /// The same for a gate.
    pub fn asked(&self) -> Asked {
        Asked(self.shared.clone())
    }

    /// Makes waiting requests for an instant that has not passed; the rest waits for the next call.
    /// A hit holds the plan.
    #[cold]
    pub fn apply(
        &mut self,
        session: &mut dyn AnySession,
        at: Instant,
        to: &mut [&mut dyn Observer],
    ) {
        if self.shared.tripped.swap(false, Ordering::Acquire) {
            // The only possible error is that the run has ended.
            let _ = session.at(at, Request::Pause);
        }
        for _ in 0..PER_STEP {
            let Ok(request) = self.requests.pop() else { break };
            self.shared.waiting.fetch_sub(1, Ordering::Release);
            let what = Stimulus::new(&request, session.devices(), session.names());
            if let Err(why) = session.at(at, request) {
                let (id, refused) = (RequestId(u64::MAX), Some(&why));
                let applied = Applied { now: session.now(), at, id, what: &what, refused };
                to.iter_mut().for_each(|each| each.on_request(&applied));
            }
        }
    }
}

impl Asked {
    /// Whether there is a request or a hit.
    pub fn is_asked(&self) -> bool {
        self.0.is_asked()
    }
}

impl Shared {
    #[inline]
    fn is_asked(&self) -> bool {
        self.waiting.load(Ordering::Acquire) > 0 || self.tripped.load(Ordering::Acquire)
    }
}

impl Observer for Wire {
    fn on_record(&mut self, named: &NamedRecord<'_>) {
        while let Ok(next) = self.tripwires.pop() {
            if let Some(before) = std::mem::replace(&mut self.current, next) {
                // There is room for all of them.
                let _ = self.used.push(before);
            }
        }
        if let Some(tripwire) = &mut self.current
            && tripwire.trips(named.at, named.record)
        {
            self.shared.tripped.store(true, Ordering::Release);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Every;

    impl Tripwire for Every {
        fn trips(&mut self, _: Instant, _: &Record<'_>) -> bool {
            true
        }
    }

    #[test]
    fn queues_are_bounded_and_replaced_tripwires_come_back() {
        let (mut remote, steering, _wire) = remote();
        assert!(!steering.is_asked());
        for _ in 0..WAITING {
            remote.ask(Request::Pause).unwrap();
        }
        assert_eq!(remote.ask(Request::Stop), Err(Busy));
        assert!(steering.is_asked() && steering.asked().is_asked());
        for _ in 0..TRIPWIRES {
            remote.watch(Some(Box::new(Every))).unwrap();
        }
        assert_eq!(remote.watch(None), Err(Busy));
    }
}
