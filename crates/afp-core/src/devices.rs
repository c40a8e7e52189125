//! A robot's devices: their rows, the faults of every sensor, and the robot's own types for
//! controls and faults.

use afp_types::Duration;

pub use afp_types::devices::{
    AmountRow, ControlId, ControlRow, DeviceRow, FaultId, FaultRow, SignalId, SignalRow,
    SignalType, amount, controls, faults, find_control, find_fault, find_signal, find_stop,
    signals,
};

/// Faults of every sensor, injected between the sensor and the plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Defect {
    /// The sensor repeats its last value with new times.
    Frozen,
    /// The sensor does not answer.
    Lost,
    /// The sensor delivers NaN.
    NotANumber,
    /// Readings arrive late. They keep their times, so their age shows.
    Delayed(Duration),
    /// Each use takes this long.
    Slow(Duration),
}

/// The devices of a kind of robot.
///
/// `toolbox!` implements it for a toolbox's devices. By hand, for a robot with one button:
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
    /// The rows of the devices.
    const TABLE: &'static [DeviceRow];
    /// A control that can be held down.
    type Control: Copy;
    /// A fault that can be injected, with its amount.
    type Fault: Copy;

    /// Returns the control with this number.
    fn control(id: ControlId) -> Option<Self::Control>;

    /// Returns the fault with this number. The amount defaults to the table's. `None` for an
    /// unknown number or an amount out of range.
    fn fault(id: FaultId, amount: Option<f64>) -> Option<Self::Fault>;
}
