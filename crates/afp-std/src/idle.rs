//! Do nothing until an event interrupts.

use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};

use crate::templates;
use crate::templates::idle::{Inputs, Live, State};

/// Lasts until it is interrupted.
#[derive(Clone, Copy, Debug)]
pub struct Idle;

impl<E: ?Sized> Actor<templates::Idle, E> for Idle {
    fn start(_: Inputs, _: &mut E, _: Instant) -> Result<Self, Fault> {
        Ok(Idle)
    }

    fn poll(&mut self, _: Live, _: &mut E, _: Instant) -> Result<Poll<State>, Fault> {
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, _: &mut E, _: Instant) -> Result<(), Fault> {
        Ok(())
    }
}

impl<E: ?Sized> Resumable<templates::Idle, E> for Idle {
    fn suspend(&mut self, _: &mut E, _: Instant) -> Result<(), Fault> {
        Ok(())
    }

    fn resume(&mut self, _: &mut E, _: Instant, _: Duration) -> Result<(), Fault> {
        Ok(())
    }
}
