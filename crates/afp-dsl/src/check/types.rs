//! Meanings of types.

use std::collections::HashSet;
use std::sync::Arc;

use crate::check::names::{ambiguous, offer};
use crate::check::synonyms;
use crate::index::{Recorder, Word};
use crate::types::{Dimension, Enum, GENERIC, Object, PLAIN, Type, is_built_in};
use afp_syntax::ast::{self, Factor};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;
use afp_syntax::source::Span;
use afp_syntax::units::Unit;

/// The visible types, in addition to built-in ones.
#[derive(Clone, Default)]
pub(crate) struct Types {
    /// Enums with their qualifiers.
    pub enums: Vec<(Option<String>, Arc<Enum>)>,
    /// Object types with their qualifiers.
    pub objects: Vec<(Option<String>, Arc<Object>)>,
    /// Whether `any`, `number` and `discrete` are valid.
    pub generic: bool,
    /// The qualifiers and their declarations.
    pub homes: Vec<(String, Span)>,
    /// Enums of indirectly used files, each with the missing `use` line and its place.
    pub hidden: Vec<(String, String, Span)>,
    /// Whether a toolbox is missing, which may have unknown names.
    pub incomplete: bool,
}

impl Types {
    /// The meaning of a type; reports an unknown one.
    pub fn resolve(
        &self,
        ty: &ast::Type,
        record: &Recorder,
        diags: &mut Diagnostics,
    ) -> Option<Type> {
        let factors = ty.factors();
        if let [only] = factors.as_slice()
            && only.exponent == Some(1)
            && let Some(reference) = &only.reference
        {
            return self.named(reference, record, diags);
        }
        if let Some(error) = self.unit_for_a_type(ty, &factors) {
            let names = factors.iter().filter_map(|factor| factor.reference.as_ref()?.name());
            names.for_each(|name| record.unknown(name.span));
            diags.push(error);
            return None;
        }
        let mut product = Some(Dimension::NONE);
        let mut named = false;
        for factor in &factors {
            named |= factor.reference.is_some();
            let dimension = self.factor(factor, record, diags);
            product = match (product, dimension) {
                (Some(product), Some(dimension)) => {
                    let joined = product.times(dimension);
                    if joined.is_none() {
                        too_high(factor, diags);
                    }
                    joined
                }
                _ => None,
            };
        }
        if !named && product.is_some() {
            diags.push(
                Diagnostic::new(Code::E0232, ty.span(), "a type names at least one dimension")
                    .help("write 'float' for a number without unit")
                    .replace("float"),
            );
            return None;
        }
        product.map(Type::Quantity)
    }

    /// Reports `m/s` instead of a type, if no factor is a type.
    fn unit_for_a_type(&self, ty: &ast::Type, factors: &[Factor]) -> Option<Diagnostic> {
        let mut unit = String::new();
        for factor in factors {
            let name = factor.reference.as_ref()?.name()?.text;
            if is_built_in(&name) || self.enums.iter().any(|(_, each)| each.name == name) {
                return None;
            }
            if !unit.is_empty() {
                unit.push(if factor.divides { '/' } else { '*' });
            }
            unit += &name;
            if let exponent @ 2.. = factor.exponent? {
                unit += &format!("^{exponent}");
            }
        }
        let dimension = Unit::parse(&unit)?.dimension;
        Some(of_unit(ty.span(), &unit, dimension))
    }

    fn named(
        &self,
        reference: &ast::Ref,
        record: &Recorder,
        diags: &mut Diagnostics,
    ) -> Option<Type> {
        let name = reference.name()?;
        let home = reference.home();
        if home.is_none() && is_built_in(&name.text) {
            record.word(name.span, Word::Type);
            match name.text.as_str() {
                "bool" => return Some(Type::Bool),
                "int" => return Some(Type::Int),
                "float" => return Some(Type::FLOAT),
                "string" => return Some(Type::Text),
                "any" if self.generic => return Some(Type::Any),
                "number" if self.generic => return Some(Type::Number),
                "discrete" if self.generic => return Some(Type::Discrete),
                generic if GENERIC.contains(&generic) => {
                    let message =
                        message!("only ports of templates can have the type '{}'", name.text);
                    diags.push(
                        Diagnostic::new(Code::E0232, name.span, message)
                            .help("write the type that the values have, such as 'float'"),
                    );
                    return None;
                }
                _ => {}
            }
            if let Some(dimension) = Dimension::named(&name.text) {
                return Some(Type::Quantity(dimension));
            }
        }
        self.declared(reference, &name, home.as_ref(), record, diags)
    }

    pub fn qualifier(&self, home: &ast::Name, record: &Recorder) {
        match self.homes.iter().find(|(known, _)| *known == home.text) {
            Some((_, definition)) => record.definition(home.span, *definition),
            None => record.unknown(home.span),
        }
    }

    fn declared(
        &self,
        reference: &ast::Ref,
        name: &ast::Name,
        home: Option<&ast::Name>,
        record: &Recorder,
        diags: &mut Diagnostics,
    ) -> Option<Type> {
        if let Some(home) = home {
            self.qualifier(home, record);
        }
        let fits = |qualifier: &Option<String>| {
            home.is_none_or(|home| qualifier.as_deref() == Some(home.text.as_str()))
        };
        let enums = self.enums.iter().filter(|(home, each)| fits(home) && each.name == name.text);
        let mut found: Vec<_> =
            enums.map(|(home, each)| (home, Type::Enum(each.clone()))).collect();
        let objects =
            self.objects.iter().filter(|(home, each)| fits(home) && each.name == name.text);
        found.extend(objects.map(|(home, each)| (home, Type::Object(each.clone()))));
        match found.as_slice() {
            [(_, ty)] => {
                record.definition(name.span, ty.declaration().unwrap_or(name.span));
                Some(ty.clone())
            }
            [] if self.incomplete => {
                record.unknown(name.span);
                None
            }
            [] => {
                record.unknown(name.span);
                diags.push(self.unknown(reference, name, home.is_some()));
                None
            }
            several => {
                record.several(name.span, several.iter().filter_map(|(_, ty)| ty.declaration()));
                let places = several.iter().map(|(home, ty)| {
                    (home.as_deref(), ty.declaration().unwrap_or_else(|| reference.span()))
                });
                let places: Vec<_> = places.collect();
                diags.push(ambiguous("a type", &name.text, reference.span(), &places));
                None
            }
        }
    }

    /// Reports an unknown type; `qualified` if it has a qualifier.
    fn unknown(&self, reference: &ast::Ref, name: &ast::Name, qualified: bool) -> Diagnostic {
        let message = message!("there is no type '{}'", name.text);
        let error = Diagnostic::new(Code::E0232, reference.span(), message);
        if let (false, Some(error)) = (qualified, self.hidden(&name.text, &error)) {
            return error;
        }
        // A type's name in other languages.
        if let Some(ty) = synonyms::ty(&name.text) {
            return error.write(ty);
        }
        if let Some(unit) = Unit::parse(&name.text).filter(|_| !qualified) {
            return of_unit(reference.span(), &name.text, unit.dimension);
        }
        let enums = self.enums.iter().map(|(_, each)| each.name.as_str());
        let objects = self.objects.iter().map(|(_, each)| each.name.as_str());
        let mut known: Vec<&str> = PLAIN.to_vec();
        known.extend(enums);
        for dimension in Dimension::names() {
            known.push(dimension);
        }
        known.extend(objects);
        let mut seen = HashSet::new();
        known.retain(|name| seen.insert(*name));
        offer(error, &name.text, known, "")
    }

    /// Explains that an enum is in an indirectly used file.
    pub fn hidden(&self, name: &str, error: &Diagnostic) -> Option<Diagnostic> {
        let (_, line, top) = self.hidden.iter().find(|(known, ..)| known == name)?;
        let help = message!("add '{}' at the top of the file", line);
        Some(error.bare().help(help).fix(*top, format!("{line}\n")))
    }

    /// A factor of a product: a dimension, or a plain number.
    fn factor(
        &self,
        factor: &Factor,
        record: &Recorder,
        diags: &mut Diagnostics,
    ) -> Option<Dimension> {
        let Some(exponent) = factor.exponent else {
            too_high(factor, diags);
            if let Some(reference) = &factor.reference {
                self.named(reference, record, &mut Diagnostics::default());
            }
            return None;
        };
        let base = match (&factor.reference, &factor.number) {
            (Some(reference), _) => match self.named(reference, record, diags)? {
                Type::Quantity(dimension) => dimension,
                _ => {
                    diags.push(
                        Diagnostic::new(
                            Code::E0232,
                            reference.span(),
                            "only dimensions can be multiplied",
                        )
                        .help("write dimensions such as 'length' or 'duration'"),
                    );
                    return None;
                }
            },
            (None, Some(number)) if number.text == "1" => Dimension::NONE,
            (None, Some(number)) => {
                diags.push(
                    Diagnostic::new(Code::E0232, number.span, "the only number in a type is 1")
                        .help("write '1', as in '1/duration'")
                        .replace("1"),
                );
                return None;
            }
            (None, None) => return None,
        };
        let exponent = if factor.divides { exponent.checked_neg() } else { Some(exponent) };
        let raised = exponent.and_then(|exponent| base.power(exponent));
        if raised.is_none() {
            too_high(factor, diags);
        }
        raised
    }
}

fn too_high(factor: &Factor, diags: &mut Diagnostics) {
    diags.push(
        Diagnostic::new(Code::E0232, factor.span, "the exponent is too large")
            .help("exponents of a dimension go from -128 to 127"),
    );
}

/// Reports a unit instead of a type.
fn of_unit(span: Span, unit: &str, dimension: Dimension) -> Diagnostic {
    let ours = dimension.name();
    let message = message!("there is no type '{}', which is a unit", unit);
    Diagnostic::new(Code::E0232, span, message).write(ours)
}
