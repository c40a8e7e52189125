//! Finds handlers, and computations that lead to `resume`, `suspend` or `return`.

use afp_core::rt::{ElementKind, Target};

use super::build::Spec;

impl Spec {
    pub fn is_handler(&self, index: usize) -> bool {
        let named = |to: &str| to.strip_prefix("suspend ") == Some(self.elements[index].name);
        let guards = self.elements.iter().flat_map(|element| &element.guards);
        let guards = guards.chain(&self.supervisors[..usize::from(self.globals)]);
        let misses = guards.clone().filter_map(|guard| guard.on_miss);
        let events = guards.flat_map(|guard| guard.events.iter().map(|(_, to)| *to));
        let elements = self.elements.iter().flat_map(|element| {
            let states = element.states.iter().map(|(_, to)| *to).chain(element.on_error);
            states.chain(element.reactions.iter().map(|(.., to)| *to))
        });
        events.chain(misses).chain(elements).any(named)
    }

    /// Whether an element is a computation that can reach a target through computations only.
    pub fn computes(
        &self,
        index: usize,
        seen: &mut Vec<usize>,
        wanted: fn(Target) -> bool,
    ) -> bool {
        let element = &self.elements[index];
        if element.kind != ElementKind::Computation || seen.contains(&index) {
            return false;
        }
        seen.push(index);
        let targets = element.states.iter().map(|(_, to)| *to).chain(element.on_error);
        targets.into_iter().any(|to| match self.target(to) {
            Target::Element(next) => self.computes(next.index(), seen, wanted),
            to => wanted(to),
        })
    }
}
