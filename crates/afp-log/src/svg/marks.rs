//! Symbols for the kinds of events.

use std::collections::BTreeSet;

use afp_core::trace::{ComponentId, ComponentKind, Names, Outcome, declared};
use afp_session::Mark;

use super::canvas::Canvas;

const SYMBOLS: usize = 12;

/// The kinds of events with symbols, in the order of the plan: all that lead somewhere, so that
/// each has the same symbol in every run. In a plan with more kinds than symbols, only those that
/// happened.
pub(super) fn kinds(marks: &[Mark], names: &dyn Names) -> Vec<(ComponentId, Outcome)> {
    let supervisors = (0..names.components()).map(ComponentId);
    let supervisors =
        supervisors.filter(|id| names.component(*id).kind == ComponentKind::Supervisor);
    let events = |id: ComponentId| {
        let known = declared(names, id).map(|(event, _)| event);
        known.filter(move |event| !matches!(names.target(id, *event), "" | "ignore"))
    };
    let all = supervisors.flat_map(|id| events(id).map(move |event| (id, event)));
    // Elements may have their own edges for them.
    let elements = (0..names.components()).map(ComponentId);
    let reactions = elements.flat_map(|id| (0..).map_while(move |n| names.reaction(id, n)));
    let reactions = reactions.filter(|edge| !matches!(edge.target, "" | "ignore"));
    let reactions = reactions.map(|edge| (edge.supervisor, edge.outcome));
    let all: BTreeSet<_> = all.chain(reactions).collect();
    let came: BTreeSet<_> = marks.iter().map(|mark| (mark.supervisor, mark.event)).collect();
    match all.len() <= SYMBOLS && came.is_subset(&all) {
        true => all.into_iter().collect(),
        false => came.into_iter().collect(),
    }
}

/// A kind with more events than this has small symbols, so that the path stays visible.
const OFTEN: usize = 12;
const SMALL: f64 = 0.45;

/// Draws each mark at its place, with the symbol of its kind; small symbols below others.
pub(super) fn draw(canvas: &mut Canvas, marks: &[Mark], kinds: &[(ComponentId, Outcome)]) {
    let is = |kind: &(ComponentId, Outcome), mark: &Mark| *kind == (mark.supervisor, mark.event);
    let count = |kind| marks.iter().filter(|mark| is(kind, mark)).count();
    let (often, seldom): (Vec<_>, Vec<_>) =
        kinds.iter().enumerate().partition(|(_, kind)| count(kind) > OFTEN);
    for (kinds, size) in [(often, SMALL), (seldom, 1.0)] {
        for (symbol, kind) in kinds {
            let marks = marks.iter().filter(|mark| is(kind, mark));
            marks.for_each(|mark| canvas.mark(mark.pose, symbol, size, mark.at));
        }
    }
}

/// The kinds that happened with their symbols, by name, and their counts.
pub(super) fn counted<'a>(
    marks: &'a [Mark],
    kinds: &'a [(ComponentId, Outcome)],
    names: &'a dyn Names,
) -> impl Iterator<Item = (usize, String, usize)> + 'a {
    let counted = kinds.iter().enumerate().map(|(symbol, &(id, event))| {
        let same = marks.iter().filter(|mark| (mark.supervisor, mark.event) == (id, event));
        let name = format!("{}.{}", names.component(id).path, names.outcome(id, event));
        (symbol, name, same.count())
    });
    counted.filter(|(_, _, count)| *count > 0)
}
