//! The devices of a robot: their rows, what can be wrong between a sensor and the plan, and a robot's own types for both.

use afp_types::Duration;

pub use afp_types::devices::{
    AmountRow, ControlId, ControlRow, DeviceRow, FaultId, FaultRow, SignalId, SignalRow,
    SignalType, amount, controls, faults, find_control, find_fault, find_signal, find_stop,
    signals,
};

/// What can be wrong between a sensor and the plan: the faults that every sensor has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Defect {
    /// It repeats its last value as if it had just measured it.
    Frozen,
    /// It does not answer.
    Lost,
    /// It delivers what is no number.
    NotANumber,
    /// What it measures arrives so much later. The readings keep their times, so their age shows.
    Delayed(Duration),
    /// Each use takes so long.
    Slow(Duration),
}

/// The devices of a kind of robot.
pub trait Devices: 'static {
    /// The table.
    const TABLE: &'static [DeviceRow];
    /// What can be held down.
    type Control: Copy;
    /// What can be broken, and by how much.
    type Fault: Copy;

    /// The control of that number.
    fn control(id: ControlId) -> Option<Self::Control>;

    /// The fault of that number; without an amount, by as much as the table says. None for a number that is not
    /// there and an amount that is out of range.
    fn fault(id: FaultId, amount: Option<f64>) -> Option<Self::Fault>;
}
