//! What holds between the crates of the workspace.

mod arrows;
mod errors;
mod modules;
mod rebuilds;
mod shared;
mod sizes;
mod sources;
mod templates;
mod weight;
