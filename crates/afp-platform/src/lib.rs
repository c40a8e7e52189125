//! Parts for authors of robots: [`RealTime`] and [`open_device`] for real robots, workers for the
//! [`Job`]s of components, and for simulated robots a sensor's [`Line`] to the plan, [`Noise`], a
//! [`VirtualClock`] and a [`Grid`] as a world.
//!
//! A real robot implements [`Hardware`] and the traits that its templates need. A project names it
//! in `[robot.hardware]`; then `afpc run --robot hardware` and the programs of `afpc build` drive
//! it.
//!
//! ```
//! use afp_core::{Environment, Instant, Platform};
//! use afp_platform::RealTime;
//!
//! struct Board { time: RealTime, /* and its connection */ }
//!
//! impl Environment for Board {
//!     fn stop(&mut self, _: Instant) { /* stops the wheels */ }
//!     fn emergency_stop(&mut self) { /* cuts their power */ }
//! }
//!
//! impl Platform for Board {
//!     type Clock = RealTime;
//!     fn clock(&self) -> RealTime { self.time }
//!     fn now(&self) -> Instant { self.time.now() }
//!     fn advance(&mut self, to: Instant) { self.time.sleep_until(to) }
//! }
//! # let mut board = Board { time: RealTime::start() };
//! # let to = board.now() + afp_core::Duration::from_millis(2);
//! # board.advance(to);
//! # assert!(board.now() >= to);
//! ```
//!
//! [`Job`]: afp_core::Job
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod device;
mod grid;
mod line;
mod noise;
mod real_time;
mod virtual_clock;
mod worker;

pub use afp_session::{Hardware, LastResort, Robot, SampleRef, Samples, Settings};
pub use device::{open_device, release_device};
pub use grid::{Contact, Grid};
pub use line::Line;
pub use noise::Noise;
pub use real_time::RealTime;
pub use virtual_clock::VirtualClock;
pub use worker::{ThreadWorker, VirtualWorker};
