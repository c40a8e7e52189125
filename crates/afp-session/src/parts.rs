//! Parts of simulated robots, for whoever writes one: the line from a sensor to the plan with its faults, noise, a
//! clock that knows slow devices, a floor drawn with letters.

mod clock;
mod grid;
mod line;
mod noise;

pub use clock::VirtualClock;
pub use grid::{Contact, Grid};
pub use line::Line;
pub use noise::Noise;
