//! Many runs of a plan in the simulator: over seeds, worlds and values, on all cores.
//!
//! A [`Sweep`] is a numbered grid of runs. Each is a pure function of its [`Row`], so that any of them can
//! be done again, anywhere, in any order. [`Engine::run`] does them and hands out [`Outcome`]s as they come; a
//! [`Journal`] keeps them, so that a sweep that was killed goes on where it was; [`Findings`] sums them up,
//! [`to_csv`] makes a table of them, and one for programs with the feature `parquet`. `afpc sweep` is thin over this.
//!
//! The plan need not come from a file: whoever has plans and simulations of his own gives the engine a
//! function that makes them.
#![forbid(unsafe_code)]

mod attend;
mod columns;
mod engine;
mod findings;
mod grid;
mod header;
mod journal;
mod outcome;
mod output_files;
mod ranges;
mod seeds;
mod setting;
mod table;

pub use columns::{Cells, Column, columns};
pub use engine::{Drive, Engine, Maker, Watch};
pub use findings::{Findings, Group, Measure, Spread, Touched, groups};
pub use grid::{Axis, Point, Row, Sweep, WorldChoice};
pub use header::{Header, Parts};
pub use journal::{Journal, JournalError};
pub use outcome::{Ending, Outcome};
pub use output_files::{Make, OutputFiles};
pub use ranges::{axis, seeds, worlds};
pub use seeds::Seeds;
pub use setting::Setting;
pub use table::to_csv;
#[cfg(feature = "parquet")]
pub use table::to_parquet;
