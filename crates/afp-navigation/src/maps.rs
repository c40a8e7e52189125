//! Maps: localisation on a map, and paths on it.
//!
//! ```text
//!   Map ──▶ EchoField: what the range sensor hears where
//!                │
//!   echoes with the odometry's poses ──copied──▶ LocateJob: Filter ──▶ Belief
//!     in Locator::on_echo                            on a worker        in Locator::belief
//! ```
//!
//! The filter is a particle filter with a fixed number of particles (Monte Carlo localisation:
//! Thrun, Burgard and Fox, *Probabilistic Robotics*, 2005, chapter 8). If the belief does not
//! explain the echoes, the filter searches for better places and puts particles there (sensor
//! resetting: Lenser and Veloso, *Sensor resetting localization for poorly modelled mobile robots*,
//! ICRA 2000). A carried robot finds itself again in this way.
//!
//! The [`Planner`] avoids obstacles that are missing on the map but found by echoes and bumps:
//!
//! ```text
//!   Map ──▶ Grid: clearance of each cell       SearchJob: A* ──▶ Path
//!                │                               on a worker       in Planner::found
//!   echoes, bumps at believed poses ──▶ Finds ──copied──┘
//! ```
//!
//! The same search on the same grid finds the next place to look around: it ends where most of the
//! unseen floor becomes visible.
//!
//! Nothing here depends on a simulator: neither map nor filter knows the ground truth.

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
