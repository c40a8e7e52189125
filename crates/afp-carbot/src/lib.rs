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

mod appearance;
mod approach_infrared;
mod approaching;
mod check_battery;
mod check_color;
mod check_distance;
mod check_driving_lane;
mod check_escape_button;
mod check_escape_button_click;
mod check_infrared;
mod check_line;
mod check_motion;
mod check_progress;
mod check_touch_sensor;
mod check_touch_sensor_click;
mod choose_view;
mod curve;
mod describe_object;
pub mod devices;
mod distance_map;
mod drive_to;
mod eye;
mod find_object;
mod follow_object;
mod follow_path;
mod forward;
pub mod guard;
pub mod history;
mod hold;
mod learn_object;
mod line_fit;
mod look_around;
mod motion;
mod new_path;
mod own_motion;
mod path;
mod plan_path;
mod press;
mod pursuit;
mod repeats;
mod retrace;
mod search_wall;
mod seeking;
mod sighting;
mod signal;
mod stop;
mod sweep;
pub mod table;
pub mod templates {
    //! The templates of the toolbox as types: ports, states and events.
    use crate::devices::{
        Battery, ColorSensor, FlowCamera, InfraredSensor, Localisation, PathPlanner, Signals,
    };

    afp_macros::toolbox!("carbot.afp",
        robot: crate::Carbot + Battery + ColorSensor + FlowCamera + InfraredSensor + Localisation + PathPlanner + Signals
    );
}
pub mod tracking;
pub mod trail;
mod turn;
mod turn_to_infrared;
mod turning;
mod wall_forward;
mod widest_gap;

#[cfg(test)]
mod fake;

pub use appearance::Appearance;
pub use approach_infrared::ApproachInfrared;
pub use check_battery::CheckBattery;
pub use check_color::CheckColor;
pub use check_distance::CheckDistance;
pub use check_driving_lane::CheckDrivingLane;
pub use check_escape_button::CheckEscapeButton;
pub use check_escape_button_click::CheckEscapeButtonClick;
pub use check_infrared::CheckInfrared;
pub use check_line::CheckLine;
pub use check_motion::CheckMotion;
pub use check_progress::CheckProgress;
pub use check_touch_sensor::CheckTouchSensor;
pub use check_touch_sensor_click::CheckTouchSensorClick;
pub use choose_view::ChooseView;
pub use curve::Curve;
pub use describe_object::DescribeObject;
pub use distance_map::DistanceMap;
pub use drive_to::DriveTo;
pub use find_object::FindObject;
pub use follow_object::FollowObject;
pub use follow_path::FollowPath;
pub use forward::Forward;
pub use hold::Hold;
pub use learn_object::LearnObject;
pub use look_around::LookAround;
pub use new_path::NewPath;
pub use path::Path;
pub use plan_path::PlanPath;
pub use retrace::Retrace;
pub use search_wall::SearchWall;
pub use sighting::Sighting;
pub use signal::Signal;
pub use stop::Stop;
pub use turn::Turn;
pub use turn_to_infrared::TurnToInfrared;
pub use wall_forward::WallForward;
pub use widest_gap::WidestGap;

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
