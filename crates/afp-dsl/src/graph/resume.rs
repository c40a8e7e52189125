//! Computations that reach `resume`, `suspend` or `return` through computations only: an event that
//! leads to one of the first two does not interrupt until the end of the chain is known.

use crate::graph::{Component, Element, ElementId, Target};
use rustc_hash::FxHashSet;

/// Targets of an element's states and of its `Error`.
fn targets(element: &Element) -> impl Iterator<Item = Target> {
    element.states.iter().flatten().copied().chain(element.on_error)
}

fn is_computation(element: &Element) -> bool {
    matches!(element.component, Component::Computation(_))
}

/// The computations of a plan that can resume or suspend; elements with errors are `None`.
pub(crate) fn resuming<'a>(elements: impl IntoIterator<Item = Option<&'a Element>>) -> Vec<bool> {
    reaching(elements, |target| matches!(target, Target::Resume | Target::Suspend(_)))
}

/// The computations of a plan that can return; elements with errors are `None`.
pub(crate) fn returning<'a>(elements: impl IntoIterator<Item = Option<&'a Element>>) -> Vec<bool> {
    reaching(elements, |target| target == Target::Return)
}

/// The computations that reach such a target through computations only.
fn reaching<'a>(
    elements: impl IntoIterator<Item = Option<&'a Element>>,
    is_goal: impl Fn(Target) -> bool,
) -> Vec<bool> {
    let elements: Vec<_> = elements.into_iter().collect();
    let mut before: Vec<Vec<usize>> = vec![Vec::new(); elements.len()];
    let mut open = Vec::new();
    for (index, element) in elements.iter().enumerate() {
        let Some(element) = element.filter(|element| is_computation(element)) else { continue };
        for target in targets(element) {
            match target {
                goal if is_goal(goal) => open.push(index),
                Target::Element(id) => {
                    before.get_mut(id.index()).into_iter().for_each(|list| list.push(index));
                }
                _ => {}
            }
        }
    }
    let mut reaching = vec![false; elements.len()];
    while let Some(index) = open.pop() {
        if !std::mem::replace(&mut reaching[index], true) {
            open.extend(&before[index]);
        }
    }
    reaching
}

/// The computations that an edge may run before it resumes or leads elsewhere, without duplicates;
/// and whether any of their edges leads elsewhere.
pub(crate) fn chain(elements: &[Element], first: Target) -> (Vec<ElementId>, bool) {
    // Most edges lead to elements that take time, and need no allocation.
    let (mut run, mut elsewhere, mut open) = (Vec::new(), false, Vec::new());
    let mut seen = FxHashSet::default();
    let mut next = Some(first);
    while let Some(target) = next {
        match target {
            Target::Element(id) => match elements.get(id.index()) {
                Some(element) if is_computation(element) => {
                    if seen.insert(id) {
                        run.push(id);
                        open.extend(targets(element));
                    }
                }
                _ => elsewhere = true,
            },
            Target::Terminate | Target::Fail(_) | Target::Suspend(_) | Target::Return => {
                elsewhere = true;
            }
            Target::Ignore | Target::Resume => {}
        }
        next = open.pop();
    }
    (run, elsewhere)
}
