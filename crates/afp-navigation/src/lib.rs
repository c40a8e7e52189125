//! Long computations for navigation: the optical flow of the camera, the robot's place on a map,
//! and paths on that map. Each is a job of a worker.
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod flow;
pub mod maps;
