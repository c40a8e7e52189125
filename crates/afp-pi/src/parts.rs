//! Drivers of parts that only a computer has; [`afp_drive`] has those of its own pins.

mod hat;
mod pwm;

use std::fmt::Debug;
use std::io;

pub(crate) use hat::{Hat, STEPS};
pub(crate) use pwm::Pwm;

/// The error of a part.
pub(crate) fn broken(error: impl Debug) -> io::Error {
    io::Error::other(format!("{error:?}"))
}
