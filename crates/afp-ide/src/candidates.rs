//! Candidates for an exit's target and for a port's binding.

use crate::View;
use crate::describe::{bound, units};
use afp_draw::formula::constant;
use afp_dsl::graph::EntryKind;
use afp_dsl::outline::{Component, Entry, ExitKind, Input};
use afp_dsl::types::{Dimension, Type};
use afp_syntax::item::Item;
use afp_syntax::literal::Literal;
use serde::Serialize;

/// A candidate, valid or not.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Candidate {
    pub text: String,
    /// The reason if it does not fit.
    pub refused: Option<String>,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PortCandidates {
    /// Entries, and values of small types; fitting ones come first.
    #[serde(rename = "candidates")]
    pub list: Vec<Candidate>,
    #[serde(rename = "type")]
    pub ty: String,
    /// The current binding.
    pub value: Option<String>,
    /// The value of an unbound port.
    pub default: Option<String>,
    /// Minimum and maximum.
    pub range: Option<(String, String)>,
    /// A step with a visible effect: a round number in [`PortCandidates::unit`].
    pub step: Option<f64>,
    /// The usual unit; empty for a plain number.
    pub unit: String,
    pub units: Vec<String>,
    /// The SI value of each of these units.
    pub scales: Vec<f64>,
}

/// Returns the targets of a state or event; `None` without such a component or exit.
pub fn of_exit(view: &View, item: &Item, outcome: &str) -> Option<Vec<Candidate>> {
    let (plan, component) = component(view, item)?;
    let exit = component.exits.iter().find(|exit| *exit.name == *outcome);
    let kind = exit.map_or_else(|| of_word(outcome), |exit| Some(exit.kind))?;
    let names = plan.elements.iter().filter_map(|element| element.name.as_ref());
    let fits = |text: &str| Candidate { text: text.to_owned(), refused: None };
    let mut list: Vec<_> = names.map(|name| fits(&name.text)).collect();
    list.push(fits("terminate"));
    let ignored = matches!(kind, ExitKind::Event | ExitKind::Missed);
    let refused = (!ignored).then(|| "only events can be ignored".to_owned());
    list.push(Candidate { text: "ignore".to_owned(), refused });
    Some(list)
}

/// Exits of every component, which the outline lists only if they are connected.
fn of_word(outcome: &str) -> Option<ExitKind> {
    match outcome {
        "Error" => Some(ExitKind::Error),
        "DeadlineMissed" => Some(ExitKind::Missed),
        _ => None,
    }
}

/// Returns the candidates for a port; `None` without such a component or port.
pub fn of_port(view: &View, item: &Item, port: &str) -> Option<PortCandidates> {
    let (plan, component) = component(view, item)?;
    if let Some(input) = component.inputs.iter().find(|input| *input.name == *port) {
        return Some(of_input(&plan.entries, input));
    }
    let output = component.outputs.iter().find(|output| *output.name == *port)?;
    let entries = plan.entries.iter().filter_map(|entry| {
        let text = entry.name.as_ref()?.text.clone();
        let refused = match entry.kind {
            EntryKind::In | EntryKind::Const => {
                Some(format!("'{text}' cannot be changed by the plan"))
            }
            EntryKind::Out | EntryKind::Var => differs(entry.ty.as_ref(), output.ty.as_ref()),
        };
        Some(Candidate { text, refused })
    });
    let ty = output.ty.as_ref().map(Type::to_string).unwrap_or_default();
    let bound = output.binding.as_ref().and_then(|it| it.value.as_ref());
    let value = bound.map(|value| value.text.clone());
    let mut list: Vec<_> = entries.collect();
    list.sort_by_key(|candidate| candidate.refused.is_some());
    Some(PortCandidates { list, ty, value, ..PortCandidates::default() })
}

fn component<'a>(
    view: &View<'a>,
    item: &Item,
) -> Option<(&'a afp_dsl::outline::Plan, &'a Component)> {
    let plan = view.outline().plan_of(view.file, item)?;
    Some((plan, plan.component(item)?))
}

/// The reason why a type does not fit another one; `None` if it fits, or if one is unknown.
fn differs(own: Option<&Type>, wanted: Option<&Type>) -> Option<String> {
    let (own, wanted) = (own?, wanted?);
    let fits = match (own, wanted) {
        (_, Type::Any) => true,
        (own, Type::Number) => own.is_numeric(),
        (Type::Int, Type::Quantity(dimension)) => *dimension == Dimension::NONE,
        _ => own == wanted,
    };
    (!fits).then(|| format!("it is of type '{own}', not '{wanted}'"))
}

fn of_input(entries: &[Entry], input: &Input) -> PortCandidates {
    let ty = input.ty.as_ref();
    let candidates = entries.iter().filter_map(|entry| {
        let text = entry.name.as_ref()?.text.clone();
        Some(Candidate { text, refused: differs(entry.ty.as_ref(), ty) })
    });
    let mut list: Vec<_> = candidates.collect();
    let value = |text: String| Candidate { text, refused: None };
    match ty {
        Some(Type::Bool) => list.extend(["true", "false"].map(|text| value(text.to_owned()))),
        Some(Type::Enum(choices)) => {
            list.extend(choices.variants.iter().map(|it| value(format!("{}.{it}", choices.name))));
        }
        _ => {}
    }
    list.sort_by_key(|candidate| candidate.refused.is_some());
    let dimension = match ty {
        Some(Type::Quantity(dimension)) => Some(*dimension),
        _ => None,
    };
    let unit = dimension.map(Dimension::usual_unit).unwrap_or_default();
    let units = dimension.map(units).unwrap_or_default();
    let bound_to = input.binding.as_ref().and_then(|it| it.value.as_ref());
    PortCandidates {
        list,
        ty: ty.map(Type::to_string).unwrap_or_default(),
        value: bound_to.map(|value| value.text.clone()),
        default: input.default.as_ref().map(|default| constant(default, ty)),
        range: input.range.map(|(from, to)| (bound(from, ty), bound(to, ty))),
        step: step(input, &unit),
        scales: units.iter().map(|unit| worth(unit)).collect(),
        units,
        unit,
    }
}

fn worth(unit: &str) -> f64 {
    let one = Literal::parse(&format!("1 {unit}")).and_then(|literal| literal.value());
    one.filter(|one| *one > 0.0).unwrap_or(1.0)
}

/// About a tenth of the default, at most a hundredth of the range, rounded to 1, 2 or 5 times a
/// power of ten.
fn step(input: &Input, unit: &str) -> Option<f64> {
    use afp_dsl::toolbox::Constant;

    match &input.ty {
        Some(Type::Int) => return Some(1.0),
        Some(Type::Quantity(_) | Type::Number) => {}
        _ => return None,
    }
    let one = worth(unit);
    let default = match input.default {
        Some(Constant::Float(value)) if value != 0.0 => Some(value.abs() / 10.0),
        _ => None,
    };
    let range =
        input.range.map(|(from, to)| (to - from) / 100.0).filter(|it| it.is_finite() && *it > 0.0);
    let about = match (default, range) {
        (Some(default), Some(range)) => default.min(range),
        (known, other) => known.or(other).unwrap_or(one),
    };
    Some(round(about / one))
}

/// Rounds a positive number down to 1, 2 or 5 times a power of ten.
fn round(value: f64) -> f64 {
    let mut power = 1.0;
    while power * 10.0 <= value {
        power *= 10.0;
    }
    while power > value && power > 1e-9 {
        power /= 10.0;
    }
    let least = [5.0, 2.0].into_iter().find(|digit| digit * power <= value);
    // A quotient of powers of ten adds no digits.
    let step = least.unwrap_or(1.0) * power;
    (step * 1e9).round() / 1e9
}
