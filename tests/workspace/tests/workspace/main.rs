//! What holds between the crates of the workspace.

mod arrows;
mod errors;
mod rebuilds;
mod shared;
mod weight;
