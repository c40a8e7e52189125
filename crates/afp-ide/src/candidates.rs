//! Candidates for an exit's target, for a port's binding and for an entry's value.

mod reading;

use crate::View;
use crate::describe::{bound, units};
use afp_draw::formula::constant;
use afp_dsl::graph::EntryKind;
use afp_dsl::outline::{Component, Entry, ExitKind, Input};
use afp_dsl::toolbox::Constant;
use afp_dsl::types::text::worth;
use afp_dsl::types::{Dimension, Type};
use afp_syntax::item::Item;
use afp_syntax::literal::Literal;
use serde::Serialize;

pub use reading::{Control, Reading};
use reading::{Scale, round};

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
    /// Whether a run accepts values from clients: for an `in` or `var` entry.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub writable: bool,
    /// The value, or another text in its field.
    pub reading: Reading,
    #[serde(skip)]
    scale: Scale,
}

impl PortCandidates {
    /// Replaces the text in the field and then uses a control.
    pub fn with_text(mut self, text: Option<&str>, control: Option<&Control>) -> PortCandidates {
        let text = text.unwrap_or(&self.reading.text);
        let after = control.map(|control| self.scale.after(text, control));
        self.reading = self.scale.read(after.as_deref().unwrap_or(text));
        self
    }
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
            EntryKind::In | EntryKind::Const => Some(format!("the plan cannot change '{text}'")),
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
    list.extend(choices(ty));
    list.sort_by_key(|candidate| candidate.refused.is_some());
    let bound_to = input.binding.as_ref().and_then(|it| it.value.as_ref());
    let value = bound_to.map(|value| value.text.clone());
    let default = input.default.as_ref().map(|default| constant(default, ty));
    let usual = match input.default {
        Some(Constant::Float(value)) => Some(value),
        _ => None,
    };
    PortCandidates { list, ..of_value(ty, value, default, usual, input.range) }
}

/// Returns the candidates for the initial value of an entry; `None` without such an entry.
///
/// The range of an entry without one is that of the inputs that read the entry, or else reaches
/// from zero to twice the initial value.
pub fn of_entry(view: &View, item: &Item) -> Option<PortCandidates> {
    let plan = view.outline().plan_of(view.file, item)?;
    let entry = plan.entries.iter().find(|entry| entry.item == *item)?;
    let name = &entry.name.as_ref()?.text;
    let si = |text: &str| Literal::parse(text).and_then(|literal| literal.value());
    let initial = entry.init.as_ref().and_then(|value| si(&value.text));
    let written = entry.range.as_ref();
    let written = written.and_then(|[from, to]| Some((si(&from.text)?, si(&to.text)?)));
    let inputs = plan.components().flat_map(|component| &component.inputs);
    let bound_to = |input: &&Input| {
        let value = input.binding.as_ref().and_then(|it| it.value.as_ref());
        value.is_some_and(|value| value.text == *name)
    };
    let ranges = inputs.filter(bound_to).filter_map(|input| input.range);
    let read = ranges.reduce(|one, other| (one.0.max(other.0), one.1.min(other.1)));
    let around = initial.map(|value| (0.0_f64.min(2.0 * value), 0.0_f64.max(2.0 * value)));
    let sliding =
        |range: &(f64, f64)| initial.is_none_or(|it| range.1 - range.0 <= 100.0 * it.abs());
    let range = written.or(read.filter(sliding)).or(around.filter(|(from, to)| from < to));
    let value = entry.init.as_ref().map(|value| value.text.clone());
    let found = of_value(entry.ty.as_ref(), value, None, initial, range);
    let writable = matches!(entry.kind, EntryKind::In | EntryKind::Var);
    Some(PortCandidates { list: choices(entry.ty.as_ref()).collect(), writable, ..found })
}

/// The values of a small type.
fn choices(ty: Option<&Type>) -> impl Iterator<Item = Candidate> {
    let texts = match ty {
        Some(Type::Bool) => vec!["true".to_owned(), "false".to_owned()],
        Some(Type::Enum(choices)) => {
            choices.variants.iter().map(|it| format!("{}.{it}", choices.name)).collect()
        }
        _ => Vec::new(),
    };
    texts.into_iter().map(|text| Candidate { text, refused: None })
}

/// A value without its candidates. `usual` is a typical value, in SI units like the range.
fn of_value(
    ty: Option<&Type>,
    value: Option<String>,
    default: Option<String>,
    usual: Option<f64>,
    range: Option<(f64, f64)>,
) -> PortCandidates {
    let dimension = match ty {
        Some(Type::Quantity(dimension)) => Some(*dimension),
        _ => None,
    };
    let unit = dimension.map(Dimension::usual_unit).unwrap_or_default();
    let one = worth(&unit).unwrap_or(1.0);
    let step = step(ty, usual, range, one);
    let units = dimension.map(units).unwrap_or_default();
    let scale = Scale { units: units.clone(), step, range };
    let reading = scale.read(value.as_ref().or(default.as_ref()).map_or("", String::as_str));
    PortCandidates {
        list: Vec::new(),
        ty: ty.map(Type::to_string).unwrap_or_default(),
        value,
        default,
        range: range.map(|(from, to)| (bound(from, ty), bound(to, ty))),
        step: step.map(|step| round(step / one)),
        units,
        unit,
        writable: false,
        reading,
        scale,
    }
}

/// About a tenth of the usual value, at most a hundredth of the range; without both, one unit.
fn step(ty: Option<&Type>, usual: Option<f64>, range: Option<(f64, f64)>, one: f64) -> Option<f64> {
    match ty {
        Some(Type::Int) => return Some(1.0),
        Some(Type::Quantity(_) | Type::Number) => {}
        _ => return None,
    }
    let usual = usual.filter(|value| *value != 0.0).map(|value| value.abs() / 10.0);
    let range =
        range.map(|(from, to)| (to - from) / 100.0).filter(|it| it.is_finite() && *it > 0.0);
    Some(match (usual, range) {
        (Some(usual), Some(range)) => usual.min(range),
        (known, other) => known.or(other).unwrap_or(one),
    })
}

#[cfg(test)]
mod tests {
    use super::{PortCandidates, of_entry};
    use crate::View;
    use afp_dsl::{Toolboxes, compile};
    use afp_syntax::item::Item;
    use afp_syntax::source::Source;

    const PLAN: &str = "use carbot
plan P {
    in  far:   length = 30 cm from 10 cm to 1 m
    var slow:  speed = 10 cm/s
    var turns: int = 3
    out done:  bool = false
    start go
    actor go: Forward(distance = far, speed = slow) { ForwardSuccessful -> terminate }
}
";

    fn of(name: &str) -> PortCandidates {
        let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
        let none = |_: &str| Err(String::new());
        let compiled = compile(&Source::new("p.afp", PLAN), &toolboxes, &none);
        let file = compiled.plan_files.start as u16;
        let view = View::new(&compiled, &toolboxes, file);
        of_entry(&view, &Item::inner("P", name)).expect("the entry exists")
    }

    #[test]
    fn an_entry_has_a_slider_in_its_range_in_that_of_its_readers_or_around_its_value() {
        let slider = |name: &str| {
            let found = of(name);
            (found.reading.slider, found.reading.unit, found.writable)
        };
        assert_eq!(slider("far"), (Some([10.0, 100.0]), "cm".to_owned(), true));
        assert_eq!(slider("turns"), (Some([0.0, 6.0]), String::new(), true));
        assert_eq!(slider("slow"), (Some([1.0, 31.0]), "cm/s".to_owned(), true));
        let done = of("done");
        let texts: Vec<_> = done.list.iter().map(|each| &*each.text).collect();
        assert_eq!((texts, done.writable), (vec!["true", "false"], false));
    }
}
