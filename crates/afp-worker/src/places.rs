//! Who has which place of a worker: the same book for all workers.

use afp_core::{Duration, Fault, Instant, Poll, Ticket};

/// A finished job is kept this long for whoever began it: longer than any component waits between two
/// polls. After that its place may be taken.
const KEPT: Duration = Duration::from_secs(1);

/// What goes on at a place.
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
struct Place {
    state: State,
    /// Jobs that have been here.
    round: u64,
    /// When the last one came to its end.
    ended: Instant,
}

impl Place {
    /// Whether a job has panicked here.
    fn is_broken(&self) -> bool {
        self.state == State::Broken || self.state == State::Finished(Err(Fault::JOB_PANICKED))
    }
}

/// The places of a worker.
#[derive(Debug)]
pub(crate) struct Places(Vec<Place>);

impl Places {
    /// So many free places.
    ///
    /// # Panics
    /// With more than 65536 places.
    pub(crate) fn new(count: usize) -> Self {
        assert!(count <= usize::from(u16::MAX) + 1, "a worker has at most 65536 places");
        Places(vec![Place { state: State::Free, round: 0, ended: Instant::ZERO }; count])
    }

    /// Takes a place: a free one, else one whose finished job nobody has fetched in [`KEPT`]. None
    /// while there is none.
    ///
    /// # Errors
    /// All places are broken.
    pub(crate) fn take(&mut self, now: Instant) -> Result<Option<Ticket>, Fault> {
        if self.0.iter().all(Place::is_broken) {
            return Err(Fault::JOB_PANICKED);
        }
        let free = |place: &Place| place.state == State::Free;
        let stale = |place: &Place| {
            let finished = matches!(place.state, State::Finished(_)) && !place.is_broken();
            finished && now.since(place.ended) > KEPT
        };
        let found = self.0.iter().position(free).or_else(|| self.0.iter().position(stale));
        let Some(index) = found else { return Ok(None) };
        let place = &mut self.0[index];
        place.state = State::Busy;
        place.round += 1;
        Ok(Some(Ticket::new(index as u16, place.round)))
    }

    /// The job at a place has come to its end.
    pub(crate) fn finish(&mut self, index: u16, result: Result<(), Fault>, now: Instant) {
        let Some(place) = self.0.get_mut(usize::from(index)) else { return };
        place.ended = now;
        place.state = match place.state {
            State::Busy => State::Finished(result),
            _ => after(result),
        };
    }

    /// The place of a ticket's job, which is finished and gives up its place; pending while it is
    /// under way.
    ///
    /// # Errors
    /// The fault of the job; [`Fault::JOB_LOST`] if it is not here any more.
    pub(crate) fn fetch(&mut self, ticket: Ticket) -> Result<Poll<usize>, Fault> {
        let place = self.of(ticket).ok_or(Fault::JOB_LOST)?;
        match place.state {
            State::Busy => Ok(Poll::Pending),
            State::Finished(result) => {
                place.state = after(result);
                result.map(|()| Poll::Ready(usize::from(ticket.place())))
            }
            State::Free | State::Cancelled | State::Broken => Err(Fault::JOB_LOST),
        }
    }

    /// Nobody waits for a ticket's job any more.
    pub(crate) fn give_up(&mut self, ticket: Ticket) {
        let Some(place) = self.of(ticket) else { return };
        place.state = match place.state {
            State::Busy => State::Cancelled,
            State::Finished(result) => after(result),
            other => other,
        };
    }

    /// Whether somebody waits for the ticket's job, which is under way.
    pub(crate) fn awaited(&mut self, ticket: Ticket) -> bool {
        self.of(ticket).is_some_and(|place| place.state == State::Busy)
    }

    fn of(&mut self, ticket: Ticket) -> Option<&mut Place> {
        let place = self.0.get_mut(usize::from(ticket.place()))?;
        (place.round == ticket.round()).then_some(place)
    }
}

/// What becomes of a place whose job nobody waits for any more.
fn after(result: Result<(), Fault>) -> State {
    if result == Err(Fault::JOB_PANICKED) { State::Broken } else { State::Free }
}
