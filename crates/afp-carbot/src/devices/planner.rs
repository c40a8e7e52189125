//! Paths on the map, searched for by a job.

use crate::objects::Path;
use afp_core::quantity::Length;
use afp_core::{Fault, Instant, Poll, Ticket};

/// What a way is looked for between, in the frame of the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trip<'a> {
    /// Where it begins: x and y.
    pub from: (Length, Length),
    /// Where it leads.
    pub to: Aim<'a>,
}

/// Where a way leads, in the frame of the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Aim<'a> {
    /// To a place.
    Place {
        /// Its x and y.
        at: (Length, Length),
        /// A place so near to it will do where it is not free itself.
        near: Length,
    },
    /// To where much is in sight that has not been yet, and that is not far.
    View {
        /// From these places one has looked around.
        seen: &'a Path,
        /// So far one sees.
        sight: Length,
    },
}

/// Searches for ways on the map that the platform was given, and on what its sensors have found since. The search is a job
/// on a worker of the platform.
pub trait PathPlanner {
    /// Begins a search. None while all that can be searched for at a time is; ask again at the next poll.
    ///
    /// # Errors
    /// Searches have panicked.
    fn search(&mut self, trip: &Trip<'_>, now: Instant) -> Result<Option<Ticket>, Fault>;

    /// What a search has found, once; `None` inside where no way leads there.
    ///
    /// # Errors
    /// The search failed, or has been asked after before.
    fn found(&mut self, ticket: Ticket, now: Instant) -> Result<Poll<Option<Path>>, Fault>;
}
