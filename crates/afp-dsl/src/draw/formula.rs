//! Formulas as text: as written where the source is at hand, else printed from the graph.
//!
//! The graph holds SI values only, so a printed quantity gets the unit that makes it shortest and
//! reads back as the very same double.

use crate::graph::{Formula, FormulaKind, Operator, Plan};
use crate::source::Sources;
use crate::toolbox::Constant;
use crate::types::units::{RADIANS_PER_DEGREE, Unit};
use crate::types::value::parse_value;
use crate::types::{Conversion, Dimension, Type};

/// A formula of `plan` as text.
///
/// With `sources` this is the text under [`Formula::span`], when it stands on one line and without
/// comment. Otherwise the formula is printed: entries by name, quantities in a unit that suits
/// their size (`30 cm`, not `0.3 m`), brackets only where they are needed, conversions left out,
/// since the language has no words for them.
pub fn text(formula: &Formula, plan: &Plan, sources: Option<&Sources>) -> String {
    let written = sources.map_or("", |sources| sources.text(formula.span)).trim();
    if written.is_empty() || written.contains("//") || written.contains('\n') {
        printed(formula, plan)
    } else {
        written.to_owned()
    }
}

/// A value in SI units with the unit that makes the text shortest, the usual one where two do.
///
/// ```
/// use afp_dsl::draw::formula::quantity;
/// use afp_dsl::types::Dimension;
///
/// let length = Dimension::named("length").unwrap();
/// assert_eq!(quantity(0.3, length), "30 cm");
/// assert_eq!(quantity(100.0, length), "100 m");
/// ```
pub fn quantity(value: f64, dimension: Dimension) -> String {
    if dimension == Dimension::NONE {
        return number(value);
    }
    let singles = Unit::symbols().map(str::to_owned);
    let units = [dimension.usual_unit(), dimension.si_unit()].into_iter().chain(singles);
    let texts = units.filter_map(|unit| in_unit(value, dimension, &unit));
    let shortest = texts.min_by_key(String::len);
    shortest.unwrap_or_else(|| format!("{} {}", number(value), dimension.si_unit()))
}

/// A span of time in nanoseconds.
pub(super) fn duration(nanoseconds: u64) -> String {
    let units = [(1_000_000_000, "s"), (1_000_000, "ms"), (1_000, "us")];
    let whole = units.iter().find(|(length, _)| nanoseconds.is_multiple_of(*length));
    whole.map_or_else(
        || format!("{nanoseconds} ns"),
        |(length, unit)| format!("{} {unit}", nanoseconds / length),
    )
}

fn in_unit(value: f64, dimension: Dimension, unit_text: &str) -> Option<String> {
    let unit = Unit::parse(unit_text)?;
    if unit.dimension != dimension || unit.celsius {
        return None;
    }
    let mut factor = unit.numerator as f64 / unit.denominator as f64;
    let power = 10_f64.powi(unit.exponent.abs());
    factor = if unit.exponent < 0 { factor / power } else { factor * power };
    for _ in 0..unit.degrees.unsigned_abs() {
        factor *= if unit.degrees > 0 { RADIANS_PER_DEGREE } else { 1.0 / RADIANS_PER_DEGREE };
    }
    // Fifteen digits undo the rounding of the division; whether they do is checked.
    let rounded: f64 = format!("{:.14e}", value / factor).parse().ok()?;
    let text = format!("{} {unit_text}", number(rounded));
    let ty = Type::Quantity(dimension);
    let back = parse_value(&text, &ty).ok()?;
    (back == Constant::Float(value)).then_some(text)
}

/// A plain number in the spelling of literals.
fn number(value: f64) -> String {
    let plain = value.to_string();
    let short = format!("{value:e}");
    if plain.len() > 12 && short.len() < plain.len() { short } else { plain }
}

fn printed(formula: &Formula, plan: &Plan) -> String {
    match &formula.kind {
        FormulaKind::Bool(value) => value.to_string(),
        FormulaKind::Int(value) => value.to_string(),
        FormulaKind::Float(value) => match formula.ty {
            Type::Quantity(dimension) => quantity(*value, dimension),
            _ => number(*value),
        },
        FormulaKind::Text(value) => format!("{value:?}"),
        FormulaKind::Choice(place) => choice(*place, &formula.ty),
        FormulaKind::Entry(entry) => plan.entries[entry.index()].name.clone(),
        FormulaKind::Neg(inner) => format!("-{}", operand(inner, plan, NEGATION)),
        FormulaKind::Binary(operator, left, right) => {
            let level = level(*operator);
            // The right operand of an equal level needs brackets: `a - (b - c)`.
            let (left, right) = (operand(left, plan, level), operand(right, plan, level + 1));
            format!("{left} {} {right}", sign(*operator))
        }
        FormulaKind::Convert(conversion, inner) => converted(conversion, inner, plan),
    }
}

/// Binding strength of a sign, above `*` and `/`.
const NEGATION: u8 = 3;

fn converted(conversion: &Conversion, inner: &Formula, plan: &Plan) -> String {
    match (conversion, &inner.kind) {
        (Conversion::IntToFloat, FormulaKind::Int(value)) => number(*value as f64),
        _ => printed(inner, plan),
    }
}

fn operand(formula: &Formula, plan: &Plan, least: u8) -> String {
    let text = printed(formula, plan);
    if strength(formula) < least { format!("({text})") } else { text }
}

fn strength(formula: &Formula) -> u8 {
    match &formula.kind {
        FormulaKind::Binary(operator, ..) => level(*operator),
        FormulaKind::Convert(_, inner) => strength(inner),
        _ => NEGATION,
    }
}

fn level(operator: Operator) -> u8 {
    match operator {
        Operator::Add | Operator::Sub => 1,
        Operator::Mul | Operator::Div | Operator::Rem => 2,
    }
}

fn sign(operator: Operator) -> char {
    match operator {
        Operator::Add => '+',
        Operator::Sub => '-',
        Operator::Mul => '*',
        Operator::Div => '/',
        Operator::Rem => '%',
    }
}

fn choice(place: u16, ty: &Type) -> String {
    let Type::Enum(home) = ty else { return place.to_string() };
    match home.variants.get(usize::from(place)) {
        Some(variant) => format!("{}.{variant}", home.name),
        None => place.to_string(),
    }
}

/// The name of a type in the spelling of the language.
pub(super) fn type_name(ty: &Type) -> String {
    match ty {
        Type::Bool => "bool".to_owned(),
        Type::Int => "int".to_owned(),
        Type::Quantity(dimension) => dimension.name(),
        Type::Text => "string".to_owned(),
        Type::Enum(home) => home.name.clone(),
        Type::Object(object) => object.name.clone(),
        Type::Any => "any".to_owned(),
        Type::Number => "number".to_owned(),
    }
}

#[cfg(test)]
mod tests;
