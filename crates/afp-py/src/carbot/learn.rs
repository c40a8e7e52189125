//! Episodes of the Carbot for learning: observations, actions and rewards.
//!
//! Many episodes advance at once on all cores, without Python in between. The results do not depend
//! on the number of episodes in a [`Courses`], since episodes are independent.

mod batch;
mod course;
mod courses;
mod judge;
mod moment;
mod part;
mod pool;
mod score;
mod start;

pub use courses::Courses;
pub use judge::{Judge, target};
pub use moment::Moment;
