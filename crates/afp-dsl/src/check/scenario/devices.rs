//! Pressed controls and injected faults of scenarios.

use super::Checker;
use super::robot::{Found, Robot, with_devices};
use crate::check::names::unknown;
use crate::check::range;
use crate::scenario::{Failure, Part};
use crate::toolbox::{Control, Device, Fault};
use crate::types::Type;
use afp_syntax::ast::{Bind, Path};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Words, list};
use afp_syntax::message;

impl Checker<'_> {
    pub(super) fn control(&self, path: &Path, diags: &mut Diagnostics) -> Option<Part> {
        let names = path.names();
        let written = path.text();
        let error = match self.robot.find::<Control>(&names) {
            Found::Row(device, control, used) if used == names.len() => {
                return Some(Part::new(&device.name, &control.name));
            }
            Found::Several(devices) => {
                let message = message!("several devices have a control '{}'", written);
                let help = message!("write {}", with_devices(&devices, &written));
                Diagnostic::new(Code::E0606, path.span(), message).help(help)
            }
            Found::Device(device) if names.len() == 1 && !device.controls.is_empty() => {
                let message = message!("the control of '{}' is missing", written);
                let named = device.controls.iter().map(|it| format!("{written}.{}", it.name));
                let named: Vec<_> = named.collect();
                let help = message!("write {}", list(named.iter().map(String::as_str), "or"));
                Diagnostic::new(Code::E0606, path.span(), message).help(help)
            }
            _ => {
                let message = message!("the robot has no '{}' that can be pressed", written);
                let known = self.robot.words::<Control>();
                let known = known.iter().map(String::as_str);
                unknown(Code::E0606, path.span(), message, &written, known, NOTHING)
            }
        };
        diags.push(error);
        None
    }

    /// The fault with its amount.
    pub(super) fn failure(
        &self,
        path: &Path,
        binds: &[Bind],
        diags: &mut Diagnostics,
    ) -> Option<Failure> {
        let (device, fault) = match broken(self.robot, path) {
            Ok(found) => found,
            Err(error) => {
                diags.push(*error);
                return None;
            }
        };
        let amount = self.amount(fault, binds, diags)?;
        Some(Failure { fault: Part::new(&device.name, &fault.name), amount })
    }

    /// The amount of a fault, if given.
    fn amount(
        &self,
        fault: &Fault,
        binds: &[Bind],
        diags: &mut Diagnostics,
    ) -> Option<Option<f64>> {
        let mut amount = None;
        for bind in binds {
            let port = bind.port();
            let known = fault.amount.as_ref().filter(|known| known.name == port.text);
            let (Some(known), Bind::In { formula: Some(formula), .. }) = (known, bind) else {
                let message =
                    message!("'{}' is not an amount of the fault '{}'", port.text, fault.name);
                let known = fault.amount.iter().map(|known| known.name.as_str());
                let none = "remove the brackets";
                diags.push(unknown(Code::E0606, port.span, message, &port.text, known, none));
                return None;
            };
            let ty = Type::Quantity(known.dimension);
            let (_, value) = self.constant(formula, &ty, diags)?;
            let message = |_| message!("the {} is out of its range", Words(&known.name));
            let range = (known.from, known.to);
            if let Some(error) = range::outside(&value, range, &ty, formula.span(), message) {
                diags.push(error);
                return None;
            }
            amount = range::number(&value);
        }
        Some(amount)
    }
}

/// The help for a robot without such parts.
const NOTHING: &str = "remove the line";

fn broken<'a>(robot: &Robot<'a>, path: &Path) -> Result<(&'a Device, &'a Fault), Box<Diagnostic>> {
    let (names, written) = (path.names(), path.text());
    let error = match (robot.find::<Fault>(&names), names.as_slice()) {
        (Found::Row(device, fault, 2), [_, _]) => return Ok((device, fault)),
        (Found::Row(device, fault, 2), [_, _, more, ..]) => {
            let whole = format!("{}.{}", device.name, fault.name);
            let message = message!("'{}' has no part '{}'", whole, more.text);
            Diagnostic::new(Code::E0606, more.span, message).help(message!("write '{}'", whole))
        }
        // The device is required, as on the command line.
        (Found::Row(device, ..), [name]) => {
            let message = message!("the device that fails as '{}' is missing", written);
            let help = message!("write '{}.{}'", device.name, name.text);
            Diagnostic::new(Code::E0606, path.span(), message).help(help)
        }
        (Found::Several(devices), _) => {
            let message = message!("several devices can fail as '{}'", written);
            let help = message!("write {}", with_devices(&devices, &written));
            Diagnostic::new(Code::E0606, path.span(), message).help(help)
        }
        (Found::Device(device), [_]) if !device.faults.is_empty() => {
            let message = message!("the fault of '{}' is missing", written);
            let named = device.faults.iter().map(|it| format!("{written}.{}", it.name));
            let named: Vec<_> = named.collect();
            let help = message!("write {}", list(named.iter().map(String::as_str), "or"));
            Diagnostic::new(Code::E0606, path.span(), message).help(help)
        }
        (Found::Device(device), [_, name, ..]) if !device.faults.is_empty() => {
            let message = message!("'{}' cannot fail as '{}'", device.name, name.text);
            let known = device.faults.iter().map(|it| it.name.as_str());
            unknown(Code::E0606, name.span, message, &name.text, known, "")
        }
        _ => {
            let first = names.first().map_or(written.as_str(), |name| &name.text);
            let message = message!("the robot has no device '{}' that can fail", first);
            let fails = robot.devices.iter().filter(|device| !device.faults.is_empty());
            let known = fails.map(|device| device.name.as_str());
            let span = names.first().map_or(path.span(), |name| name.span);
            unknown(Code::E0606, span, message, first, known, NOTHING)
        }
    };
    Err(Box::new(error))
}
