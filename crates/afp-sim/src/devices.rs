//! The robot's devices: what each measures, and how it errs.
//!
//! Each is stepped with the physics and knows nothing of rapier but what it needs. Between a
//! sensor and the plan lies a [`afp_platform::Line`], which faults cut, delay or freeze.

pub(crate) mod battery;
pub(crate) mod bumper;
pub(crate) mod camera;
pub(crate) mod color;
pub(crate) mod infrared;
pub(crate) mod odometer;
pub(crate) mod rotator;
pub(crate) mod sonar;
