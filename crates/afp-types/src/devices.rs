//! A robot's devices as a table: controls, faults, signals.
//!
//! The command line, scenarios, Python, logs and help read these rows; only a robot's own crate
//! names devices. Controls, faults and signals are numbered through the whole table, in its order.

/// A control of a robot, by its number in the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ControlId(pub u16);

/// A fault of a robot's devices, by its number in the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FaultId(pub u16);

/// A signal of a robot, by its number in the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SignalId(pub u16);

/// A device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeviceRow {
    /// The name.
    pub name: &'static str,
    /// A description for users.
    pub help: &'static str,
    /// The controls.
    pub controls: &'static [ControlRow],
    /// The faults.
    pub faults: &'static [FaultRow],
    /// The signals.
    pub signals: &'static [SignalRow],
}

/// A control that can be pressed and released.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlRow {
    /// The name.
    pub name: &'static str,
    /// A description for users.
    pub help: &'static str,
    /// Whether it stops the plan; the Escape key of a terminal presses it.
    pub stops: bool,
}

/// A failure of a device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaultRow {
    /// The name.
    pub name: &'static str,
    /// The severity, if it varies.
    pub amount: Option<AmountRow>,
    /// The effect, for users.
    pub help: &'static str,
}

/// The severity of a fault.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AmountRow {
    /// The name.
    pub name: &'static str,
    /// The SI unit: `s`, or empty for a plain number.
    pub unit: &'static str,
    /// The default.
    pub default: f64,
    /// The minimum.
    pub from: f64,
    /// The maximum.
    pub to: f64,
}

/// A signal of a device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignalRow {
    /// The name.
    pub name: &'static str,
    /// The type of its values.
    pub ty: SignalType,
    /// Whether it is ground truth, which only a judge may read.
    pub truth: bool,
    /// A description for users.
    pub help: &'static str,
}

/// The type of a signal's values. `U` is the unit of a number: an SI unit, empty for none, or a
/// dimension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SignalType<U = &'static str> {
    /// A truth value.
    Bool,
    /// A whole number.
    Int,
    /// A number or a quantity.
    Float(U),
    /// A string.
    Text,
    /// The pose of one frame in another.
    Pose,
    /// A range sensor's reading.
    Range,
    /// A picture.
    Image,
    /// The outline of a moving object.
    Outline,
}

impl SignalType {
    /// The SI unit of its numbers; empty for plain numbers and other types.
    pub fn unit(self) -> &'static str {
        match self {
            SignalType::Float(unit) => unit,
            _ => "",
        }
    }

    /// The keyword in a toolbox; `float` for all numbers.
    pub fn word(self) -> &'static str {
        match self {
            SignalType::Bool => "bool",
            SignalType::Int => "int",
            SignalType::Float(_) => "float",
            SignalType::Text => "string",
            SignalType::Pose => "pose",
            SignalType::Range => "range",
            SignalType::Image => "image",
            SignalType::Outline => "outline",
        }
    }
}

impl AmountRow {
    /// The amount or its default; `None` if out of range.
    pub fn checked(&self, amount: Option<f64>) -> Option<f64> {
        let amount = amount.unwrap_or(self.default);
        (self.from <= amount && amount <= self.to).then_some(amount)
    }
}

/// The amount of a fault or its default, zero for a fault without an amount. `None` for an unknown
/// fault or an amount out of range.
pub fn amount(table: &[DeviceRow], id: FaultId, amount: Option<f64>) -> Option<f64> {
    let (_, _, row) = faults(table).find(|(known, ..)| *known == id)?;
    match (row.amount, amount) {
        (Some(of), amount) => of.checked(amount),
        (None, None) => Some(0.0),
        (None, Some(_)) => None,
    }
}

/// The controls of a table with their devices.
pub fn controls(table: &[DeviceRow]) -> impl Iterator<Item = (ControlId, &DeviceRow, &ControlRow)> {
    let all = table.iter().flat_map(|device| device.controls.iter().map(move |row| (device, row)));
    (0..).zip(all).map(|(id, (device, row))| (ControlId(id), device, row))
}

/// The faults of a table with their devices.
pub fn faults(table: &[DeviceRow]) -> impl Iterator<Item = (FaultId, &DeviceRow, &FaultRow)> {
    let all = table.iter().flat_map(|device| device.faults.iter().map(move |row| (device, row)));
    (0..).zip(all).map(|(id, (device, row))| (FaultId(id), device, row))
}

/// The signals of a table with their devices.
pub fn signals(table: &[DeviceRow]) -> impl Iterator<Item = (SignalId, &DeviceRow, &SignalRow)> {
    let all = table.iter().flat_map(|device| device.signals.iter().map(move |row| (device, row)));
    (0..).zip(all).map(|(id, (device, row))| (SignalId(id), device, row))
}

/// Finds a control by name: `touch.left`, or `left` if this name is unique.
pub fn find_control(table: &[DeviceRow], words: &str) -> Option<ControlId> {
    let of_device = words.split_once('.').and_then(|(device, name)| {
        controls(table).find(|(_, at, row)| at.name == device && row.name == name)
    });
    if let Some((id, ..)) = of_device {
        return Some(id);
    }
    let mut named = controls(table).filter(|(_, _, row)| row.name == words);
    let (id, ..) = named.next()?;
    named.next().is_none().then_some(id)
}

/// Finds the control that stops the plan.
pub fn find_stop(table: &[DeviceRow]) -> Option<ControlId> {
    controls(table).find(|(_, _, row)| row.stops).map(|(id, ..)| id)
}

/// Finds a fault by its device and name.
pub fn find_fault(table: &[DeviceRow], device: &str, name: &str) -> Option<FaultId> {
    let mut all = faults(table);
    all.find(|(_, at, row)| at.name == device && row.name == name).map(|(id, ..)| id)
}

/// Finds a signal by its device and name.
pub fn find_signal(table: &[DeviceRow], device: &str, name: &str) -> Option<SignalId> {
    let mut all = signals(table);
    all.find(|(_, at, row)| at.name == device && row.name == name).map(|(id, ..)| id)
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn control(name: &'static str) -> ControlRow {
        ControlRow { name, help: "", stops: false }
    }

    const TABLE: &[DeviceRow] = &[
        DeviceRow {
            name: "bumper",
            help: "",
            controls: &[control("left"), control("right")],
            faults: &[FaultRow { name: "lost", amount: None, help: "" }],
            signals: &[],
        },
        DeviceRow {
            name: "panel",
            help: "",
            controls: &[control("start"), control("left")],
            faults: &[FaultRow { name: "lost", amount: None, help: "" }],
            signals: &[SignalRow { name: "lit", ty: SignalType::Bool, truth: false, help: "" }],
        },
    ];

    #[test]
    fn numbers_continue_through_the_whole_table() {
        for (words, id) in [
            ("bumper.left", Some(0)),
            ("right", Some(1)),
            ("start", Some(2)),
            ("panel.left", Some(3)),
            ("left", None),
            ("panel.right", None),
            ("", None),
        ] {
            assert_eq!(find_control(TABLE, words), id.map(ControlId), "{words}");
        }
        assert_eq!(find_fault(TABLE, "panel", "lost"), Some(FaultId(1)));
        assert_eq!(find_fault(TABLE, "panel", "frozen"), None);
        assert_eq!(find_signal(TABLE, "panel", "lit"), Some(SignalId(0)));
    }

    #[test]
    fn amounts_have_bounds() {
        let slip = AmountRow { name: "share", unit: "", default: 0.5, from: 0.0, to: 1.0 };
        assert_eq!(slip.checked(None), Some(0.5));
        assert_eq!(slip.checked(Some(1.0)), Some(1.0));
        for wrong in [1.5, -0.1, f64::NAN] {
            assert_eq!(slip.checked(Some(wrong)), None, "{wrong}");
        }
    }
}
