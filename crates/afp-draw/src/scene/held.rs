//! Boxes that have positions: one whose position is taken away again goes back to where it stood without it, and so do those
//! that gave way to it.

use rustc_hash::FxHashMap;

use super::{ElementScene, PlanScene, Point};
use crate::sketch::Rect;
use crate::view::View;
use afp_syntax::item::Item;

/// What of a scene stands where it does because of positions.
#[derive(Clone, Debug, Default)]
pub(super) struct Held {
    /// The boxes that have positions, each with where it stood before it had one, where that is known.
    placed: FxHashMap<Item, Option<Point>>,
    /// Where others stood before they gave way to those.
    pushed: FxHashMap<Item, Point>,
}

/// How far a box may seem to have moved that has not, in pixels.
const SAME: f64 = 0.5;

impl Held {
    /// Those of a plan whose boxes stand at their places, and of which there was a scene before.
    pub(super) fn since(
        before: Option<&PlanScene>,
        view: &View,
        elements: &[ElementScene],
    ) -> Held {
        let (placed, loose): (Vec<_>, Vec<_>) =
            elements.iter().partition(|element| view.position(&element.item).is_some());
        let known = |item: &Item| before?.elements.iter().find(|element| element.item == *item);
        let stood = |item: &Item| match before?.held.placed.get(item) {
            Some(stood) => *stood,
            None => known(item).map(corner),
        };
        let pushed = loose.into_iter().filter_map(|element| {
            let last = before?;
            let was = known(&element.item).filter(|_| !last.held.has(&element.item))?;
            let once = last.held.pushed.get(&element.item).copied();
            let origin = match moved(was, element) {
                true if placed.iter().any(|other| meet(&was.outer, &other.outer)) => {
                    once.unwrap_or(corner(was))
                }
                _ => once?,
            };
            let is_back = apart(origin, corner(element)) < SAME;
            (!is_back).then(|| (element.item.clone(), origin))
        });
        let pushed = pushed.collect();
        let placed = placed.iter().map(|element| (element.item.clone(), stood(&element.item)));
        Held { placed: placed.collect(), pushed }
    }

    /// Whether a box stands where it is because it has a position.
    pub(super) fn has(&self, item: &Item) -> bool {
        self.placed.contains_key(item)
    }

    /// Where the boxes that have positions stood before.
    pub(super) fn stood(&self) -> impl Iterator<Item = (&Item, Point)> {
        self.placed.iter().filter_map(|(item, stood)| Some((item, (*stood)?)))
    }

    /// Where others stood before they gave way.
    pub(super) fn origins(&self) -> impl Iterator<Item = (&Item, Point)> {
        self.pushed.iter().map(|(item, origin)| (item, *origin))
    }
}

fn corner(element: &ElementScene) -> Point {
    (element.rect.x, element.rect.y)
}

fn moved(was: &ElementScene, now: &ElementScene) -> bool {
    apart(corner(was), corner(now)) >= SAME
}

fn apart(one: Point, other: Point) -> f64 {
    (one.0 - other.0).hypot(one.1 - other.1)
}

/// Whether one of two boxes has to give way to the other.
fn meet(one: &Rect, other: &Rect) -> bool {
    let near = crate::layout::NEAR;
    one.x < other.right() + near
        && other.x < one.right() + near
        && one.y < other.bottom() + near
        && other.y < one.bottom() + near
}
