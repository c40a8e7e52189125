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
    ApproachInfrared, ChooseView, Curve, DriveTo, FindObject, FollowObject, FollowPath, Forward,
    Hold, LearnObject, LookAround, Retrace, SearchWall, Signal, Stop, Turn, TurnToInfrared,
    WallForward,
};
pub use computations::{DescribeObject, NewPath, WidestGap};
pub use helpers::sighting::Sighting;
pub use helpers::{guard, history, tracking, trail};
pub use objects::{Appearance, DistanceMap, Path};
pub use supervisors::{
    CheckBattery, CheckColor, CheckDistance, CheckDrivingLane, CheckEscapeButton,
    CheckEscapeButtonClick, CheckInfrared, CheckLine, CheckMotion, CheckProgress, CheckTouchSensor,
    CheckTouchSensorClick, PlanPath,
};

/// What [`register!`] names in the crates of others.
#[doc(hidden)]
pub mod __private {
    pub use {afp_core, afp_macros::register};
}

use afp_core::Environment;
use devices::{Buttons, Navigator, Odometry, RotatingTelemetry, Rotator, TouchSensor, Ultrasonic};

/// Registers those templates of the toolbox for which a platform has the devices.
///
/// `afp_carbot::register!(registry, Vacuum)` takes a registry of that platform, whose type must be concrete. A plan
/// that uses another template is refused when it is loaded, with the traits of [`devices`] that the platform does not
/// implement. [`templates::register`] is for platforms that have them all.
#[macro_export]
macro_rules! register {
    ($registry:expr, $platform:ty) => {
        $crate::__private::register!(
            $crate::__private::afp_core,
            "carbot.afp",
            $crate,
            $registry,
            $platform,
            [
                $crate::devices::Navigator,
                $crate::devices::Odometry,
                $crate::devices::Ultrasonic,
                $crate::devices::Rotator,
                $crate::devices::RotatingTelemetry,
                $crate::devices::TouchSensor,
                $crate::devices::Buttons,
                $crate::devices::InfraredSensor,
                $crate::devices::ColorSensor,
                $crate::devices::FlowCamera,
                $crate::devices::Battery,
                $crate::devices::Localisation,
                $crate::devices::PathPlanner,
                $crate::devices::Signals,
            ]
        )
    };
}

/// A robot that can follow walls: every device that the templates of the toolbox use.
pub trait Carbot:
    Environment
    + Navigator
    + Odometry
    + Ultrasonic
    + Rotator
    + RotatingTelemetry
    + TouchSensor
    + Buttons
{
}

impl<E> Carbot for E where
    E: Environment
        + Navigator
        + Odometry
        + Ultrasonic
        + Rotator
        + RotatingTelemetry
        + TouchSensor
        + Buttons
        + ?Sized
{
}
