//! Paths on the map, searched for by a job.

use crate::path::Path;
use afp_core::quantity::Length;
use afp_core::{Fault, Instant, Poll, Ticket};

/// What a way is looked for between, in the frame of the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trip {
    /// Where it begins: x and y.
    pub from: (Length, Length),
    /// Where it leads.
    pub to: (Length, Length),
    /// A place so near to that will do where it is not free itself.
    pub near: Length,
}

/// Searches for ways on the map that the platform was given, and on what its sensors have found since. The search is a job
/// on a worker of the platform.
pub trait PathPlanner {
    /// Begins a search. None while all that can be searched for at a time is; ask again at the next poll.
    ///
    /// # Errors
    /// Searches have panicked.
    fn search(&mut self, trip: &Trip, now: Instant) -> Result<Option<Ticket>, Fault>;

    /// What a search has found, once; `None` inside where no way leads there.
    ///
    /// # Errors
    /// The search failed, or has been asked after before.
    fn found(&mut self, ticket: Ticket, now: Instant) -> Result<Poll<Option<Path>>, Fault>;
}
