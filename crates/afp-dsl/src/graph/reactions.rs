//! Reactions of elements to global supervisors.
//!
//! There is one supervisor for all elements; only the targets of its events depend on the active
//! element.

use crate::graph::{EdgeSpans, Element, ElementId, Plan, SupervisorId, Target};
use afp_syntax::source::Span;

/// The edges of a global supervisor that an element replaces while it is active or being entered.
#[derive(Clone, Debug)]
pub struct Reactions {
    pub supervisor: SupervisorId,
    /// A target for each event of the template; `None` for the supervisor's own.
    pub events: Vec<Option<Target>>,
    /// Target of `DeadlineMissed`; `None` for the supervisor's own.
    pub on_miss: Option<Target>,
    /// The supervisor's name after `on`.
    pub span: Span,
    pub edges: EdgeSpans,
}

impl Reactions {
    /// The target of an event or missed deadline; `None` for the supervisor's own.
    pub fn target(&self, event: Option<u16>) -> Option<Target> {
        match event {
            Some(event) => self.events.get(usize::from(event)).copied().flatten(),
            None => self.on_miss,
        }
    }

    pub fn targets(&self) -> impl Iterator<Item = Target> {
        self.events.iter().copied().chain([self.on_miss]).flatten()
    }
}

impl Element {
    pub fn reactions_to(&self, supervisor: SupervisorId) -> Option<&Reactions> {
        self.reactions.iter().find(|each| each.supervisor == supervisor)
    }
}

impl Plan {
    pub fn reacting(
        &self,
        supervisor: SupervisorId,
    ) -> impl Iterator<Item = (ElementId, &Reactions)> {
        let is_global = supervisor.0 < self.globals;
        let elements = if is_global { &self.elements[..] } else { &[] };
        let elements = (0..).map(ElementId).zip(elements);
        elements.filter_map(move |(id, each)| Some((id, each.reactions_to(supervisor)?)))
    }

    /// All possible targets of a supervisor's edges.
    pub fn targets(&self, supervisor: SupervisorId) -> impl Iterator<Item = Target> {
        let own = &self.supervisors[supervisor.index()];
        let others = self.reacting(supervisor).flat_map(|(_, table)| table.targets());
        own.events.iter().copied().chain(own.on_miss).chain(others)
    }

    /// For each element, whether it is a handler: whether some edge suspends to it.
    pub fn handlers(&self) -> Vec<bool> {
        let mut handlers = vec![false; self.elements.len()];
        let supervisors = (0..=u16::MAX).map(SupervisorId).take(self.supervisors.len());
        let states =
            self.elements.iter().flat_map(|it| it.states.iter().flatten().chain(&it.on_error));
        for target in supervisors.flat_map(|id| self.targets(id)).chain(states.copied()) {
            if let Target::Suspend(id) = target
                && let Some(handler) = handlers.get_mut(id.index())
            {
                *handler = true;
            }
        }
        handlers
    }

    /// Targets of a supervisor's events while an element is active or being entered.
    pub fn events_at(&self, supervisor: SupervisorId, element: ElementId) -> Vec<Target> {
        let own = &self.supervisors[supervisor.index()].events;
        match self.elements[element.index()].reactions_to(supervisor) {
            Some(table) => {
                let both = own.iter().zip(&table.events);
                both.map(|(own, here)| here.unwrap_or(*own)).collect()
            }
            None => own.clone(),
        }
    }

    /// Target of a supervisor's `DeadlineMissed` at that element.
    pub fn miss_at(&self, supervisor: SupervisorId, element: ElementId) -> Option<Target> {
        let table = self.elements[element.index()].reactions_to(supervisor);
        let own = self.supervisors[supervisor.index()].on_miss;
        table.and_then(|table| table.on_miss).or(own)
    }
}
