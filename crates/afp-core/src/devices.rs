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
///
/// `toolbox!` implements it for the devices that a toolbox declares. By hand, for a robot with one button:
///
/// ```
/// use afp_core::devices::{ControlId, ControlRow, DeviceRow, Devices, FaultId, find_control};
/// use std::convert::Infallible;
///
/// const GO: ControlRow = ControlRow { name: "go", help: "starts the robot", stops: false };
///
/// #[derive(Clone, Copy, Debug, PartialEq)]
/// enum Button {
///     Go,
/// }
///
/// struct Panel;
///
/// impl Devices for Panel {
///     const TABLE: &'static [DeviceRow] = &[DeviceRow {
///         name: "panel",
///         help: "the robot's buttons",
///         controls: &[GO],
///         faults: &[],
///         signals: &[],
///     }];
///     type Control = Button;
///     type Fault = Infallible;
///
///     fn control(id: ControlId) -> Option<Button> {
///         (id == ControlId(0)).then_some(Button::Go)
///     }
///
///     fn fault(_: FaultId, _: Option<f64>) -> Option<Infallible> {
///         None
///     }
/// }
///
/// let id = find_control(Panel::TABLE, "panel.go").expect("the table has it");
/// assert_eq!(Panel::control(id), Some(Button::Go));
/// ```
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
