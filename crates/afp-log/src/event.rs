//! Trace records as messages: names beside ids, so that a reader needs no tables.

use afp_core::trace::{
    self, Author, Cause, ComponentId, ComponentName, ERROR, Ending, EntryName, Names, Record,
    TraceEntryId, Verdict,
};
use afp_core::{Duration, Fault, Instant, ValueRef};
use prost_types::Timestamp;

use crate::proto::afp::plan_event::{self, Kind};
use crate::proto::afp::plan_table::{Component, Outcome};
use crate::proto::afp::{Entry, PlanEvent, PlanTable, Value, plan_table, value};

/// A record as a message.
pub fn describe(at: Instant, record: &Record<'_>, names: &(impl Names + ?Sized)) -> PlanEvent {
    let teller = Teller { names };
    let mut event = teller.describe(record);
    event.time = Some(timestamp(at));
    event
}

/// A value of an entry as a message.
pub fn entry(names: &(impl Names + ?Sized), id: TraceEntryId, value: ValueRef<'_>) -> Entry {
    let EntryName { path, ty, unit, .. } = names.entry(id);
    Entry {
        name: path.to_owned(),
        r#type: ty.to_owned(),
        unit: unit.to_owned(),
        value: Some(Teller { names }.value(Some(id), value)),
    }
}

/// The author of a commit: a path, or `outside`.
pub fn author(names: &(impl Names + ?Sized), author: Author) -> String {
    match author {
        Author::Component(id) => names.component(id).path.to_owned(),
        Author::Outside => "outside".to_owned(),
    }
}

/// What the plan consists of, as a message.
pub(crate) fn table(names: &(impl Names + ?Sized)) -> PlanTable {
    let outcomes = |id| {
        let named = |n| Outcome {
            name: names.outcome(id, n).to_owned(),
            target: names.target(id, n).to_owned(),
        };
        (0..ERROR).map(named).take_while(|outcome| !outcome.name.is_empty()).collect()
    };
    let component = |id| {
        let ComponentName { path, kind, template } = names.component(id);
        let inputs = (0..u16::MAX).map(|port| names.input(id, port).to_owned());
        Component {
            path: path.to_owned(),
            kind: match kind {
                trace::Kind::Plan => plan_table::Kind::Plan,
                trace::Kind::Actor => plan_table::Kind::Actor,
                trace::Kind::Computation => plan_table::Kind::Computation,
                trace::Kind::SubPlan => plan_table::Kind::SubPlan,
                trace::Kind::Supervisor => plan_table::Kind::Supervisor,
            }
            .into(),
            template: template.to_owned(),
            outcomes: outcomes(id),
            inputs: inputs.take_while(|name| !name.is_empty()).collect(),
        }
    };
    PlanTable {
        time: Some(timestamp(Instant::ZERO)),
        components: (0..names.components()).map(|id| component(ComponentId(id))).collect(),
    }
}

/// The record behind an event of a log, as far as counting it matters: without values, and with one fault for all.
/// `None` where it says nothing about components.
pub fn record(event: &PlanEvent) -> Option<Record<'static>> {
    let component = ComponentId(event.component_id);
    let outcome = u16::try_from(event.outcome_id).ok()?;
    let none = ValueRef::Unset;
    Some(match event.kind() {
        Kind::Started => Record::Started { component },
        Kind::Finished => Record::Finished { element: component, state: outcome },
        Kind::Interrupted => Record::Interrupted { element: component },
        Kind::Event => Record::Event { supervisor: component, event: outcome },
        Kind::Faulted => Record::Faulted { component, fault: Fault::INTERNAL },
        Kind::Polled => Record::Polled { supervisor: component, verdict: Verdict::Clear },
        Kind::Missed => Record::Missed {
            supervisor: component,
            lateness: Duration::from_nanos(event.lateness_ns),
            cause: match event.cause() {
                plan_event::Cause::LongPoll => Cause::LongPoll,
                plan_event::Cause::LateRelease | plan_event::Cause::NoCause => Cause::LateRelease,
            },
            skipped: event.skipped,
        },
        Kind::Ended => Record::Ended {
            plan: component,
            ending: match event.ending() {
                plan_event::Ending::Error => Ending::Error(Fault::INTERNAL),
                plan_event::Ending::EndedInterrupted => Ending::Interrupted,
                plan_event::Ending::Ok | plan_event::Ending::NotEnded => Ending::Ok,
            },
        },
        Kind::Committed => Record::Committed {
            author: match event.component_id {
                u32::MAX => Author::Outside,
                _ => Author::Component(component),
            },
            entry: TraceEntryId(event.entry_id),
            old: none,
            new: none,
        },
        _ => return None,
    })
}

/// An instant as protobuf writes it.
pub(crate) fn timestamp(at: Instant) -> Timestamp {
    let nanos = at.as_nanos();
    // Both fit: a u64 holds 584 years of nanoseconds.
    Timestamp { seconds: (nanos / 1_000_000_000) as i64, nanos: (nanos % 1_000_000_000) as i32 }
}

struct Teller<'a, N: ?Sized> {
    names: &'a N,
}

impl<N: Names + ?Sized> Teller<'_, N> {
    fn describe(&self, record: &Record<'_>) -> PlanEvent {
        match *record {
            Record::ClockWentBack { asked } => {
                PlanEvent { asked_ns: asked.as_nanos(), ..self.about(Kind::ClockWentBack, 0) }
            }
            Record::StopRequested => self.about(Kind::StopRequested, 0),
            Record::Injected { component, outcome } => PlanEvent {
                // Where it leads is told when it is taken.
                target: String::new(),
                ..self.outcome(Kind::Injected, component, outcome)
            },
            Record::Polled { supervisor, verdict } => self.polled(supervisor, verdict),
            Record::Missed { supervisor, lateness, cause, skipped } => PlanEvent {
                lateness_ns: lateness.as_nanos(),
                cause: match cause {
                    Cause::LateRelease => plan_event::Cause::LateRelease,
                    Cause::LongPoll => plan_event::Cause::LongPoll,
                }
                .into(),
                skipped,
                ..self.about(Kind::Missed, supervisor.0)
            },
            Record::Event { supervisor, event } => self.outcome(Kind::Event, supervisor, event),
            Record::AlreadyThere { supervisor, event } => {
                self.outcome(Kind::AlreadyThere, supervisor, event)
            }
            Record::Interrupted { element } => self.about(Kind::Interrupted, element.0),
            Record::Finished { element, state } => self.outcome(Kind::Finished, element, state),
            Record::Committed { author, entry, old, new } => {
                self.committed(author, entry, old, new)
            }
            Record::Input { component, port, value } => PlanEvent {
                port: self.names.input(component, port).to_owned(),
                value: Some(self.value(None, value)),
                ..self.about(Kind::Input, component.0)
            },
            Record::Started { component } => self.about(Kind::Started, component.0),
            Record::Diverted { element, supervisor, event } => PlanEvent {
                component: self.path(element),
                component_id: element.0,
                supervisor: self.path(supervisor),
                supervisor_id: supervisor.0,
                ..self.outcome(Kind::Diverted, supervisor, event)
            },
            Record::Faulted { component, fault } => self.fault(Kind::Faulted, component.0, fault),
            Record::Ended { plan, ending } => self.ended(plan, ending),
        }
    }

    fn path(&self, id: ComponentId) -> String {
        self.names.component(id).path.to_owned()
    }

    fn about(&self, kind: Kind, id: u32) -> PlanEvent {
        let component = self.path(ComponentId(id));
        PlanEvent { kind: kind.into(), component, component_id: id, ..PlanEvent::default() }
    }

    fn outcome(&self, kind: Kind, id: ComponentId, outcome: u16) -> PlanEvent {
        PlanEvent {
            outcome: self.names.outcome(id, outcome).to_owned(),
            target: self.names.target(id, outcome).to_owned(),
            outcome_id: outcome.into(),
            ..self.about(kind, id.0)
        }
    }

    fn fault(&self, kind: Kind, id: u32, fault: Fault) -> PlanEvent {
        PlanEvent {
            fault: fault.code().to_owned(),
            fault_text: fault.to_string(),
            ..self.about(kind, id)
        }
    }

    fn polled(&self, supervisor: ComponentId, verdict: Verdict) -> PlanEvent {
        match verdict {
            Verdict::Clear => self.about(Kind::Polled, supervisor.0),
            Verdict::Event(event) => {
                // Where the event leads is told when it is taken.
                PlanEvent { target: String::new(), ..self.outcome(Kind::Polled, supervisor, event) }
            }
            Verdict::Fault(fault) => self.fault(Kind::Polled, supervisor.0, fault),
        }
    }

    fn committed(
        &self,
        by: Author,
        entry: TraceEntryId,
        old: ValueRef<'_>,
        new: ValueRef<'_>,
    ) -> PlanEvent {
        let EntryName { path, unit, .. } = self.names.entry(entry);
        PlanEvent {
            kind: Kind::Committed.into(),
            component: author(self.names, by),
            component_id: match by {
                Author::Component(id) => id.0,
                Author::Outside => u32::MAX,
            },
            entry: path.to_owned(),
            entry_id: entry.0,
            unit: unit.to_owned(),
            old: Some(self.value(Some(entry), old)),
            value: Some(self.value(Some(entry), new)),
            ..PlanEvent::default()
        }
    }

    fn ended(&self, plan: ComponentId, ending: Ending) -> PlanEvent {
        let with = |ending: plan_event::Ending| PlanEvent {
            ending: ending.into(),
            ..self.about(Kind::Ended, plan.0)
        };
        match ending {
            Ending::Ok => with(plan_event::Ending::Ok),
            Ending::Interrupted => with(plan_event::Ending::EndedInterrupted),
            Ending::Error(fault) => PlanEvent {
                ending: plan_event::Ending::Error.into(),
                ..self.fault(Kind::Ended, plan.0, fault)
            },
        }
    }

    fn value(&self, entry: Option<TraceEntryId>, value: ValueRef<'_>) -> Value {
        let ty = || entry.map_or("", |id| self.names.entry(id).ty);
        let kind = match value {
            ValueRef::Unset => None,
            ValueRef::Bool(truth) => Some(value::Value::Truth(truth)),
            ValueRef::Int(integer) => Some(value::Value::Integer(integer)),
            ValueRef::Float(number) => Some(value::Value::Number(number)),
            ValueRef::Text(text) => Some(value::Value::Text(text.to_owned())),
            ValueRef::Choice(choice) => Some(value::Value::Choice(match entry {
                Some(id) => format!("{}.{}", ty(), self.names.choice(id, choice)),
                None => format!("#{choice}"),
            })),
            ValueRef::Object(commit) => Some(value::Value::Object(format!("{}#{commit}", ty()))),
        };
        Value { value: kind }
    }
}

/// How a plan ended, in a word; empty while it runs.
pub fn ending_word(ending: plan_event::Ending) -> &'static str {
    match ending {
        plan_event::Ending::NotEnded => "",
        plan_event::Ending::Ok => "ok",
        plan_event::Ending::EndedInterrupted => "interrupted",
        plan_event::Ending::Error => "error",
    }
}

/// What happened, in a word, as JSON and Python tell it.
pub fn kind_word(kind: plan_event::Kind) -> &'static str {
    match kind {
        Kind::Unknown => "unknown",
        Kind::ClockWentBack => "clock_went_back",
        Kind::StopRequested => "stop_requested",
        Kind::Polled => "polled",
        Kind::Missed => "missed",
        Kind::Event => "event",
        Kind::AlreadyThere => "already_there",
        Kind::Interrupted => "interrupted",
        Kind::Finished => "finished",
        Kind::Committed => "committed",
        Kind::Input => "input",
        Kind::Started => "started",
        Kind::Diverted => "diverted",
        Kind::Faulted => "faulted",
        Kind::Ended => "ended",
        Kind::Lost => "lost",
        Kind::Injected => "injected",
    }
}
