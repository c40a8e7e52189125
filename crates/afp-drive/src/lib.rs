//! The drive controller of a robot with two driven wheels: its messages and its decisions.
//!
//! The controller is a second computer in the robot, for example a Raspberry Pi Pico. It executes
//! driving commands and stops the robot by itself. This crate decides everything that the controller
//! does, without hardware, so that the same code runs in the controller's program and in tests. A
//! program for a board calls [`Controller::receive`] for each byte from the line and
//! [`Controller::step`] every [`STEP`]. It applies the [`Outputs`] to the motors and the servo, and
//! sends the bytes of [`Controller::transmit`]. [`parts`] has drivers of motors, encoders, switches and
//! range sensors.
//!
//! The life of a connection, with frames of [`afp_wire`]:
//!
//! 1. The computer sends a hello, [`Command::Setup`] and [`Command::Start`] until a [`Report`] says
//!    that the controller obeys.
//! 2. The computer repeats [`Command::Drive`] every 20 ms. The controller reports every [`REPORT`].
//! 3. The controller cuts the motors' power and obeys nothing before the next start after
//!    [`Command::Stop`], after [`COMMAND_TIMEOUT`](afp_wire::COMMAND_TIMEOUT) without a frame while
//!    it moves, and if another program says hello.
//!
//! ```
//! use afp_drive::{Command, Controller, Inputs, LONGEST, STEP, Setup, VERSION};
//! use afp_types::Instant;
//! use afp_wire::Sender;
//!
//! let (mut controller, mut computer) = (Controller::new(1), Sender::new(7, VERSION));
//! let mut now = Instant::ZERO;
//! let mut buffer = [0; LONGEST];
//! let mut hear = |frame: &[u8]| frame.iter().for_each(|byte| controller.receive(*byte, now));
//! hear(computer.hello(&mut buffer)?);
//! hear(computer.send(&Command::Setup(Setup::default()), &mut buffer)?);
//! hear(computer.send(&Command::Start, &mut buffer)?);
//! hear(computer.send(&Command::Drive { speed: 0.2, turn: 0.0 }, &mut buffer)?);
//!
//! now += STEP;
//! let [left, right] = controller.step(&Inputs::default(), now).power;
//! assert!(left > 0.0 && left == right);
//! # Ok::<(), afp_wire::TooLong>(())
//! ```
#![no_std]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

#[cfg(test)]
extern crate std;

mod controller;
mod messages;
mod odometry;
pub mod parts;
mod wheel;

use afp_types::Duration;

pub use controller::{Controller, Inputs, Outputs};
pub use messages::{Command, LONGEST, Ping, Report, Setup, VERSION};

/// The period of [`Controller::step`].
pub const STEP: Duration = Duration::from_millis(10);
/// The period of reports.
pub const REPORT: Duration = Duration::from_millis(20);
