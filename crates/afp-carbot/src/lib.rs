//! The Carbot: traits of its devices, and templates that use these traits.
//!
//! Templates access a robot only through these traits, so the simulator, the real robot and a
//! recorded run are interchangeable.
//!
//! Frames: x forward, y left, angles counter-clockwise, SI units. The body frame has its origin at
//! the turning centre.
//!
//! Three rules apply to every template:
//!
//! - An invalid or outdated reading never counts as free space. The template waits, and faults
//!   after [`guard::PATIENCE`] without a usable reading.
//! - A reading applies to the instant of its measurement. Odometry carries bearings and distances
//!   on.
//! - An actor that is ready has stopped the robot, so a finished actor is as safe as an interrupted
//!   one.
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
pub use helpers::{aside, guard, history, tracking, trail};
pub use objects::{Appearance, DistanceMap, Path};
pub use supervisors::{
    Blink, CheckBattery, CheckColor, CheckDistance, CheckDrivingLane, CheckEscapeButton,
    CheckEscapeButtonClick, CheckInfrared, CheckLine, CheckMotion, CheckProgress, CheckTouchSensor,
    CheckTouchSensorClick, MeasureDistance, MeasureLight, PlanPath,
};

/// Names that [`register!`] uses in other crates.
#[doc(hidden)]
pub mod __private {
    pub use {afp_core, afp_macros::register};
}
