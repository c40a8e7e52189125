//! Episodes of the Carbot for whoever learns to drive it: what a policy sees, what it does and what that is worth.
//!
//! Many episodes are stepped at once, on all cores, without Python between them. A [`Courses`] of one and of many compute the
//! same: an episode knows nothing of its neighbours.

mod batch;
mod course;
mod courses;
mod judge;
mod part;
mod pool;
mod score;
mod start;

pub use courses::Courses;
pub use judge::{Judge, target};
