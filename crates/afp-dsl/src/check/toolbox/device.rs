//! One device: controls, faults, signals.

use super::ports::{Declared, Site, Values};
use crate::check::names::{DeclaredNames, unknown};
use crate::index::Word;
use crate::toolbox::device::{ROBOT, SHOWN, of_every_sensor};
use crate::toolbox::{Amount, Control, Device, DeviceKind, Fault, Signal, SignalType};
use crate::types::{Constant, Type};
use afp_syntax::ast::{self, DevicePart, Name};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, words};
use afp_syntax::message;
use afp_syntax::source::Span;

/// The devices of a toolbox so far.
#[derive(Default)]
pub(super) struct Devices {
    names: DeclaredNames,
    /// The place of `stop`.
    stop: Option<Span>,
    pub all: Vec<Device>,
}

impl Devices {
    /// Reads a device; skips one without a name.
    pub fn read(&mut self, node: &ast::Device, site: &Site<'_>, diags: &mut Diagnostics) {
        let Some(name) = name(node, site, diags) else { return };
        let kind = node.kind();
        let is_robot = |known: &&Device| known.kind == DeviceKind::Robot;
        let is_new = match self.all.iter().find(is_robot).filter(|_| kind == DeviceKind::Robot) {
            Some(first) => {
                let message = "'robot' is declared twice";
                let twice = Diagnostic::new(Code::E0212, name.span, message);
                let twice = twice.note(first.span, "first declared here");
                diags.push(twice.help("a toolbox has one: write its parts into the first"));
                false
            }
            None => self.names.declare(&name, diags),
        };
        let mut device = Device {
            kind,
            name: name.text,
            doc: node.doc(),
            controls: Vec::new(),
            faults: if kind == DeviceKind::Sensor { of_every_sensor() } else { Vec::new() },
            signals: Vec::new(),
            span: name.span,
        };
        let mut scopes = Scopes::default();
        for part in node.parts() {
            match part {
                DevicePart::Press(part) => {
                    self.press(&part, &mut device, &mut scopes.controls, diags);
                }
                DevicePart::Fault(part) => {
                    let fault = fault(&part, &device, site, &mut scopes.faults, diags);
                    device.faults.extend(fault);
                }
                DevicePart::Signal(part) => {
                    let signal = signal(&part, site, &mut scopes.signals, diags);
                    device.signals.extend(signal);
                }
            }
        }
        if is_new {
            self.all.push(device);
        }
    }

    fn press(
        &mut self,
        node: &ast::Press,
        device: &mut Device,
        names: &mut DeclaredNames,
        diags: &mut Diagnostics,
    ) {
        let stops = node.keyword().is_some_and(|word| word.text == "stop");
        for control in node.controls() {
            let Some(name) = control.name() else { continue };
            names.declare(&name, diags);
            if let (true, Some(first)) = (stops, self.stop) {
                let message = "a robot has only one control that stops the plan";
                diags.push(
                    Diagnostic::new(Code::E0511, name.span, message)
                        .note(first, "the first one")
                        .help(message!("write 'press {}'", name.text)),
                );
            }
            if stops {
                self.stop.get_or_insert(name.span);
            }
            let own = control.doc();
            device.controls.push(Control {
                doc: if own.is_empty() { node.doc() } else { own },
                name: name.text,
                stops,
                span: name.span,
            });
        }
    }
}

#[derive(Default)]
struct Scopes {
    controls: DeclaredNames,
    faults: DeclaredNames,
    signals: DeclaredNames,
}

fn name(node: &ast::Device, site: &Site<'_>, diags: &mut Diagnostics) -> Option<Name> {
    match (node.kind(), node.name()) {
        (DeviceKind::Robot, named) => {
            if let Some(name) = named {
                site.record.unknown(name.span);
                let message = "the robot as a whole has no name";
                diags.push(
                    Diagnostic::new(Code::E0515, name.span, message)
                        .help("write 'robot { ... }'")
                        .replace(""),
                );
            }
            node.keyword()
        }
        (_, Some(name)) if name.text == ROBOT => {
            let message = "'robot' is the name of the robot as a whole";
            diags.push(
                Diagnostic::new(Code::E0515, name.span, message)
                    .help("write 'robot { ... }', or choose another name"),
            );
            None
        }
        (_, name) => name,
    }
}

fn fault(
    node: &ast::Fault,
    device: &Device,
    site: &Site<'_>,
    names: &mut DeclaredNames,
    diags: &mut Diagnostics,
) -> Option<Fault> {
    let written = node.amount();
    let amount = written.as_ref().and_then(|amount| self::amount(amount, site, diags));
    let name = node.name()?;
    let inherited =
        device.faults.iter().any(|known| known.span.is_none() && known.name == name.text);
    if inherited {
        let message = message!("every sensor has the fault '{}'", name.text);
        diags.push(
            Diagnostic::new(Code::E0515, name.span, message)
                .help("remove it, or give it another name"),
        );
        return None;
    }
    names.declare(&name, diags);
    if written.is_some() && amount.is_none() {
        return None;
    }
    Some(Fault { doc: node.doc(), amount, span: Some(name.span), name: name.text })
}

/// The amount of a fault; `None` if it is invalid.
fn amount(node: &ast::Amount, site: &Site<'_>, diags: &mut Diagnostics) -> Option<Amount> {
    let name = node.name();
    let ty = node.ty().and_then(|ty| site.types.resolve(&ty, site.record, diags));
    let (Some(name), Some(ty)) = (name, ty) else {
        site.values_only(node.default().into_iter().chain(node.ends()));
        return None;
    };
    let Type::Quantity(dimension) = ty else {
        let message = message!("'{}' cannot be of type '{}'", name.text, ty);
        diags.push(
            Diagnostic::new(Code::E0515, name.span, message)
                .help("write 'float', or a quantity such as 'duration'"),
        );
        return None;
    };
    let values = Values { site, ty: &ty, of: Declared::Amount };
    let range = values.range(node.range(), node.ends(), diags);
    let Some(written) = node.default() else {
        let message = message!("'{}' has no default", name.text);
        let help = message!("write '{}: {} = ...', its default", name.text, ty);
        diags.push(Diagnostic::new(Code::E0515, name.span, message).help(help));
        return None;
    };
    let Some(Constant::Float(default)) = values.default(&written, range, diags) else {
        return None;
    };
    let (from, to) = range.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
    Some(Amount { dimension, default, from, to, span: Some(name.span), name: name.text })
}

fn signal(
    node: &ast::Signal,
    site: &Site<'_>,
    names: &mut DeclaredNames,
    diags: &mut Diagnostics,
) -> Option<Signal> {
    let name = node.name();
    if let Some(name) = &name {
        names.declare(name, diags);
    }
    let ty = node.ty().and_then(|ty| signal_type(&ty, site, diags));
    let truth = node.keyword().is_some_and(|word| word.text == "truth");
    let (name, ty) = (name?, ty?);
    Some(Signal { doc: node.doc(), ty, truth, span: name.span, name: name.text })
}

/// A type of the language, or a type for logs and pictures.
fn signal_type(node: &ast::Type, site: &Site<'_>, diags: &mut Diagnostics) -> Option<SignalType> {
    let factors = node.factors();
    let word = match factors.as_slice() {
        [factor] => factor.reference.as_ref().filter(|it| it.home().is_none()),
        _ => None,
    };
    let word = word.and_then(|reference| reference.name());
    let shown = |word: &Name| SHOWN.iter().find(|(known, _)| *known == word.text);
    if let (Some(word), Some((_, ty))) = (&word, word.as_ref().and_then(shown)) {
        site.record.word(word.span, Word::Type);
        return Some(*ty);
    }
    let mut own = Diagnostics::default();
    let ty = site.types.resolve(node, site.record, &mut own);
    let near = |word: &Name| words::nearest(&word.text, SHOWN.iter().map(|(known, _)| *known));
    if let (None, Some(word), Some(_)) = (&ty, &word, word.as_ref().and_then(near)) {
        let message = message!("there is no type '{}'", word.text);
        let known = SHOWN.iter().map(|(known, _)| *known);
        diags.push(unknown(Code::E0232, word.span, message, &word.text, known, ""));
        return None;
    }
    diags.extend(own);
    match ty? {
        Type::Bool => Some(SignalType::Bool),
        Type::Int => Some(SignalType::Int),
        Type::Quantity(dimension) => Some(SignalType::Float(dimension)),
        Type::Text => Some(SignalType::Text),
        ty => {
            let message = message!("a signal cannot be of type '{}'", ty);
            diags.push(Diagnostic::new(Code::E0515, node.span(), message).help(
                "write 'bool', 'int', 'float', 'string', a quantity such as 'length', or 'pose', 'range', 'image' or 'outline'",
            ));
            None
        }
    }
}
