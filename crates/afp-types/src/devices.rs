//! The devices of a robot as a table: what can be pressed, how it can fail, what it signals.
//!
//! Command line, scenarios, Python, logs and help read these rows; nobody but a robot's own crate names a
//! device. Controls, faults and signals are numbered through the whole table, in its order.

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
    /// Its name.
    pub name: &'static str,
    /// What it is, for people.
    pub help: &'static str,
    /// What can be pressed on it.
    pub controls: &'static [ControlRow],
    /// How it can fail.
    pub faults: &'static [FaultRow],
    /// What it says.
    pub signals: &'static [SignalRow],
}

/// Something that can be held down and let go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlRow {
    /// Its name.
    pub name: &'static str,
    /// What it is, for people.
    pub help: &'static str,
    /// Whether it is there to end what runs; the Escape key of a terminal presses it.
    pub stops: bool,
}

/// A way in which a device can fail.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaultRow {
    /// Its name.
    pub name: &'static str,
    /// How much of it there can be.
    pub amount: Option<AmountRow>,
    /// What happens, for people.
    pub help: &'static str,
}

/// How much of a fault there is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AmountRow {
    /// Its name.
    pub name: &'static str,
    /// The SI unit: `s`, or empty for a plain number.
    pub unit: &'static str,
    /// What is taken where nothing is said.
    pub default: f64,
    /// The least.
    pub from: f64,
    /// The greatest.
    pub to: f64,
}

/// Something that a device says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignalRow {
    /// Its name.
    pub name: &'static str,
    /// What its values are.
    pub ty: SignalType,
    /// Whether only a judge may know it.
    pub truth: bool,
    /// What it says, for people.
    pub help: &'static str,
}

/// What the values of a signal are. `U` says what a number measures: an SI unit, empty for none, or a dimension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SignalType<U = &'static str> {
    /// A truth value.
    Bool,
    /// A whole number.
    Int,
    /// A number or a quantity.
    Float(U),
    /// A text.
    Text,
    /// Where one frame stands in another.
    Pose,
    /// What a range sensor heard.
    Range,
    /// A picture.
    Image,
    /// The outline of something that moves.
    Outline,
}

impl SignalType {
    /// The SI unit of its numbers; empty for plain ones and for what is none.
    pub fn unit(self) -> &'static str {
        match self {
            SignalType::Float(unit) => unit,
            _ => "",
        }
    }

    /// Its word in a toolbox; `float` for all numbers.
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
    /// The amount that is meant; none where it is out of range.
    pub fn checked(&self, amount: Option<f64>) -> Option<f64> {
        let amount = amount.unwrap_or(self.default);
        (self.from <= amount && amount <= self.to).then_some(amount)
    }
}

/// How much of a fault is meant, zero of one of which there is no more or less; none where there is no such
/// fault, or not so much of it.
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

/// A control by its words: `touch.left`, or `left` where one control alone is called so.
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

/// The control that is there to end what runs.
pub fn find_stop(table: &[DeviceRow]) -> Option<ControlId> {
    controls(table).find(|(_, _, row)| row.stops).map(|(id, ..)| id)
}

/// A fault by its device and its own name.
pub fn find_fault(table: &[DeviceRow], device: &str, name: &str) -> Option<FaultId> {
    let mut all = faults(table);
    all.find(|(_, at, row)| at.name == device && row.name == name).map(|(id, ..)| id)
}

/// A signal by its device and its own name.
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
    fn numbers_go_through_the_whole_table() {
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
