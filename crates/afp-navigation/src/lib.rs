//! Long computations that help a robot find its way: the flow of its camera's pictures, its place on a map, and
//! paths on that map. Each is a job of a worker.
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod flow;
pub mod maps;
