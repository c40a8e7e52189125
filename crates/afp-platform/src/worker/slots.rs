//! The slots of a worker, for every kind of worker.

use afp_core::{Duration, Fault, Instant, Poll, Ticket};

/// A finished job is kept this long: longer than a component waits between two polls. Then its slot
/// may be reused.
const KEPT: Duration = Duration::from_secs(1);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Free,
    Busy,
    /// A job is under way whose result is not needed.
    Cancelled,
    /// The result waits to be fetched.
    Finished(Result<(), Fault>),
    Broken,
}

#[derive(Clone, Copy, Debug)]
struct Slot {
    state: State,
    /// Number of jobs so far.
    round: u64,
    /// End of the last job.
    ended: Instant,
}

impl Slot {
    fn is_broken(&self) -> bool {
        self.state == State::Broken || self.state == State::Finished(Err(Fault::JOB_PANICKED))
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Slots(Vec<Slot>);

impl Slots {
    /// # Panics
    /// With more than 65536 slots.
    pub(crate) fn new(count: usize) -> Self {
        assert!(count <= usize::from(u16::MAX) + 1, "a worker has at most 65536 slots");
        Slots(vec![Slot { state: State::Free, round: 0, ended: Instant::ZERO }; count])
    }

    /// Takes a free slot, or else a slot whose finished job was not fetched within [`KEPT`]. `None`
    /// if all are busy.
    ///
    /// # Errors
    /// All slots are broken.
    pub(crate) fn take(&mut self, now: Instant) -> Result<Option<Ticket>, Fault> {
        if self.0.iter().all(Slot::is_broken) {
            return Err(Fault::JOB_PANICKED);
        }
        let free = |slot: &Slot| slot.state == State::Free;
        let stale = |slot: &Slot| {
            let finished = matches!(slot.state, State::Finished(_)) && !slot.is_broken();
            finished && now.since(slot.ended) > KEPT
        };
        let found = self.0.iter().position(free).or_else(|| self.0.iter().position(stale));
        let Some(index) = found else { return Ok(None) };
        let slot = &mut self.0[index];
        slot.state = State::Busy;
        slot.round += 1;
        Ok(Some(Ticket::new(index as u16, slot.round)))
    }

    pub(crate) fn finish(&mut self, index: u16, result: Result<(), Fault>, now: Instant) {
        let Some(slot) = self.0.get_mut(usize::from(index)) else { return };
        slot.ended = now;
        slot.state = match slot.state {
            State::Busy => State::Finished(result),
            _ => after(result),
        };
    }

    /// Frees the slot of a ticket's finished job and returns it; pending while the job is under
    /// way.
    ///
    /// # Errors
    /// The fault of the job; [`Fault::JOB_LOST`] if it is no longer in the slot.
    pub(crate) fn fetch(&mut self, ticket: Ticket) -> Result<Poll<usize>, Fault> {
        let slot = self.of(ticket).ok_or(Fault::JOB_LOST)?;
        match slot.state {
            State::Busy => Ok(Poll::Pending),
            State::Finished(result) => {
                slot.state = after(result);
                result.map(|()| Poll::Ready(usize::from(ticket.slot())))
            }
            State::Free | State::Cancelled | State::Broken => Err(Fault::JOB_LOST),
        }
    }

    /// The ticket's job is no longer needed.
    pub(crate) fn give_up(&mut self, ticket: Ticket) {
        let Some(slot) = self.of(ticket) else { return };
        slot.state = match slot.state {
            State::Busy => State::Cancelled,
            State::Finished(result) => after(result),
            other => other,
        };
    }

    /// Whether the ticket's job is under way and needed.
    pub(crate) fn awaited(&mut self, ticket: Ticket) -> bool {
        self.of(ticket).is_some_and(|slot| slot.state == State::Busy)
    }

    fn of(&mut self, ticket: Ticket) -> Option<&mut Slot> {
        let slot = self.0.get_mut(usize::from(ticket.slot()))?;
        (slot.round == ticket.round()).then_some(slot)
    }
}

/// The state of a slot after a cancelled job.
fn after(result: Result<(), Fault>) -> State {
    if result == Err(Fault::JOB_PANICKED) { State::Broken } else { State::Free }
}
