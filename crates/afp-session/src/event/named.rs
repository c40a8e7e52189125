//! Records of a trace as events with names.

use afp_core::trace::{
    Author, ComponentId, Ending, EntryName, Names, Outcome, PortName, Record, TraceEntryId, Verdict,
};
use afp_core::{Fault, ValueRef};

use super::{EndingKind, EventKind, Miss, OUTSIDE, RunEvent, author};
use crate::datum::{Datum, Holder};

/// Puts names in place of ids.
pub(super) struct Namer<'a, N: ?Sized> {
    pub(super) names: &'a N,
}

impl<N: Names + ?Sized> Namer<'_, N> {
    /// A record as an event, without its time.
    pub(super) fn describe(&self, record: &Record<'_>) -> RunEvent {
        match *record {
            Record::ClockWentBack { asked } => {
                RunEvent { asked: Some(asked), ..self.plan(EventKind::ClockWentBack) }
            }
            Record::StopRequested => self.plan(EventKind::StopRequested),
            Record::Injected { component, outcome } => RunEvent {
                // Where it leads is known when it is taken.
                target: String::new(),
                ..self.outcome(EventKind::Injected, component, outcome)
            },
            Record::Polled { supervisor, verdict } => self.polled(supervisor, verdict),
            Record::Missed { supervisor, lateness, cause, skipped } => RunEvent {
                missed: Some(Miss { lateness, cause: Some(cause), skipped }),
                ..self.about(EventKind::Missed, supervisor)
            },
            Record::Event { supervisor, event, element } => {
                self.event(EventKind::Event, supervisor, event, element)
            }
            Record::AlreadyThere { supervisor, event, element } => {
                self.event(EventKind::AlreadyThere, supervisor, event, element)
            }
            Record::Interrupted { element } => self.about(EventKind::Interrupted, element),
            Record::Finished { element, state } => {
                self.outcome(EventKind::Finished, element, state)
            }
            Record::Committed { author, entry, old, new } => {
                self.committed(author, entry, old, new)
            }
            Record::Input { component, port, value } => {
                let PortName { name, unit, .. } = self.names.input_port(component, port);
                RunEvent {
                    port: name.to_owned(),
                    value: Some(Datum::new(self.names, Holder::Input(component, port), value)),
                    unit: unit.to_owned(),
                    ..self.about(EventKind::Input, component)
                }
            }
            Record::Started { component } => self.about(EventKind::Started, component),
            Record::Diverted { element, supervisor, event } => RunEvent {
                component: self.path(element),
                component_id: element,
                supervisor: self.path(supervisor),
                supervisor_id: supervisor,
                ..self.outcome(EventKind::Diverted, supervisor, event)
            },
            Record::Resumed { element, supervisor } => RunEvent {
                supervisor: self.path(supervisor),
                supervisor_id: supervisor,
                ..self.about(EventKind::Resumed, element)
            },
            Record::Faulted { component, fault, detail } => RunEvent {
                fault_text: fault.explained(detail, self.names).to_string(),
                ..self.fault(EventKind::Faulted, component, fault)
            },
            Record::Ended { plan, ending } => self.ended(plan, ending),
        }
    }

    fn path(&self, id: ComponentId) -> String {
        self.names.component(id).path.to_owned()
    }

    /// What is about the whole plan.
    fn plan(&self, kind: EventKind) -> RunEvent {
        self.about(kind, ComponentId(0))
    }

    fn about(&self, kind: EventKind, id: ComponentId) -> RunEvent {
        RunEvent { kind, component: self.path(id), component_id: id, ..RunEvent::default() }
    }

    fn outcome(&self, kind: EventKind, id: ComponentId, outcome: Outcome) -> RunEvent {
        RunEvent {
            outcome: self.names.outcome(id, outcome).to_owned(),
            target: self.names.target(id, outcome).to_owned(),
            outcome_id: outcome.number(),
            ..self.about(kind, id)
        }
    }

    /// An event, which leads where the element that is active or being entered says.
    fn event(
        &self,
        kind: EventKind,
        supervisor: ComponentId,
        event: Outcome,
        element: ComponentId,
    ) -> RunEvent {
        let mut reactions = (0..u16::MAX).map_while(|n| self.names.reaction(element, n));
        let own = reactions.find(|each| (each.supervisor, each.outcome) == (supervisor, event));
        let polled = self.outcome(kind, supervisor, event);
        RunEvent {
            target: own.map_or(polled.target, |reaction| reaction.target.to_owned()),
            on: own.is_some(),
            element: self.path(element),
            element_id: element,
            ..polled
        }
    }

    fn fault(&self, kind: EventKind, id: ComponentId, fault: Fault) -> RunEvent {
        RunEvent {
            fault: fault.code().to_owned(),
            fault_text: fault.to_string(),
            ..self.about(kind, id)
        }
    }

    fn polled(&self, supervisor: ComponentId, verdict: Verdict) -> RunEvent {
        let kind = EventKind::Polled;
        match verdict {
            Verdict::Clear => self.about(kind, supervisor),
            Verdict::Event(event) => {
                // Where the event leads is known when it is taken.
                RunEvent { target: String::new(), ..self.outcome(kind, supervisor, event) }
            }
            Verdict::Fault(fault) => self.fault(kind, supervisor, fault),
        }
    }

    fn committed(
        &self,
        by: Author,
        entry: TraceEntryId,
        old: ValueRef<'_>,
        new: ValueRef<'_>,
    ) -> RunEvent {
        let EntryName { path, unit, .. } = self.names.entry(entry);
        RunEvent {
            kind: EventKind::Committed,
            component: author(self.names, by),
            component_id: match by {
                Author::Component(id) => id,
                Author::Outside => OUTSIDE,
            },
            entry: path.to_owned(),
            entry_id: entry,
            unit: unit.to_owned(),
            old: Some(Datum::new(self.names, Holder::Entry(entry), old)),
            value: Some(Datum::new(self.names, Holder::Entry(entry), new)),
            ..RunEvent::default()
        }
    }

    fn ended(&self, plan: ComponentId, ending: Ending) -> RunEvent {
        let with = |ending| RunEvent { ending: Some(ending), ..self.about(EventKind::Ended, plan) };
        match ending {
            Ending::Ok => with(EndingKind::Ok),
            Ending::Interrupted => with(EndingKind::Interrupted),
            Ending::Error(fault) => RunEvent {
                ending: Some(EndingKind::Error),
                ..self.fault(EventKind::Ended, plan, fault)
            },
        }
    }
}
