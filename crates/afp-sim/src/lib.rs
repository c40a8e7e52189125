//! The simulated Carbot: a planar world in virtual time, and parts for other robots.
//!
//! A [`World`] is read from TOML. A [`Simulation`] puts the robot into it and implements the device
//! traits of `afp-carbot`, so that templates cannot distinguish it from the real robot. The ground
//! truth (pose, contacts, distance to the wall) is only available through [`Simulation::truth`],
//! which no device trait exposes.
//!
//! The same world, seed, commands and instants give the same run, bit for bit, on every platform.
//! Physics steps on a fixed grid of [`STEP`], rapier runs with its cross-platform determinism,
//! trigonometry uses `libm`, and every noise has its own stream.
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod chassis;
mod devices;
mod film;
#[cfg(feature = "load")]
mod load;
mod noise;
pub mod parts;
mod scene;
mod simulation;
mod stage;
mod truth;
mod vehicle;
pub mod world;

pub use afp_carbot::table::{Defect, Fault};
pub use afp_platform::VirtualClock;
pub use chassis::{HALF_LENGTH, HALF_WIDTH, Measures};
pub use film::Film;
#[cfg(feature = "load")]
pub use load::carbot;
pub use simulation::{Bare, Simulation, Snapshot, Sonar};
pub use stage::{Collision, STEP};
pub use truth::{Pose, Truth};
pub use world::{World, WorldError};
