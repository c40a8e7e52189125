//! Suites that run across the whole workspace, and what they share: a toolbox whose components
//! answer by script, the platform for it, and a driver that runs any plan on it.
//!
//! `run/*.afp` are the cases of the language: a plan, what happens to it, and the trace that must
//! come of it. Each runs through the interpreter and, compiled by this package's build script, as
//! generated Rust; both must print the same.

pub mod case;
pub mod compare;
mod components;
pub mod drive;
pub mod interpret;
mod names;
pub mod platform;
pub mod random;
pub mod random_script;
pub mod script;
pub mod state_chart;

pub use components::{Glance, MakeMap, Map, Pick, ReadMap, Stay, Task, Watch, Work};

/// The templates of `toolbox/testing.afp`.
pub mod templates {
    afp_macros::toolbox!("toolbox/testing.afp", robot = crate::platform::Platform);
}

/// The text of the toolbox.
pub const TOOLBOX: &str = include_str!("../toolbox/testing.afp");
