//! The battery.

use super::Reading;
use afp_core::quantity::Voltage;

/// Charge of the battery.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Charge {
    /// At the terminals, under the current load.
    pub voltage: Voltage,
    /// Remaining share of a full charge: 1 full, 0 empty.
    pub left: f64,
}

/// A battery with its gauge.
pub trait Battery {
    /// The charge.
    fn charge(&self) -> Reading<Charge>;
}
