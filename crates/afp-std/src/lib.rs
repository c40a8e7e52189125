//! The `std` toolbox: templates that need no robot, so they run on every platform.
#![no_std]
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod after;
mod changed;
mod check_timeout;
mod check_value;
mod every;
#[cfg(test)]
mod facts;
mod idle;
mod random;
mod since;
mod stopwatch;
mod wait;

pub use after::After;
pub use changed::Changed;
pub use check_timeout::CheckTimeout;
pub use check_value::CheckValue;
pub use every::Every;
pub use idle::Idle;
pub use random::Random;
pub use stopwatch::Stopwatch;
pub use wait::Wait;

/// Registers the templates on a platform, like the macros with this name in other toolboxes.
#[macro_export]
macro_rules! register {
    ($registry:expr, $platform:ty) => {
        $crate::templates::register::<$platform, _>($registry)
    };
}

pub mod templates {
    //! The templates of the toolbox as types: ports, states and events.
    afp_macros::toolbox!("std.afp");
}
