//! What was drawn before and is not there now: undone, it comes back to where it stood.

use super::{EdgeScene, ElementScene, PlanScene};

/// So many elements, and so many edges, are remembered; those that went first are forgotten first.
const MOST: usize = 256;

/// Elements and edges that were in the scenes before, those that went last at the end.
#[derive(Clone, Debug, Default)]
pub(super) struct Gone {
    elements: Vec<ElementScene>,
    edges: Vec<EdgeScene>,
}

impl Gone {
    /// What was there before and is not among these.
    pub(super) fn since(
        before: &PlanScene,
        elements: &[ElementScene],
        edges: &[EdgeScene],
    ) -> Gone {
        let is_there = |one: &ElementScene| elements.iter().any(|other| other.item == one.item);
        let is_led = |one: &EdgeScene| {
            edges.iter().any(|other| (&other.item, &other.part) == (&one.item, &one.part))
        };
        Gone {
            elements: without(&before.gone.elements, &before.elements, is_there),
            edges: without(&before.gone.edges, &before.edges, is_led),
        }
    }

    pub(super) fn elements(&self) -> impl Iterator<Item = &ElementScene> {
        self.elements.iter()
    }

    pub(super) fn edges(&self) -> impl Iterator<Item = &EdgeScene> {
        self.edges.iter()
    }
}

/// What of two lists is not there, the newest of it.
fn without<T: Clone>(gone: &[T], before: &[T], is_there: impl Fn(&T) -> bool) -> Vec<T> {
    let left: Vec<_> = gone.iter().chain(before).filter(|one| !is_there(one)).collect();
    left[left.len().saturating_sub(MOST)..].iter().map(|one| (*one).clone()).collect()
}
