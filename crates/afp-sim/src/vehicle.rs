//! The vehicle: its wheels and the controller that drives them.

mod floor;
mod place;
mod two_wheels;

pub(crate) mod drive;
pub(crate) mod servo;
pub(crate) mod wheel;

pub use floor::{Demand, Footing, Motor, Push, Twist};
pub(crate) use place::Place;
pub use two_wheels::{TwoWheels, WheelModel};
