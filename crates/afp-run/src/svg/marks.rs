//! Symbols for events, one for each kind that was taken.

use std::collections::BTreeSet;

use afp_core::trace::{ComponentId, ERROR, Kind, Names};
use afp_session::Mark;

use super::canvas::Canvas;

/// So many kinds of events have a symbol of their own.
const SYMBOLS: usize = 12;

/// The kinds of events that have symbols, in the order of the plan: all that lead somewhere, so that one has the same
/// symbol in every run; in a plan with more of them than symbols those that came.
pub(super) fn kinds(marks: &[Mark], names: &dyn Names) -> Vec<(ComponentId, u16)> {
    let supervisors = (0..names.components()).map(ComponentId);
    let supervisors = supervisors.filter(|id| names.component(*id).kind == Kind::Supervisor);
    let events = |id: ComponentId| {
        let known = (0..ERROR).take_while(move |event| !names.outcome(id, *event).is_empty());
        known.filter(move |event| !matches!(names.target(id, *event), "" | "ignore"))
    };
    let all = supervisors.flat_map(|id| events(id).map(move |event| (id, event)));
    let all: BTreeSet<_> = all.collect();
    let came: BTreeSet<_> = marks.iter().map(|mark| (mark.supervisor, mark.event)).collect();
    match all.len() <= SYMBOLS && came.is_subset(&all) {
        true => all.into_iter().collect(),
        false => came.into_iter().collect(),
    }
}

/// Draws each mark where it was taken, with the symbol of its kind.
pub(super) fn draw(canvas: &mut Canvas, marks: &[Mark], kinds: &[(ComponentId, u16)]) {
    for mark in marks {
        let kind = kinds.iter().position(|kind| *kind == (mark.supervisor, mark.event));
        canvas.mark(mark.pose, kind.unwrap_or(0), mark.at);
    }
}

/// The kinds that came with their symbols, by their names, and how often each came.
pub(super) fn counted<'a>(
    marks: &'a [Mark],
    kinds: &'a [(ComponentId, u16)],
    names: &'a dyn Names,
) -> impl Iterator<Item = (usize, String, usize)> + 'a {
    let counted = kinds.iter().enumerate().map(|(symbol, &(id, event))| {
        let same = marks.iter().filter(|mark| (mark.supervisor, mark.event) == (id, event));
        let name = format!("{}.{}", names.component(id).path, names.outcome(id, event));
        (symbol, name, same.count())
    });
    counted.filter(|(_, _, count)| *count > 0)
}

/// The symbol of a kind, around a point in pixels.
pub(super) fn symbol(kind: usize, x: f64, y: f64) -> String {
    // After six kinds the shapes come again, filled.
    let fill = if kind / 6 % 2 == 1 { " fill=\"#2b2b2b\"" } else { "" };
    let polygon = |corners: &[(f64, f64)]| {
        let points = corners.iter().map(|(dx, dy)| format!("{:.1},{:.1}", x + dx, y + dy));
        format!("<polygon{fill} points=\"{}\"/>", points.collect::<Vec<_>>().join(" "))
    };
    match kind % 6 {
        0 => polygon(&[(0.0, -7.0), (7.0, 6.0), (-7.0, 6.0)]),
        1 => format!("<circle{fill} cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"5.6\"/>"),
        2 => polygon(&[(-5.2, -5.2), (5.2, -5.2), (5.2, 5.2), (-5.2, 5.2)]),
        3 => polygon(&[(0.0, -7.5), (7.5, 0.0), (0.0, 7.5), (-7.5, 0.0)]),
        4 => polygon(&[(0.0, 7.0), (7.0, -6.0), (-7.0, -6.0)]),
        _ => {
            polygon(&[(-3.0, -6.5), (3.0, -6.5), (6.5, 0.0), (3.0, 6.5), (-3.0, 6.5), (-6.5, 0.0)])
        }
    }
}
