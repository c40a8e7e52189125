//! Which job is at which slot of a worker, for every kind of worker alike.

use afp_core::{Duration, Fault, Instant, Poll, Ticket};

/// A finished job is kept this long for whoever began it: longer than any component waits between two
/// polls. After that its slot may be taken.
const KEPT: Duration = Duration::from_secs(1);

/// What goes on at a slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// Nobody needs it.
    Free,
    /// A job is under way.
    Busy,
    /// A job is under way that nobody waits for any more.
    Cancelled,
    /// A job is finished and waits to be fetched.
    Finished(Result<(), Fault>),
    /// A job has panicked here.
    Broken,
}

#[derive(Clone, Copy, Debug)]
struct Slot {
    state: State,
    /// Jobs that have been here.
    round: u64,
    /// When the last one came to its end.
    ended: Instant,
}

impl Slot {
    /// Whether a job has panicked here.
    fn is_broken(&self) -> bool {
        self.state == State::Broken || self.state == State::Finished(Err(Fault::JOB_PANICKED))
    }
}

/// The slots of a worker.
#[derive(Clone, Debug)]
pub(crate) struct Slots(Vec<Slot>);

impl Slots {
    /// So many free slots.
    ///
    /// # Panics
    /// With more than 65536 slots.
    pub(crate) fn new(count: usize) -> Self {
        assert!(count <= usize::from(u16::MAX) + 1, "a worker has at most 65536 slots");
        Slots(vec![Slot { state: State::Free, round: 0, ended: Instant::ZERO }; count])
    }

    /// Takes a slot: a free one, else one whose finished job nobody has fetched in [`KEPT`]. None
    /// while there is none.
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

    /// The job at a slot has come to its end.
    pub(crate) fn finish(&mut self, index: u16, result: Result<(), Fault>, now: Instant) {
        let Some(slot) = self.0.get_mut(usize::from(index)) else { return };
        slot.ended = now;
        slot.state = match slot.state {
            State::Busy => State::Finished(result),
            _ => after(result),
        };
    }

    /// The slot of a ticket's job, which is finished and gives up its slot; pending while it is
    /// under way.
    ///
    /// # Errors
    /// The fault of the job; [`Fault::JOB_LOST`] if it is not here any more.
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

    /// Nobody waits for a ticket's job any more.
    pub(crate) fn give_up(&mut self, ticket: Ticket) {
        let Some(slot) = self.of(ticket) else { return };
        slot.state = match slot.state {
            State::Busy => State::Cancelled,
            State::Finished(result) => after(result),
            other => other,
        };
    }

    /// Whether somebody waits for the ticket's job, which is under way.
    pub(crate) fn awaited(&mut self, ticket: Ticket) -> bool {
        self.of(ticket).is_some_and(|slot| slot.state == State::Busy)
    }

    fn of(&mut self, ticket: Ticket) -> Option<&mut Slot> {
        let slot = self.0.get_mut(usize::from(ticket.slot()))?;
        (slot.round == ticket.round()).then_some(slot)
    }
}

/// What becomes of a slot whose job nobody waits for any more.
fn after(result: Result<(), Fault>) -> State {
    if result == Err(Fault::JOB_PANICKED) { State::Broken } else { State::Free }
}
