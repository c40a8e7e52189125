//! What is expected of the robot's signals.

use super::Checker;
use super::robot::{Found, with_devices};
use crate::check::names::unknown;
use crate::scenario::{Claim, Comparison, Field, Part};
use crate::toolbox::{Constant, Signal, SignalType};
use crate::types::{Dimension, Type};
use afp_syntax::ast::{Formula, Name, Path};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, words};

/// A signal, or a part of one, and the type of its values.
struct Measured {
    signal: Part,
    field: Option<Field>,
    ty: Type,
}

impl Checker<'_> {
    /// Whether a path can only mean something of the robot.
    pub(super) fn is_of_robot(&self, path: &Path) -> bool {
        let names = path.names();
        let known = names.first().is_some_and(|name| self.robot.device(&name.text).is_some());
        known || !matches!(self.robot.find::<Signal>(&names), Found::Nothing)
    }

    /// How the signals can be named that are true or false.
    pub(super) fn facts(&self) -> Vec<String> {
        self.robot.words::<Signal>()
    }

    /// A signal that is true.
    pub(super) fn fact_of_robot(&self, path: &Path, diags: &mut Diagnostics) -> Option<Claim> {
        let Measured { signal, field, ty } = self.measured(path, diags)?;
        if ty != Type::Bool {
            let message = format!("'{}' is neither true nor false", path.text());
            let sign = if ty.is_numeric() { ">" } else { "==" };
            diags.push(
                Diagnostic::new(Code::E0604, path.span(), message)
                    .help(format!("compare it: '{} {sign} ...'", path.text())),
            );
            return None;
        }
        let (comparison, value) = (Comparison::Equal, Constant::Bool(true));
        Some(Claim::Signal { signal, field, comparison, value })
    }

    /// A signal that compares so with a value.
    pub(super) fn compare_signal(
        &self,
        path: &Path,
        sign: &Name,
        value: &Formula,
        diags: &mut Diagnostics,
    ) -> Option<Claim> {
        let comparison = Comparison::parse(&sign.text)?;
        let Measured { signal, field, ty } = self.measured(path, diags)?;
        if comparison.is_order() && !ty.is_numeric() {
            let message = format!("values of '{}' have no order", path.text());
            diags.push(Diagnostic::new(Code::E0604, sign.span, message).help("write '==' or '!='"));
            return None;
        }
        let (_, value) = self.constant(value, &ty, diags)?;
        Some(Claim::Signal { signal, field, comparison, value })
    }

    fn measured(&self, path: &Path, diags: &mut Diagnostics) -> Option<Measured> {
        let (names, written) = (path.names(), path.text());
        let error = match self.robot.find::<Signal>(&names) {
            Found::Row(device, signal, used) => {
                let part = Part::new(&device.name, &signal.name);
                let field = field(path, signal, names.get(used..).unwrap_or_default());
                let found = field.map(|(field, ty)| Measured { signal: part, field, ty });
                return found.map_err(|error| diags.push(*error)).ok();
            }
            Found::Several(devices) => {
                let first = names.first().map_or(written.as_str(), |name| &name.text);
                let message = format!("several devices have a signal '{first}'");
                let help = format!("write {}", with_devices(&devices, first));
                Diagnostic::new(Code::E0604, path.span(), message).help(help)
            }
            Found::Device(device) => {
                let none = "expect something else; this device signals nothing";
                let own = device.signals.iter().map(|signal| signal.name.as_str());
                match names.get(1) {
                    Some(name) => {
                        let message = format!("'{}' has no signal '{}'", device.name, name.text);
                        unknown(Code::E0604, name.span, message, &name.text, own, none)
                    }
                    None => {
                        let message = format!("what is expected of '{written}' is not said");
                        let full: Vec<_> = own.map(|own| format!("{written}.{own}")).collect();
                        let full = full.iter().map(String::as_str);
                        unknown(Code::E0604, path.span(), message, &written, full, none)
                    }
                }
            }
            Found::Nothing => {
                let message = format!("the robot has no signal '{written}'");
                let known = self.robot.words::<Signal>();
                let known = known.iter().map(String::as_str);
                unknown(Code::E0604, path.span(), message, &written, known, "remove the line")
            }
        };
        diags.push(error);
        None
    }
}

/// The part of a signal that names behind it mean, and the type of its values.
fn field(
    path: &Path,
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
        ([], []) => format!("'{}' is for logs and pictures and cannot be compared", path.text()),
        ([], _) => format!("what of '{}' is expected is not said", path.text()),
        ([name, ..], _) => format!("'{}' has no part '{}'", signal.name, name.text),
    };
    let own = path.names();
    let stem: Vec<_> = own[..own.len() - names.len()].iter().map(|it| it.text.as_str()).collect();
    let stem = stem.join(".");
    let known: Vec<_> = fields.iter().map(|field| format!("{stem}.{}", field.word())).collect();
    let help = match (known.as_slice(), names) {
        ([], []) => "expect another signal".to_owned(),
        ([], _) => format!("write '{stem}'"),
        (known, _) => format!("write {}", words::list(known.iter().map(String::as_str), "or")),
    };
    Err(Box::new(Diagnostic::new(Code::E0604, path.span(), message).help(help)))
}

impl Field {
    /// What the values of the parts are: metres, or radians.
    fn dimension(self) -> Dimension {
        match self {
            Field::X | Field::Y | Field::Distance => Dimension { length: 1, ..Dimension::NONE },
            Field::Heading => Dimension { angle: 1, ..Dimension::NONE },
        }
    }
}
