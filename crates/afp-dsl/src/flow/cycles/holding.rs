//! Which conditions can hold while an element is entered.

use afp_types::MAX_TEXT;

use super::facts;
use crate::flow::view::{Cause, View};
use crate::graph::{Component, Element, Formula, Op, Output, Part};
use crate::toolbox::Case;
use crate::types::{Conversion, Type};

/// Whether an edge can be taken in the look, or by the start of an element.
pub(super) fn can_hold(view: &View<'_>, cause: Cause) -> bool {
    match cause {
        Cause::Event(id, event) => {
            let time = facts::earliest(view, (id, event), 0.0);
            !view.is_once(id, event) && time.is_none_or(|time| time <= 0.0)
        }
        Cause::Error(id) => can_fail(view, &view.plan.elements[id.index()]),
        _ => true,
    }
}

/// Whether the start of an element can fail: it commands something, or computes what it needs or writes.
fn can_fail(view: &View<'_>, element: &Element) -> bool {
    let (Component::Actor(id) | Component::Computation(id)) = element.component else {
        return true;
    };
    if is_known(view, element) {
        return !never_fails(view, element);
    }
    let computes = element.inputs.iter().any(|input| view.constant(input).is_none());
    // An actor writes in the end.
    let writes = !element.takes_time() && !element.outputs.iter().all(|it| fits(view, it));
    computes || writes || !view.model.template(id).uses.is_empty()
}

/// Whether a computation surely has no fault: it has none of its own, and neither what goes into it nor what comes out
/// of it can be wrong.
pub(super) fn never_fails(view: &View<'_>, element: &Element) -> bool {
    is_known(view, element)
        && element.inputs.iter().all(|input| is_plain(view, input))
        && element.outputs.iter().all(|output| fits(view, output))
}

/// Whether a computation is known to have no fault of its own.
pub(super) fn is_known(view: &View<'_>, element: &Element) -> bool {
    view.cases(element).is_some_and(|cases| cases.iter().all(Case::never_fails))
}

/// Whether an output takes every value.
fn fits(view: &View<'_>, output: &Output) -> bool {
    let entry = view.plan.entries.get(output.entry.index());
    entry.is_some_and(|entry| entry.range.is_none() && entry.ranged_by.is_empty())
        && output.conversion.as_ref().is_none_or(always_converts)
}

/// Whether a formula is a constant or an entry, so that nothing can go wrong with it.
fn is_plain(view: &View<'_>, formula: &Formula) -> bool {
    let mut part = Some(formula.part());
    while let Some(Op::Convert(conversion)) = part.map(Part::op)
        && always_converts(conversion)
    {
        part = part.and_then(Part::operand);
    }
    matches!(part.map(Part::op), Some(Op::Entry(_))) || view.constant(formula).is_some()
}

/// Whether a conversion takes every value. A number may need more characters than a string holds.
fn always_converts(conversion: &Conversion) -> bool {
    match conversion {
        Conversion::FloatToInt | Conversion::FromText(_) => false,
        Conversion::ToText(ty) => match ty {
            Type::Enum(choices) => choices.variants.iter().all(|name| name.len() <= MAX_TEXT),
            ty => matches!(ty, Type::Bool | Type::Int | Type::Text),
        },
        Conversion::IntToFloat | Conversion::BoolToInt | Conversion::BoolToFloat => true,
    }
}
