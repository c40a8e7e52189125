//! What the robot's devices offer, one trait each.
//!
//! The list `devices!` below has the traits that templates ask for. [`Carbot`] and [`register!`](crate::register) follow
//! from it.
//!
//! A robot implements the traits of the devices that it has. Sensors answer with a [`Reading`]:
//!
//! ```
//! use afp_carbot::devices::{Invalid, Reading, TouchSensor};
//! use afp_core::Instant;
//!
//! struct Board {
//!     now: Instant,
//!     /// The bumper as the board reported it last, and when.
//!     bumper: Option<(bool, Instant)>,
//! }
//!
//! impl TouchSensor for Board {
//!     fn touched(&self) -> Reading<bool> {
//!         match self.bumper {
//!             Some((pressed, time)) => Reading::valid(pressed, time),
//!             None => Reading::invalid(Invalid::NotYet, self.now),
//!         }
//!     }
//! }
//! # let board = Board { now: Instant::ZERO, bumper: Some((true, Instant::ZERO)) };
//! # assert_eq!(board.touched().value, Ok(true));
//! ```

mod battery;
mod buttons;
mod camera;
mod color_sensor;
mod flow;
mod infrared_sensor;
mod localisation;
mod motion;
mod navigator;
mod odometry;
mod planner;
mod rotator;
mod signals;
mod touch_sensor;
mod ultrasonic;

pub use afp_core::{Invalid, Reading};
pub use battery::{Battery, Charge};
pub use buttons::{Button, Buttons};
pub use camera::{Camera, Frame, Lens};
pub use color_sensor::{Color, ColorSensor};
pub use flow::{Flow, FlowCamera, Grid, Shift};
pub use infrared_sensor::{Glow, InfraredSensor};
pub use localisation::{Belief, Localisation};
pub use motion::Motion;
pub use navigator::{Body, Navigator};
pub use odometry::{Bump, Odometry};
pub use planner::{Aim, PathPlanner, Trip};
pub use rotator::{RotatingTelemetry, Rotator};
pub use signals::Signals;
pub use touch_sensor::TouchSensor;
pub use ultrasonic::{Beam, Echo, Ultrasonic};

use afp_core::Environment;

/// Makes what follows from the list of devices; `$d` is a dollar sign, for the macro that it makes.
macro_rules! devices {
    ($d:tt $($device:ident),+) => {
        /// A robot with every device that the templates of the toolbox use.
        pub trait Carbot: Environment $(+ $device)+ {}

        impl<E: Environment $(+ $device)+ + ?Sized> Carbot for E {}

        /// Registers those templates of the toolbox for which a platform has the devices.
        ///
        /// `afp_carbot::register!(registry, Vacuum)` takes a registry of that platform, whose type must be concrete. A plan
        /// that uses another template is refused when it is loaded, with the traits of [`devices`](crate::devices) that the
        /// platform does not implement. [`templates::register`](crate::templates::register) is for platforms that have them
        /// all.
        #[macro_export]
        macro_rules! register {
            ($d registry:expr, $d platform:ty) => {
                $crate::__private::register!(
                    $crate::__private::afp_core,
                    "carbot.afp",
                    $crate,
                    $d registry,
                    $d platform,
                    [$($crate::devices::$device),+]
                )
            };
        }
    };
}

devices!($
    Navigator, Odometry, Ultrasonic, Rotator, RotatingTelemetry, TouchSensor, Buttons, InfraredSensor, ColorSensor,
    FlowCamera, Battery, Localisation, PathPlanner, Signals
);
