//! Dead reckoning and its memory.

use super::{Motion, Reading};
use crate::helpers::trail::Trail;
use afp_core::Instant;

/// Where the robot was when its bumper was pressed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bump {
    /// By the odometry.
    pub at: Motion,
    /// When it was last pressed there.
    pub time: Instant,
}

/// Dead reckoning. It drifts with time and way; nothing corrects it.
pub trait Odometry {
    /// The motion counted so far.
    fn motion(&self) -> Reading<Motion>;

    /// Where the bumper was last pressed; none before, or where nobody keeps it. Templates last for an element of a plan,
    /// what was met stays where it is: so the platform keeps it.
    fn last_bump(&self) -> Option<Bump> {
        None
    }

    /// The way by which the robot came; nothing is known where nobody keeps it, and then what goes back goes straight back.
    fn trail(&self) -> Trail {
        Trail::new()
    }
}
