//! Formulas as text: from the source if it is available, or else printed from the graph.

use afp_dsl::graph::{EntryId, Formula, Op, Operator, Part, Plan};
use afp_dsl::toolbox::{Case, Condition, Constant, Template};
use afp_dsl::types::text::{number, quantity};
use afp_dsl::types::{Conversion, Type};
use afp_syntax::source::Sources;

/// A formula of `plan` as text.
///
/// With `sources`, this is the source text if it is on one line and has no comment. Otherwise the
/// formula is printed: entries by name, quantities in a readable unit (`30 cm`, not `0.3 m`), and
/// only necessary parentheses. Conversions are left out, because the language has no syntax for
/// them.
pub fn text(formula: &Formula, plan: &Plan, sources: Option<&Sources>) -> String {
    let written = sources.map_or("", |sources| sources.text(formula.span)).trim();
    if written.is_empty() || written.contains("//") || written.contains('\n') {
        printed(formula.part(), &|entry| &plan.entries[entry.index()].name)
    } else {
        written.to_owned()
    }
}

/// The condition of a state of a declared computation; empty for the last state.
pub fn condition(case: &Case, template: &Template) -> String {
    let names = ports(template);
    let compared = case.when.iter().map(|Condition { left, comparison, right }| {
        let (left, right) = (printed(left.part(), &names), printed(right.part(), &names));
        format!("{left} {} {right}", comparison.sign())
    });
    compared.collect::<Vec<_>>().join(" and ")
}

/// The states of a declared computation by name, as in its declaration: `Done { next = 0 }`.
pub fn states(template: &Template) -> impl Iterator<Item = (&str, String)> {
    let cases = template.cases.as_deref().unwrap_or_default();
    template.outcomes.iter().zip(cases).map(|(state, case)| {
        let condition = condition(case, template);
        let when = if condition.is_empty() { "" } else { " when " };
        let written = writes(case, template).map(|(port, formula)| format!(" {port} = {formula}"));
        let written = written.collect::<Vec<_>>().join(",");
        let end = if written.is_empty() { "" } else { " " };
        (&*state.name, format!("{}{when}{condition} {{{written}{end}}}", state.name))
    })
}

/// The outputs that a state of a declared computation assigns, each with its formula.
pub fn writes<'t>(
    case: &'t Case,
    template: &'t Template,
) -> impl Iterator<Item = (&'t str, String)> {
    case.writes.iter().filter_map(|(port, formula)| {
        let port = &template.outputs.get(usize::from(*port))?.name;
        Some((port.as_str(), printed(formula.part(), &ports(template))))
    })
}

/// The input ports that the formulas of a declared computation read.
fn ports<'t>(template: &'t Template) -> impl Fn(EntryId) -> &'t str {
    move |port| template.inputs.get(port.index()).map_or("", |port| &port.name)
}

type Names<'f, 'n> = &'f dyn Fn(EntryId) -> &'n str;

/// A value as text, with a readable unit.
pub fn constant(value: &Constant, ty: Option<&Type>) -> String {
    match (value, ty) {
        (Constant::Float(value), Some(Type::Quantity(dimension))) => quantity(*value, *dimension),
        (Constant::Float(value), _) => number(*value),
        (Constant::Choice(place), Some(ty)) => choice(*place, ty),
        (value, _) => value.to_string(),
    }
}

fn printed(formula: Part<'_>, names: Names) -> String {
    let operands: Vec<_> = formula.operands().collect();
    match (formula.op(), &operands[..]) {
        (Op::Bool(value), _) => value.to_string(),
        (Op::Int(value), _) => value.to_string(),
        (Op::Float(value), _) => match formula.ty {
            Type::Quantity(dimension) => quantity(*value, dimension),
            _ => number(*value),
        },
        (Op::Text(value), _) => format!("{value:?}"),
        (Op::Choice(place), _) => choice(*place, &formula.ty),
        (Op::Entry(entry), _) => names(*entry).to_owned(),
        (Op::Neg, &[inner]) => format!("-{}", operand(inner, names, NEGATION)),
        (Op::Binary(operator), &[left, right]) => {
            let level = level(*operator);
            // The right operand of the same level needs parentheses: `a - (b - c)`.
            let (left, right) = (operand(left, names, level), operand(right, names, level + 1));
            format!("{left} {} {right}", operator.sign())
        }
        (Op::Convert(conversion), &[inner]) => match (conversion, inner.op()) {
            (Conversion::IntToFloat, Op::Int(value)) => number(*value as f64),
            _ => printed(inner, names),
        },
        (Op::Call(function), operands) => {
            let operands: Vec<_> = operands.iter().map(|each| printed(*each, names)).collect();
            format!("{}({})", function.name(), operands.join(", "))
        }
        // Every other node has exactly these operands.
        (Op::Neg | Op::Binary(_) | Op::Convert(_), _) => String::new(),
    }
}

/// Precedence of a sign, above `*` and `/`.
const NEGATION: u8 = 3;

fn operand(formula: Part<'_>, names: Names, least: u8) -> String {
    let text = printed(formula, names);
    if strength(formula) < least { format!("({text})") } else { text }
}

fn strength(formula: Part<'_>) -> u8 {
    match formula.op() {
        Op::Binary(operator) => level(*operator),
        Op::Convert(_) => formula.operand().map_or(NEGATION, strength),
        _ => NEGATION,
    }
}

fn level(operator: Operator) -> u8 {
    match operator {
        Operator::Add | Operator::Sub => 1,
        Operator::Mul | Operator::Div | Operator::Rem => 2,
    }
}

fn choice(index: u16, ty: &Type) -> String {
    let Type::Enum(home) = ty else { return index.to_string() };
    match home.variants.get(usize::from(index)) {
        Some(variant) => format!("{}.{variant}", home.name),
        None => index.to_string(),
    }
}

#[cfg(test)]
mod tests;
