//! Real robots made of parts from a shop, driven by a Raspberry Pi or any other computer.
//!
//! `[robot]` in `afp.toml` describes the robot by a [profile](afp_project::Profile), so that
//! `afpc run --robot hardware` drives it without Rust. [`opener`] opens the robot of a profile.
//! [`Link`] is the computer's end of a serial line with frames of [`afp_wire`], for any messages.
//!
//! The control thread reads the line itself, without a lock and without memory from the allocator.
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg(unix)]

mod board;
mod calibration;
pub mod guard;
mod link;
mod parts;
mod port;
mod robot;
mod values;

pub use board::{PicarX, Pins, enable_line};
pub use calibration::{Found, FoundCar, Spin, Straight, solve, solve_car};
pub use link::{Heard, Link};
pub use robot::drives::{Calibrated, Drive, Halt, calibrated};
pub use robot::{
    Behind, JsonLine, Line, LocalLine, PicarXRobot, PinRobot, Reports, SerialCarbot, SerialRobot,
    Ugv, WireLine, opener,
};
