//! What the robot's devices offer, one trait each.

mod buttons;
mod navigator;
mod odometry;
mod reading;
mod rotator;
mod touch_sensor;
mod ultrasonic;

pub use buttons::{Button, Buttons};
pub use navigator::{Body, Navigator};
pub use odometry::{Motion, Odometry};
pub use reading::{Invalid, Reading};
pub use rotator::{RotatingTelemetry, Rotator};
pub use touch_sensor::TouchSensor;
pub use ultrasonic::{Beam, Echo, Ultrasonic};
