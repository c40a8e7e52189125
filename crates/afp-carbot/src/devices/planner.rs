//! Path search on the map, as a job.

use crate::objects::Path;
use afp_core::quantity::Length;
use afp_core::{Fault, Instant, Poll, Ticket};

/// Start and goal of a path, in the map frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trip<'a> {
    /// Start: x and y.
    pub from: (Length, Length),
    /// The goal.
    pub to: Aim<'a>,
}

/// The goal of a path, in the map frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Aim<'a> {
    /// A place.
    Place {
        /// Its x and y.
        at: (Length, Length),
        /// If the place is not free, another place within this distance is accepted.
        near: Length,
    },
    /// A near place with much unseen space in sight.
    View {
        /// The robot has looked around at these places.
        seen: &'a Path,
        /// Range of sight.
        sight: Length,
    },
}

/// Searches for paths on the platform's map and on its sensors' findings. The search is a job on a
/// worker of the platform.
pub trait PathPlanner {
    /// Begins a search. `None` while the search queue is full; ask again at the next poll.
    ///
    /// # Errors
    /// A search has panicked.
    fn search(&mut self, trip: &Trip<'_>, now: Instant) -> Result<Option<Ticket>, Fault>;

    /// Returns the result of a search, once; the inner `None` means no path.
    ///
    /// # Errors
    /// The search failed, or its result was fetched before.
    fn found(&mut self, ticket: Ticket, now: Instant) -> Result<Poll<Option<Path>>, Fault>;
}
