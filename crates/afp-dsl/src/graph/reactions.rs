//! What elements do instead where a supervisor of their plan reports something.
//!
//! There is one supervisor, whoever is active; only where its events lead depends on that.

use crate::graph::{EdgeSpans, Element, ElementId, Plan, SupervisorId, Target};
use afp_syntax::source::Span;

/// The edges of a global supervisor that an element replaces while it is active or being entered.
#[derive(Clone, Debug)]
pub struct Reactions {
    /// The global supervisor.
    pub supervisor: SupervisorId,
    /// One target for each event of the template; `None` where the supervisor's own holds.
    pub events: Vec<Option<Target>>,
    /// Where `DeadlineMissed` leads; `None` where the supervisor's own edge holds.
    pub on_miss: Option<Target>,
    /// The supervisor's name behind `on`.
    pub span: Span,
    /// Where the edges stand in the text.
    pub edges: EdgeSpans,
}

impl Reactions {
    /// Where an event, or a missed deadline, leads; `None` where the supervisor's own edge holds.
    pub fn target(&self, event: Option<u16>) -> Option<Target> {
        match event {
            Some(event) => self.events.get(usize::from(event)).copied().flatten(),
            None => self.on_miss,
        }
    }

    /// Where its edges lead.
    pub fn targets(&self) -> impl Iterator<Item = Target> {
        self.events.iter().copied().chain([self.on_miss]).flatten()
    }
}

impl Element {
    /// Its reactions to a global supervisor.
    pub fn reactions_to(&self, supervisor: SupervisorId) -> Option<&Reactions> {
        self.reactions.iter().find(|each| each.supervisor == supervisor)
    }
}

impl Plan {
    /// The elements with reactions to a global supervisor.
    pub fn reacting(
        &self,
        supervisor: SupervisorId,
    ) -> impl Iterator<Item = (ElementId, &Reactions)> {
        let is_global = supervisor.0 < self.globals;
        let elements = if is_global { &self.elements[..] } else { &[] };
        let elements = (0..).map(ElementId).zip(elements);
        elements.filter_map(move |(id, each)| Some((id, each.reactions_to(supervisor)?)))
    }

    /// Where the edges of a supervisor lead, wherever it watches.
    pub fn targets(&self, supervisor: SupervisorId) -> impl Iterator<Item = Target> {
        let own = &self.supervisors[supervisor.index()];
        let others = self.reacting(supervisor).flat_map(|(_, table)| table.targets());
        own.events.iter().copied().chain(own.on_miss).chain(others)
    }

    /// Where the events of a supervisor lead while an element is active or being entered.
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

    /// Where `DeadlineMissed` of a supervisor leads then.
    pub fn miss_at(&self, supervisor: SupervisorId, element: ElementId) -> Option<Target> {
        let table = self.elements[element.index()].reactions_to(supervisor);
        let own = self.supervisors[supervisor.index()].on_miss;
        table.and_then(|table| table.on_miss).or(own)
    }
}
