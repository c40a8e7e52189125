//! What the robot's devices offer, one trait each.

mod battery;
mod buttons;
mod camera;
mod color_sensor;
mod flow;
mod infrared_sensor;
mod localisation;
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
pub use navigator::{Body, Navigator};
pub use odometry::{Bump, Motion, Odometry};
pub use planner::{Aim, PathPlanner, Trip};
pub use rotator::{RotatingTelemetry, Rotator};
pub use signals::Signals;
pub use touch_sensor::TouchSensor;
pub use ultrasonic::{Beam, Echo, Ultrasonic};
