//! The battery.

use super::Reading;
use afp_core::quantity::Voltage;

/// How much the battery has left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Charge {
    /// At the terminals, under the load of the moment.
    pub voltage: Voltage,
    /// The share of a full charge that is left: 1 full, 0 empty.
    pub left: f64,
}

/// The battery with its gauge.
pub trait Battery {
    /// The charge.
    fn charge(&self) -> Reading<Charge>;
}
