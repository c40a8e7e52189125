//! The vehicle: its body's measures, its wheels and the controller that drives them.

mod floor;
mod place;
mod two_wheels;

pub(crate) mod drive;
pub(crate) mod servo;
pub(crate) mod wheel;

pub use floor::{Demand, Footing, Motor, Push, Twist};
pub(crate) use place::Place;
pub use two_wheels::{TwoWheels, WheelModel};

/// Half the body's length, metres; the turning centre is its middle.
pub const HALF_LENGTH: f64 = 0.20;
/// Half the body's width, metres.
pub const HALF_WIDTH: f64 = 0.175;
/// Mass, kilograms.
pub(crate) const MASS: f64 = 4.7;
