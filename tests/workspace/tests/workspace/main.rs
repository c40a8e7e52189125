//! Properties of the whole workspace.

mod arrows;
mod errors;
mod locks;
mod modules;
mod rebuilds;
mod shared;
mod sizes;
mod sources;
mod templates;
mod weight;
