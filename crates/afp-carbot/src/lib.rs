//! The Carbot: its devices as traits, and the templates written against them.
//!
//! Templates see a robot through these traits only, so the simulator, the real robot and a
//! recorded run are interchangeable.
//!
//! Frames: x forward, y left, angles counter-clockwise, SI units. The body's frame has its origin
//! at the turning centre.
//!
//! Two rules hold for every template here. A reading that is invalid or too old is never taken
//! for free space: the template waits, and faults when nothing usable came for
//! [`guard::PATIENCE`]. What a reading says holds for the instant at which it was measured: bearings and ways are
//! carried on from there by the odometry. And an actor that is ready has brought the robot to a standstill, so a
//! finished actor is as safe as an interrupted one.
#![no_std]
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

#[cfg(test)]
extern crate std;

mod actors;
mod computations;
pub mod devices;
mod helpers;
mod objects;
mod supervisors;
pub mod table;
pub mod templates;

#[cfg(test)]
mod fake;

pub use actors::{
    ApproachInfrared, ChooseView, Curve, Drive, DriveTo, FindObject, FollowObject, FollowPath,
    Forward, Hold, LearnObject, LookAround, Retrace, SearchWall, Signal, Stop, Turn,
    TurnToInfrared, WallForward,
};
pub use computations::{DescribeObject, NewPath, WidestGap};
pub use devices::Carbot;
pub use helpers::sighting::Sighting;
pub use helpers::{guard, history, tracking, trail};
pub use objects::{Appearance, DistanceMap, Path};
pub use supervisors::{
    Blink, CheckBattery, CheckColor, CheckDistance, CheckDrivingLane, CheckEscapeButton,
    CheckEscapeButtonClick, CheckInfrared, CheckLine, CheckMotion, CheckProgress, CheckTouchSensor,
    CheckTouchSensorClick, MeasureDistance, MeasureLight, PlanPath,
};

/// What [`register!`] names in the crates of others.
#[doc(hidden)]
pub mod __private {
    pub use {afp_core, afp_macros::register};
}
