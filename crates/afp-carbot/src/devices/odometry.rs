//! Dead reckoning and its memory.

use super::{Motion, Reading};
use crate::helpers::trail::Trail;
use afp_core::Instant;

/// The robot's position when its bumper was pressed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bump {
    /// The position by odometry.
    pub at: Motion,
    /// Last time at which the bumper was pressed there.
    pub time: Instant,
}

/// Dead reckoning. It drifts with time and distance, uncorrected.
pub trait Odometry {
    /// The motion since the start.
    fn motion(&self) -> Reading<Motion>;

    /// The place of the last bump; `None` before the first or if the platform does not keep it. The
    /// platform keeps it because templates live only as long as their element, but the obstacle
    /// stays.
    fn last_bump(&self) -> Option<Bump> {
        None
    }

    /// The robot's recent path. By default it is empty, and templates then drive straight back.
    fn trail(&self) -> Trail {
        Trail::new()
    }
}
