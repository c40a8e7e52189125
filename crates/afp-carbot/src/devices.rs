//! The robot's devices, one trait each.
//!
//! The list `devices!` below has the traits that templates need. It generates [`Carbot`] and
//! [`register!`](crate::register).
//!
//! A robot implements the traits of its devices. Sensors answer with a [`Reading`]:
//!
//! ```
//! use afp_carbot::devices::{Invalid, Reading, TouchSensor};
//! use afp_core::Instant;
//!
//! struct Board {
//!     now: Instant,
//!     /// The board's last report of the bumper, and its time.
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

/// Generates code from the list of devices. `$d` is a dollar sign for the generated macro.
macro_rules! devices {
    ($d:tt $($device:ident),+) => {
        /// A robot with every device that the toolbox's templates use.
        pub trait Carbot: Environment $(+ $device)+ {}

        impl<E: Environment $(+ $device)+ + ?Sized> Carbot for E {}

        /// Registers the templates whose devices the platform has.
        ///
        /// `afp_carbot::register!(registry, Vacuum)` takes a registry of that platform, whose type
        /// must be concrete. Loading a plan that uses another template fails and names the missing
        /// traits of [`devices`](crate::devices). For platforms that have every device, use
        /// [`templates::register`](crate::templates::register).
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
