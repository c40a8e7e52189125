//! Replaces the ids in records by names.

use afp_core::Fault;
use afp_core::trace::{ComponentId, Ending, EntryName, Names, Outcome, PortName, Record, Verdict};

use super::{
    EndingKind, EventAt, EventKind, FaultText, Miss, NamedComponent, NamedOutcome, OUTSIDE,
    author_id,
};
use crate::datum::Holder;

/// Replaces ids by names.
pub(super) struct Namer<'a, N: ?Sized> {
    pub(super) names: &'a N,
}

impl<N: Names + ?Sized> Namer<'_, N> {
    /// The content of a record, and the number of its component.
    pub(super) fn describe(&self, record: &Record<'_>) -> (ComponentId, EventKind) {
        let plan = ComponentId(0);
        match *record {
            Record::ClockWentBack { asked } => (plan, EventKind::ClockWentBack { asked }),
            Record::StopRequested => (plan, EventKind::StopRequested),
            Record::Injected { component, outcome } => {
                (component, EventKind::Injected(self.reported(component, outcome)))
            }
            Record::Polled { supervisor, verdict } => {
                let said = match verdict {
                    Verdict::Clear => Ok(None),
                    Verdict::Event(event) => Ok(Some(self.reported(supervisor, event))),
                    Verdict::Fault(fault) => Err(fault_text(fault)),
                };
                (supervisor, EventKind::Polled(said))
            }
            Record::Missed { supervisor, lateness, cause, skipped } => {
                let cause = Some(cause);
                (supervisor, EventKind::Missed(Miss { lateness, cause, skipped }))
            }
            Record::Event { supervisor, event, element } => {
                (supervisor, EventKind::Event(self.event_at(supervisor, event, element)))
            }
            Record::AlreadyThere { supervisor, event, element } => {
                (supervisor, EventKind::AlreadyThere(self.event_at(supervisor, event, element)))
            }
            Record::Interrupted { element } => (element, EventKind::Interrupted),
            Record::Finished { element, state } => {
                (element, EventKind::Finished(self.taken(element, state)))
            }
            Record::Committed { author, entry, old, new } => {
                let EntryName { path, unit, .. } = self.names.entry(entry);
                let holder = Holder::Entry(entry);
                let [old, new] = [old, new].map(|value| holder.named(self.names, value));
                let (path, unit) = (path.to_owned(), unit.to_owned());
                let kind = EventKind::Committed { entry: path, entry_id: entry, old, new, unit };
                (author_id(author), kind)
            }
            Record::Input { component, port, value } => {
                let PortName { name, unit, .. } = self.names.input_port(component, port);
                let value = Holder::Input(component, port).named(self.names, value);
                let (port, unit) = (name.to_owned(), unit.to_owned());
                (component, EventKind::Input { port, value, unit })
            }
            Record::Started { component } => (component, EventKind::Started),
            Record::Diverted { element, supervisor, event } => {
                let event = self.taken(supervisor, event);
                let supervisor = self.component(supervisor);
                (element, EventKind::Diverted { event, supervisor })
            }
            Record::Resumed { element, supervisor } => {
                (element, EventKind::Resumed { supervisor: self.component(supervisor) })
            }
            Record::Suspended { element, supervisor, started } => {
                let supervisor = self.component(supervisor);
                (element, EventKind::Suspended { supervisor, started })
            }
            Record::Returned { component, away } => (component, EventKind::Returned { away }),
            Record::Abandoned { element, started } => (element, EventKind::Abandoned { started }),
            Record::Held { element, started } => (element, EventKind::Held { started }),
            Record::Released { element } => (element, EventKind::Released),
            Record::Faulted { component, fault, detail } => {
                let text = fault.explained(detail, self.names).to_string();
                let code = fault.code().to_owned();
                (component, EventKind::Faulted(FaultText { code, text }))
            }
            Record::Ended { plan, ending } => {
                let (ending, fault) = match ending {
                    Ending::Ok => (EndingKind::Ok, FaultText::default()),
                    Ending::Interrupted => (EndingKind::Interrupted, FaultText::default()),
                    Ending::Error(fault) => (EndingKind::Error, fault_text(fault)),
                };
                (plan, EventKind::Ended { ending, fault })
            }
        }
    }

    pub(super) fn component(&self, id: ComponentId) -> NamedComponent {
        let path = if id == OUTSIDE { "outside" } else { self.names.component(id).path };
        NamedComponent { path: path.to_owned(), id }
    }

    /// An outcome before it is taken; its target is not known yet.
    fn reported(&self, id: ComponentId, outcome: Outcome) -> NamedOutcome {
        let name = self.names.outcome(id, outcome).to_owned();
        NamedOutcome { name, outcome, target: String::new() }
    }

    fn taken(&self, id: ComponentId, outcome: Outcome) -> NamedOutcome {
        let target = self.names.target(id, outcome).to_owned();
        NamedOutcome { target, ..self.reported(id, outcome) }
    }

    /// An event, with the target that the active or starting element gives it.
    fn event_at(&self, supervisor: ComponentId, event: Outcome, element: ComponentId) -> EventAt {
        let mut reactions = (0..u16::MAX).map_while(|n| self.names.reaction(element, n));
        let own = reactions.find(|each| (each.supervisor, each.outcome) == (supervisor, event));
        let taken = self.taken(supervisor, event);
        let target = own.map_or(taken.target, |reaction| reaction.target.to_owned());
        let event = NamedOutcome { target, ..taken };
        EventAt { event, element: self.component(element), on: own.is_some() }
    }
}

fn fault_text(fault: Fault) -> FaultText {
    FaultText { code: fault.code().to_owned(), text: fault.to_string() }
}
