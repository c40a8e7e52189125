//! The robot's devices, their measurements and their errors.
//!
//! Each device is stepped with the physics and knows only the necessary parts of rapier. Between a
//! sensor and the plan is a [`afp_platform::Line`], which faults cut, delay or freeze.

pub(crate) mod battery;
pub(crate) mod bumper;
pub(crate) mod camera;
pub(crate) mod color;
pub(crate) mod infrared;
pub(crate) mod odometer;
pub(crate) mod rotator;
pub(crate) mod sonar;
