//! Maps: where the robot is on one, and which path leads where.
//!
//! ```text
//!   Map ──▶ EchoField: what the range sensor hears where
//!                │
//!   echoes with the odometry's poses ──copied──▶ LocateJob: Filter ──▶ Belief
//!     in Locator::on_echo                            on a worker        in Locator::belief
//! ```
//!
//! The filter is a particle filter with a fixed number of particles (Monte Carlo localisation: Thrun, Burgard and Fox,
//! *Probabilistic Robotics*, 2005, chapter 8). Echoes that the belief does not explain make it look for places that
//! explain them better and put particles there (sensor resetting: Lenser and Veloso, *Sensor resetting localization for
//! poorly modelled mobile robots*, ICRA 2000), so that a robot that was carried finds itself again.
//!
//! What the map does not explain of echoes and bumps, the [`Planner`] leads round:
//!
//! ```text
//!   Map ──▶ Grid: clearance of each cell       SearchJob: A* ──▶ Path
//!                │                               on a worker       in Planner::found
//!   echoes, bumps at believed poses ──▶ Finds ──copied──┘
//! ```
//!
//! The same search, on the same grid, finds from where to look around next: it ends where most of the floor comes in sight that has
//! not been.
//!
//! Nothing here knows a simulator: what is true reaches neither map nor filter.

mod field;
mod filter;
mod found;
mod grid;
mod locator;
mod map;
mod planner;
mod room;
mod search;
mod view;

pub use field::{EchoField, Expected};
pub use filter::{Filter, Ping};
pub use locator::{LocateJob, Locator};
pub use map::Map;
pub use planner::{Planner, SearchJob};
