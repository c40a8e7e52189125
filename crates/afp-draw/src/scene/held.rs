//! Boxes that have positions: one whose position is taken away again goes back to where it stood without it.

use rustc_hash::FxHashMap;

use super::{PlanScene, Point};
use crate::view::View;
use afp_syntax::item::Item;

/// The boxes of a scene that have positions, each with where it stood before it had one, where that is known.
#[derive(Clone, Debug, Default)]
pub(super) struct Held(FxHashMap<Item, Option<Point>>);

impl Held {
    /// Those of a plan, of which there was a scene before.
    pub(super) fn since(before: Option<&PlanScene>, view: &View) -> Held {
        let stood = |item: &Item| {
            let before = before?;
            match before.held.0.get(item) {
                Some(stood) => *stood,
                None => {
                    let known = before.elements.iter().find(|element| element.item == *item)?;
                    Some((known.rect.x, known.rect.y))
                }
            }
        };
        let elements = view.plan.elements.iter().map(|element| element.item.clone());
        let items = std::iter::once(view.start_item()).chain(elements);
        let held = items.filter(|item| view.position(item).is_some());
        Held(held.map(|item| (item.clone(), stood(&item))).collect())
    }

    /// Whether a box stands where it is because it has a position.
    pub(super) fn has(&self, item: &Item) -> bool {
        self.0.contains_key(item)
    }

    /// Where the boxes stood before.
    pub(super) fn stood(&self) -> impl Iterator<Item = (&Item, Point)> {
        self.0.iter().filter_map(|(item, stood)| Some((item, (*stood)?)))
    }
}
