//! The simulated Carbot: a planar world in virtual time; and its parts, for other robots.
//!
//! A [`World`] is read from TOML; a [`Simulation`] puts the robot into it and implements the
//! device traits of `afp-carbot`, so that templates cannot tell it from the real robot. What only
//! a judge may know (true pose, contacts, distance to the wall) is behind
//! [`Simulation::truth`], which no device trait reaches.
//!
//! The same world, seed, commands and instants give the same run, bit for bit, on every platform:
//! physics steps on its own grid of [`STEP`], rapier runs with its cross-platform determinism,
//! trigonometry goes through `libm`, and every noise has a stream of its own.
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
pub use chassis::{HALF_LENGTH, HALF_WIDTH};
pub use film::Film;
#[cfg(feature = "load")]
pub use load::carbot;
pub use simulation::{Bare, Simulation, Snapshot, Sonar};
pub use stage::{Collision, STEP};
pub use truth::{Pose, Truth};
pub use world::{World, WorldError};
