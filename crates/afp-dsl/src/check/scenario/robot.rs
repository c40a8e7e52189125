//! The robot's parts: devices, controls, faults, signals.
//!
//! They come from the plan's toolboxes and the robot's own.

use crate::check::Program;
use crate::index::{Recorder, Word};
use crate::toolbox::{Control, Device, Fault, Signal};
use afp_syntax::ast::Name;
use afp_syntax::diagnostics::{Arg, list};
use afp_syntax::source::Span;

pub(super) struct Robot<'a> {
    pub devices: Vec<&'a Device>,
}

/// A named part of a device.
pub(super) trait Row: Sized {
    fn rows(device: &Device) -> &[Self];
    fn name(&self) -> &str;
    /// Its declaration; `None` for an implicit part.
    fn span(&self) -> Option<Span>;
}

/// Result of a search.
pub(super) enum Found<'a, T> {
    /// A part of a device, and the number of names used.
    Row(&'a Device, &'a T, usize),
    /// Only a device, by the first name.
    Device(&'a Device),
    /// A first name that several devices have.
    Several(Vec<&'a Device>),
    Nothing,
}

impl<'a> Robot<'a> {
    /// The devices known to a program's plans.
    pub fn of(program: &'a Program<'_>) -> Robot<'a> {
        Robot { devices: program.toolboxes.devices(&program.linked) }
    }

    pub fn device(&self, name: &str) -> Option<&'a Device> {
        self.devices.iter().copied().find(|device| device.name == name)
    }

    /// Finds a device's part, or a part with a unique name.
    pub fn find<T: Row>(&self, names: &[Name]) -> Found<'a, T> {
        let Some(first) = names.first() else { return Found::Nothing };
        let device = self.device(&first.text);
        if let (Some(device), Some(second)) = (device, names.get(1)) {
            let row = T::rows(device).iter().find(|row| row.name() == second.text);
            return row.map_or(Found::Device(device), |row| Found::Row(device, row, 2));
        }
        let mut having = self.devices.iter().copied().filter_map(|device| {
            let row = T::rows(device).iter().find(|row| row.name() == first.text)?;
            Some((device, row))
        });
        match (having.next(), having.next(), device) {
            (Some((device, row)), None, _) => Found::Row(device, row, 1),
            (Some((one, _)), Some((two, _)), _) => {
                let more = having.map(|(device, _)| device);
                Found::Several([one, two].into_iter().chain(more).collect())
            }
            (None, _, Some(device)) => Found::Device(device),
            (None, _, None) => Found::Nothing,
        }
    }

    /// All names of a kind: unqualified if unique.
    pub fn words<T: Row>(&self) -> Vec<String> {
        let rows = || {
            self.devices
                .iter()
                .flat_map(|device| T::rows(device).iter().map(move |row| (device, row)))
        };
        let alone = |row: &T| rows().filter(|(_, other)| other.name() == row.name()).count() == 1;
        let word = |(device, row): (&&Device, &T)| match alone(row) {
            true => row.name().to_owned(),
            false => format!("{}.{}", device.name, row.name()),
        };
        rows().map(word).collect()
    }

    /// Records the names of a part, and returns the rest.
    pub fn record<'n, T: Row>(&self, names: &'n [Name], record: &Recorder) -> &'n [Name] {
        let of_row = |name: &Name, row: &T| match row.span() {
            Some(span) => record.definition(name.span, span),
            None => record.word(name.span, Word::Fault),
        };
        match (self.find::<T>(names), names) {
            (Found::Row(_, row, 1), [name, rest @ ..]) => {
                of_row(name, row);
                rest
            }
            (Found::Row(device, row, _), [home, name, rest @ ..]) => {
                record.definition(home.span, device.span);
                of_row(name, row);
                rest
            }
            (Found::Device(device), [home, rest @ ..]) => {
                record.definition(home.span, device.span);
                rest
            }
            (Found::Several(devices), [name, rest @ ..]) => {
                let rows = devices.iter().filter_map(|device| {
                    T::rows(device).iter().find(|row| row.name() == name.text)?.span()
                });
                record.several(name.span, rows);
                rest
            }
            (_, names) => names,
        }
    }
}

/// Qualified names of a part that several devices have, for messages.
pub(super) fn with_devices(devices: &[&Device], name: &str) -> Arg {
    let full: Vec<_> = devices.iter().map(|device| format!("{}.{name}", device.name)).collect();
    list(full.iter().map(String::as_str), "or")
}

impl Row for Control {
    fn rows(device: &Device) -> &[Control] {
        &device.controls
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn span(&self) -> Option<Span> {
        Some(self.span)
    }
}

impl Row for Fault {
    fn rows(device: &Device) -> &[Fault] {
        &device.faults
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn span(&self) -> Option<Span> {
        self.span
    }
}

impl Row for Signal {
    fn rows(device: &Device) -> &[Signal] {
        &device.signals
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn span(&self) -> Option<Span> {
        Some(self.span)
    }
}
