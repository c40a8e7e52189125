//! Expectations about the robot's signals.

use super::Checker;
use super::compare::{Compared, Named};
use super::robot::{Found, with_devices};
use crate::check::names::unknown;
use crate::scenario::{Claim, Comparison, Field, Operand, Part, Subject};
use crate::toolbox::{Signal, SignalType};
use crate::types::{Constant, Dimension, Type};
use afp_syntax::ast::{Name, Path};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, list};
use afp_syntax::message;

impl Checker<'_> {
    /// Whether names can only be of the robot.
    pub(super) fn is_of_robot(&self, names: &[Name]) -> bool {
        let known = names.first().is_some_and(|name| self.robot.device(&name.text).is_some());
        known || !matches!(self.robot.find::<Signal>(names), Found::Nothing)
    }

    pub(super) fn is_signal(&self, names: &[Name]) -> bool {
        matches!(self.robot.find::<Signal>(names), Found::Row(..))
    }

    /// The names of boolean signals.
    pub(super) fn facts(&self) -> Vec<String> {
        self.robot.words::<Signal>()
    }

    /// A signal that must be true.
    pub(super) fn fact_of_robot(&self, path: &Path, diags: &mut Diagnostics) -> Option<Claim> {
        let Compared { subject, ty, .. } = self.measured(&Named::of_path(path), diags)?;
        if ty != Type::Bool {
            let message = message!("'{}' is not a truth value", path.text());
            let sign = if ty.is_numeric() { ">" } else { "==" };
            diags.push(Diagnostic::new(Code::E0604, path.span(), message).help(message!(
                "compare it: '{} {} ...'",
                path.text(),
                sign
            )));
            return None;
        }
        let (comparison, right) = (Comparison::Equal, Operand::Value(Constant::Bool(true)));
        Some(Claim::Compare { left: subject, comparison, right })
    }

    /// A signal, or a part of it.
    pub(super) fn measured(&self, named: &Named, diags: &mut Diagnostics) -> Option<Compared> {
        let Named { names, text: written, span } = named;
        let error = match self.robot.find::<Signal>(names) {
            Found::Row(device, signal, used) => {
                let part = Part::new(&device.name, &signal.name);
                return match field(named, signal, names.get(used..).unwrap_or_default()) {
                    Ok((field, ty)) => Some(Compared {
                        subject: Subject::Signal(part, field),
                        ty,
                        declared: Some(signal.span),
                    }),
                    Err(error) => {
                        diags.push(*error);
                        None
                    }
                };
            }
            Found::Several(devices) => {
                let first = names.first().map_or(written.as_str(), |name| &name.text);
                let message = message!("several devices have a signal '{}'", first);
                let help = message!("write {}", with_devices(&devices, first));
                Diagnostic::new(Code::E0604, *span, message).help(help)
            }
            Found::Device(device) => {
                let none = "expect something else; this device signals nothing";
                let own = device.signals.iter().flat_map(written_as).collect::<Vec<_>>();
                let own = own.iter().map(String::as_str);
                match names.get(1) {
                    Some(name) => {
                        let message = message!("'{}' has no signal '{}'", device.name, name.text);
                        unknown(Code::E0604, name.span, message, &name.text, own, none)
                    }
                    None => {
                        let message = message!("the claim about '{}' is missing", written);
                        let full: Vec<_> = own.map(|own| format!("{written}.{own}")).collect();
                        let full = full.iter().map(String::as_str);
                        unknown(Code::E0604, *span, message, written, full, none)
                    }
                }
            }
            Found::Nothing => {
                let message = message!("the robot has no signal '{}'", written);
                let known = self.robot.words::<Signal>();
                let known = known.iter().map(String::as_str);
                unknown(Code::E0604, *span, message, written, known, "remove the line")
            }
        };
        diags.push(error);
        None
    }
}

/// The spellings of a signal for comparisons, with each of its parts.
fn written_as(signal: &Signal) -> Vec<String> {
    match Field::of(signal.ty) {
        [] => vec![signal.name.clone()],
        fields => fields.iter().map(|it| format!("{}.{}", signal.name, it.word())).collect(),
    }
}

/// The part of a signal after its name, and its type.
fn field(
    named: &Named,
    signal: &Signal,
    names: &[Name],
) -> Result<(Option<Field>, Type), Box<Diagnostic>> {
    let fields = Field::of(signal.ty);
    let alone = match signal.ty {
        SignalType::Bool => Some(Type::Bool),
        SignalType::Int => Some(Type::Int),
        SignalType::Float(dimension) => Some(Type::Quantity(dimension)),
        SignalType::Text => Some(Type::Text),
        SignalType::Pose | SignalType::Range | SignalType::Image | SignalType::Outline => None,
    };
    match (names, alone) {
        ([], Some(ty)) => return Ok((None, ty)),
        ([name], None) => {
            if let Some(field) = fields.iter().find(|field| field.word() == name.text) {
                return Ok((Some(*field), Type::Quantity(field.dimension())));
            }
        }
        _ => {}
    }
    let message = match (names, fields) {
        ([], []) => message!("'{}' is for logs and pictures and cannot be compared", named.text),
        ([], _) => message!("the signal of '{}' is missing", named.text),
        ([name, ..], _) => message!("'{}' has no part '{}'", signal.name, name.text),
    };
    let own = &named.names;
    let stem: Vec<_> = own[..own.len() - names.len()].iter().map(|it| it.text.as_str()).collect();
    let stem = stem.join(".");
    let known: Vec<_> = fields.iter().map(|field| format!("{stem}.{}", field.word())).collect();
    let help = match (known.as_slice(), names) {
        ([], []) => "expect another signal".into(),
        ([], _) => message!("write '{}'", stem),
        (known, _) => message!("write {}", list(known.iter().map(String::as_str), "or")),
    };
    Err(Box::new(Diagnostic::new(Code::E0604, named.span, message).help(help)))
}

impl Field {
    /// The unit of the parts: metres or radians.
    fn dimension(self) -> Dimension {
        match self {
            Field::X | Field::Y | Field::Distance => Dimension { length: 1, ..Dimension::NONE },
            Field::Heading => Dimension { angle: 1, ..Dimension::NONE },
        }
    }
}
