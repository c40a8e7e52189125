//! Symbols for events, one for each kind that was taken.

use afp_core::trace::{ComponentId, Names};
use afp_session::Mark;

use super::canvas::Canvas;

/// The kinds of events in the order in which they first came.
pub(super) fn kinds(marks: &[Mark]) -> Vec<(ComponentId, u16)> {
    let mut kinds = Vec::new();
    for mark in marks {
        let kind = (mark.supervisor, mark.event);
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    kinds
}

/// Draws each mark where it was taken, with the symbol of its kind.
pub(super) fn draw(canvas: &mut Canvas, marks: &[Mark], kinds: &[(ComponentId, u16)]) {
    for mark in marks {
        let kind = kinds.iter().position(|kind| *kind == (mark.supervisor, mark.event));
        canvas.mark(mark.pose, kind.unwrap_or(0), mark.at);
    }
}

/// The kinds by their names, and how often each came.
pub(super) fn counted<'a>(
    marks: &'a [Mark],
    kinds: &'a [(ComponentId, u16)],
    names: &'a dyn Names,
) -> impl Iterator<Item = (String, usize)> + 'a {
    kinds.iter().map(|&(id, event)| {
        let same = marks.iter().filter(|mark| (mark.supervisor, mark.event) == (id, event));
        (format!("{}.{}", names.component(id).path, names.outcome(id, event)), same.count())
    })
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
