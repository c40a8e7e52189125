//! Parts that templates share: sensor timeouts, paths, turns, memory of positions.

pub(crate) mod approaching;
pub mod aside;
pub(crate) mod eye;
pub mod guard;
pub mod history;
pub(crate) mod line_fit;
pub(crate) mod motion;
pub(crate) mod own_motion;
pub(crate) mod pursuit;
pub(crate) mod repeats;
pub(crate) mod seeking;
pub(crate) mod sighting;
pub(crate) mod sweep;
pub mod tracking;
pub mod trail;
pub(crate) mod turning;
