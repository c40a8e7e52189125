//! Many runs of a plan in the simulator: over seeds, worlds and values, on all cores.
//!
//! A [`Sweep`] is a numbered grid of runs. Each run is a pure function of its [`Row`], so any run
//! can be repeated anywhere and in any order. [`Engine::run`] executes runs and passes on
//! [`Outcome`]s. A [`Journal`] keeps them, so that a killed sweep resumes. [`Findings`] is the
//! summary. [`to_csv`] makes a table; the feature `parquet` adds a binary one. `afpc sweep` is a
//! thin layer over this crate.
//!
//! A plan without a file is possible: pass the engine a function that makes your sessions.
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
mod stimuli;
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
pub use stimuli::varies_stimuli;
pub use table::to_csv;
#[cfg(feature = "parquet")]
pub use table::to_parquet;
