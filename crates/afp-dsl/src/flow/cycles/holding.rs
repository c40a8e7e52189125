//! Which conditions can hold while an element is entered, and which never hold together.
//!
//! Nobody declares what templates do; of some the meaning is known.

use std::collections::BTreeSet;

use afp_types::{MAX_TEXT, Meaning};

use crate::flow::strong;
use crate::flow::view::{Cause, Edge, View};
use crate::graph::{Component, Element, EntryId, Formula, Op, Output, Part, Supervisor};
use crate::toolbox::Case;
use crate::types::{Constant, Conversion, Type};

/// The event of a limit that reports a value below its limit; the other one reports one above.
const BELOW: u16 = 0;

/// Whether an edge can be taken in the look, or by the start of an element.
pub(super) fn can_hold(view: &View<'_>, cause: Cause) -> bool {
    match cause {
        Cause::Event(id, event) => !view.is_once(id, event) && !waits(view, view.supervisor(id)),
        Cause::Error(id) => can_fail(view, &view.plan.elements[id.index()]),
        _ => true,
    }
}

/// Whether a supervisor reports something only after some time.
fn waits(view: &View<'_>, supervisor: &Supervisor) -> bool {
    if view.template(supervisor).meaning != Some(Meaning::TimesOut) {
        return false;
    }
    let time = supervisor.inputs.first().and_then(|time| view.constant(time));
    matches!(time, Some(Constant::Float(time)) if time > 0.0)
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
    let declared = view.cases(element).is_some_and(|cases| cases.iter().all(Case::never_fails));
    declared || view.meaning(element) == Some(Meaning::Selects)
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

/// Whether a conversion takes every value. A number has texts of more than a text's length.
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

/// What conditions compare.
#[derive(Clone, Copy)]
enum Term {
    Number(f64),
    Named(Name),
}

/// An entry, or what a sensor reads.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Name {
    Entry(EntryId),
    /// What supervisors of a meaning read, and which of several values.
    Reading(Meaning, u64),
}

/// Whether the conditions of a cycle never hold together: one value above a limit and below another one.
pub(in crate::flow) fn contradict(view: &View<'_>, cycle: &[Edge]) -> bool {
    let outputs = cycle.iter().flat_map(|edge| view.may_write(edge.cause));
    let written: BTreeSet<EntryId> = outputs.map(|output| output.entry).collect();
    let stays = |term: Term| !matches!(term, Term::Named(Name::Entry(it)) if written.contains(&it));
    let less = cycle.iter().flat_map(|edge| less(view, edge.cause));
    goes_round(&less.filter(|(a, b)| stays(*a) && stays(*b)).collect::<Vec<_>>())
}

/// Whether a term would have to be less than itself, where each number is less than the next.
fn goes_round(less: &[(Term, Term)]) -> bool {
    let (mut numbers, mut names) = (Vec::new(), Vec::new());
    for term in less.iter().flat_map(|(a, b)| [a, b]) {
        match term {
            Term::Number(number) => numbers.push(*number),
            Term::Named(name) => names.push(*name),
        }
    }
    numbers.sort_by(f64::total_cmp);
    numbers.dedup();
    names.sort_unstable();
    names.dedup();
    let place = |term: &Term| match term {
        Term::Number(number) => numbers.partition_point(|other| other < number),
        Term::Named(name) => numbers.len() + names.partition_point(|other| other < name),
    };
    let ordered = (1..numbers.len()).map(|at| (at - 1, at));
    let mut edges: Vec<_> = less.iter().map(|(a, b)| (place(a), place(b))).chain(ordered).collect();
    edges.sort_unstable();
    let nodes = numbers.len() + names.len();
    let first = strong::first(nodes, edges.iter().map(|(from, _)| *from));
    let targets: Vec<u32> = edges.iter().map(|(_, to)| *to as u32).collect();
    let component = strong::components(&first, &targets);
    edges.iter().any(|(from, to)| component[*from] == component[*to])
}

/// Of what a supervisor compares, which is less than which when its event comes.
fn less(view: &View<'_>, cause: Cause) -> Vec<(Term, Term)> {
    let (Cause::Event(id, event) | Cause::On(_, id, Some(event))) = cause else {
        return Vec::new();
    };
    let supervisor = view.supervisor(id);
    let meaning = view.template(supervisor).meaning;
    meaning.and_then(|meaning| compared(view, meaning, supervisor, event)).unwrap_or_default()
}

fn compared(
    view: &View<'_>,
    meaning: Meaning,
    supervisor: &Supervisor,
    event: u16,
) -> Option<Vec<(Term, Term)>> {
    let input = |at: usize| term(view, supervisor.inputs.get(at)?);
    let number = |at: usize| match input(at)? {
        Term::Number(number) => Some(number),
        Term::Named(_) => None,
    };
    let reading = |which: u64| Term::Named(Name::Reading(meaning, which));
    let (value, limit) = match meaning {
        Meaning::Limits => (input(0)?, input(1)?),
        Meaning::LooksFar => (reading(number(0)?.to_bits()), input(1)?),
        Meaning::SeesDark => (reading(0), input(0)?),
        Meaning::SeesColor => {
            let off = number(3)?;
            let near = |channel: u8| {
                let share = number(usize::from(channel))?;
                let (value, number) = (reading(u64::from(channel)), Term::Number);
                Some([(number(share - off), value), (value, number(share + off))])
            };
            return Some([near(0)?, near(1)?, near(2)?].concat());
        }
        _ => return None,
    };
    // An infrared light is seen first.
    let is_below = (event == BELOW) != (meaning == Meaning::SeesDark);
    Some(vec![if is_below { (value, limit) } else { (limit, value) }])
}

fn term(view: &View<'_>, formula: &Formula) -> Option<Term> {
    match view.constant(formula) {
        Some(Constant::Int(number)) => Some(Term::Number(number as f64)),
        Some(Constant::Float(number)) => Some(Term::Number(number)),
        Some(_) => None,
        None => entry(formula.part()).map(|entry| Term::Named(Name::Entry(entry))),
    }
}

/// The entry that a formula reads, and nothing else.
fn entry(part: Part<'_>) -> Option<EntryId> {
    match part.op() {
        Op::Entry(id) => Some(*id),
        Op::Convert(_) => entry(part.operand()?),
        _ => None,
    }
}
