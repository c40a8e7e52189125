//! Converts events to messages of the file and back. Messages have names in addition to ids, so
//! that readers need no tables.

use afp_core::trace::{
    self, Cause, ComponentId, ComponentName, EntryName, Names, Outcome, TraceEntryId, declared,
};
use afp_core::{Duration, Instant, Release, ValueRef};
use afp_session::{
    Datum, Done, EndingKind, EventAt, EventKind, FaultText, Holder, Miss, NameWithUnit,
    NamedComponent, NamedOutcome, Pose2, Put, Report, Requested, RunEvent, Stimulus,
};
use prost::Message;
use prost_types::Timestamp;

use crate::proto::afp::plan_event::{self, Kind};
use crate::proto::afp::plan_table::{self, Component, Reaction};
use crate::proto::afp::request::{self, Became, Output};
use crate::proto::afp::{Entry, PlanEvent, PlanTable, Request, Value, value};

/// An event as the bytes of a message, for use without a log.
pub fn pack(event: &RunEvent) -> Vec<u8> {
    message(event.clone()).encode_to_vec()
}

/// The event in the bytes of [`pack`]; `None` for other bytes.
pub fn unpack(bytes: &[u8]) -> Option<RunEvent> {
    PlanEvent::decode(bytes).ok().map(decode)
}

pub(crate) fn message(event: RunEvent) -> PlanEvent {
    let RunEvent { at, component, kind } = event;
    let mut to = PlanEvent {
        time: Some(timestamp(at)),
        component: component.path,
        component_id: component.id.0,
        ..PlanEvent::default()
    };
    let kind = to.put(kind);
    to.set_kind(kind);
    to
}

impl PlanEvent {
    fn put(&mut self, kind: EventKind) -> Kind {
        match kind {
            EventKind::Unknown => Kind::Unknown,
            EventKind::ClockWentBack { asked } => {
                self.asked_ns = asked.as_nanos();
                Kind::ClockWentBack
            }
            EventKind::StopRequested => Kind::StopRequested,
            EventKind::Requested(request) => {
                self.request = Some(encode_request(request));
                Kind::Requested
            }
            EventKind::Injected(outcome) => self.put_outcome(outcome, Kind::Injected),
            EventKind::Polled(Ok(None)) => Kind::Polled,
            EventKind::Polled(Ok(Some(event))) => self.put_outcome(event, Kind::Polled),
            EventKind::Polled(Err(fault)) => self.put_fault(fault, Kind::Polled),
            EventKind::Missed(Miss { lateness, cause, skipped }) => {
                self.lateness_ns = lateness.as_nanos();
                self.skipped = skipped;
                self.set_cause(match cause {
                    None => plan_event::Cause::NoCause,
                    Some(Cause::LateRelease) => plan_event::Cause::LateRelease,
                    Some(Cause::LongPoll) => plan_event::Cause::LongPoll,
                });
                Kind::Missed
            }
            EventKind::Event(event) => self.put_event(event, Kind::Event),
            EventKind::AlreadyThere(event) => self.put_event(event, Kind::AlreadyThere),
            EventKind::Interrupted => Kind::Interrupted,
            EventKind::Finished(state) => self.put_outcome(state, Kind::Finished),
            EventKind::Committed { entry, entry_id, old, new, unit } => {
                (self.entry, self.entry_id, self.unit) = (entry, entry_id.0, unit);
                (self.old, self.value) = (Some(encode_value(old)), Some(encode_value(new)));
                Kind::Committed
            }
            EventKind::Input { port, value, unit } => {
                (self.port, self.value, self.unit) = (port, Some(encode_value(value)), unit);
                Kind::Input
            }
            EventKind::Started => Kind::Started,
            EventKind::Diverted { event, supervisor } => {
                self.put_supervisor(supervisor);
                self.put_outcome(event, Kind::Diverted)
            }
            EventKind::Resumed { supervisor } => {
                self.put_supervisor(supervisor);
                Kind::Resumed
            }
            EventKind::Suspended { supervisor, started } => {
                self.put_supervisor(supervisor);
                self.started = started;
                Kind::Suspended
            }
            EventKind::Returned { away } => {
                self.away_ns = away.as_nanos();
                Kind::Returned
            }
            EventKind::Abandoned { started } => {
                self.started = started;
                Kind::Abandoned
            }
            EventKind::Held { started } => {
                self.started = started;
                Kind::Held
            }
            EventKind::Released => Kind::Released,
            EventKind::Faulted(fault) => self.put_fault(fault, Kind::Faulted),
            EventKind::Ended { ending, fault } => {
                self.set_ending(match ending {
                    EndingKind::Ok => plan_event::Ending::Ok,
                    EndingKind::Interrupted => plan_event::Ending::EndedInterrupted,
                    EndingKind::Error => plan_event::Ending::Error,
                });
                self.put_fault(fault, Kind::Ended)
            }
            EventKind::Lost(count) => {
                self.lost = count;
                Kind::Lost
            }
        }
    }

    fn put_outcome(&mut self, outcome: NamedOutcome, kind: Kind) -> Kind {
        let NamedOutcome { name, outcome, target } = outcome;
        (self.outcome, self.outcome_id, self.target) = (name, outcome.number().into(), target);
        kind
    }

    fn put_fault(&mut self, fault: FaultText, kind: Kind) -> Kind {
        (self.fault, self.fault_text) = (fault.code, fault.text);
        kind
    }

    fn put_event(&mut self, event: EventAt, kind: Kind) -> Kind {
        let EventAt { event, element, on } = event;
        (self.element, self.element_id, self.on) = (element.path, element.id.0, on);
        self.put_outcome(event, kind)
    }

    fn put_supervisor(&mut self, supervisor: NamedComponent) {
        (self.supervisor, self.supervisor_id) = (supervisor.path, supervisor.id.0);
    }
}

pub(crate) fn decode(mut message: PlanEvent) -> RunEvent {
    let path = std::mem::take(&mut message.component);
    let component = component(path, message.component_id);
    RunEvent { at: instant(&message.time), component, kind: kind(message) }
}

fn component(path: String, id: u32) -> NamedComponent {
    NamedComponent { path, id: ComponentId(id) }
}

fn kind(message: PlanEvent) -> EventKind {
    let (kind, cause, ending) = (message.kind(), message.cause(), message.ending());
    let fault = FaultText { code: message.fault, text: message.fault_text };
    // Positions are below this; a damaged position refers to nothing.
    let outcome = Outcome::from_number(u16::try_from(message.outcome_id).unwrap_or(u16::MAX));
    let outcome = NamedOutcome { name: message.outcome, outcome, target: message.target };
    let element = || component(message.element, message.element_id);
    let supervisor = || component(message.supervisor, message.supervisor_id);
    let value = |value: Option<Value>| value.map_or(Datum::Unset, decode_value);
    match kind {
        Kind::Unknown => EventKind::Unknown,
        Kind::ClockWentBack => {
            EventKind::ClockWentBack { asked: Instant::from_nanos(message.asked_ns) }
        }
        Kind::StopRequested => EventKind::StopRequested,
        Kind::Requested => message
            .request
            .and_then(decode_request)
            .map_or(EventKind::Unknown, EventKind::Requested),
        Kind::Injected => EventKind::Injected(outcome),
        Kind::Polled if !fault.code.is_empty() => EventKind::Polled(Err(fault)),
        Kind::Polled if outcome.name.is_empty() => EventKind::Polled(Ok(None)),
        Kind::Polled => EventKind::Polled(Ok(Some(outcome))),
        Kind::Missed => EventKind::Missed(Miss {
            lateness: Duration::from_nanos(message.lateness_ns),
            cause: match cause {
                plan_event::Cause::NoCause => None,
                plan_event::Cause::LateRelease => Some(Cause::LateRelease),
                plan_event::Cause::LongPoll => Some(Cause::LongPoll),
            },
            skipped: message.skipped,
        }),
        Kind::Event => {
            EventKind::Event(EventAt { event: outcome, element: element(), on: message.on })
        }
        Kind::AlreadyThere => {
            EventKind::AlreadyThere(EventAt { event: outcome, element: element(), on: message.on })
        }
        Kind::Interrupted => EventKind::Interrupted,
        Kind::Finished => EventKind::Finished(outcome),
        Kind::Committed => EventKind::Committed {
            entry: message.entry,
            entry_id: TraceEntryId(message.entry_id),
            old: value(message.old),
            new: value(message.value),
            unit: message.unit,
        },
        Kind::Input => {
            EventKind::Input { port: message.port, value: value(message.value), unit: message.unit }
        }
        Kind::Started => EventKind::Started,
        Kind::Diverted => EventKind::Diverted { event: outcome, supervisor: supervisor() },
        Kind::Resumed => EventKind::Resumed { supervisor: supervisor() },
        Kind::Suspended => {
            EventKind::Suspended { supervisor: supervisor(), started: message.started }
        }
        Kind::Returned => EventKind::Returned { away: Duration::from_nanos(message.away_ns) },
        Kind::Abandoned => EventKind::Abandoned { started: message.started },
        Kind::Held => EventKind::Held { started: message.started },
        Kind::Released => EventKind::Released,
        Kind::Faulted => EventKind::Faulted(fault),
        Kind::Ended => match ending {
            plan_event::Ending::NotEnded => EventKind::Unknown,
            plan_event::Ending::Ok => EventKind::Ended { ending: EndingKind::Ok, fault },
            plan_event::Ending::EndedInterrupted => {
                EventKind::Ended { ending: EndingKind::Interrupted, fault }
            }
            plan_event::Ending::Error => EventKind::Ended { ending: EndingKind::Error, fault },
        },
        Kind::Lost => EventKind::Lost(message.lost),
    }
}

pub(crate) fn encode_value(datum: Datum) -> Value {
    Value {
        value: match datum {
            Datum::Unset => None,
            Datum::Bool(truth) => Some(value::Value::Truth(truth)),
            Datum::Int(integer) => Some(value::Value::Integer(integer)),
            Datum::Float(number) => Some(value::Value::Number(number)),
            Datum::Text(text) => Some(value::Value::Text(text)),
            Datum::Choice(choice) => Some(value::Value::Choice(choice)),
            Datum::Object(object) => Some(value::Value::Object(object)),
        },
    }
}

pub(crate) fn decode_value(message: Value) -> Datum {
    match message.value {
        None => Datum::Unset,
        Some(value::Value::Truth(truth)) => Datum::Bool(truth),
        Some(value::Value::Integer(integer)) => Datum::Int(integer),
        Some(value::Value::Number(number)) => Datum::Float(number),
        Some(value::Value::Text(text)) => Datum::Text(text),
        Some(value::Value::Choice(choice)) => Datum::Choice(choice),
        Some(value::Value::Object(object)) => Datum::Object(object),
    }
}

fn encode_request(request: Requested) -> Request {
    let Requested { at, what, done } = request;
    let about =
        |kind: request::Kind, name| Request { kind: kind.into(), name, ..Request::default() };
    let message = match what {
        Stimulus::Write(NameWithUnit { name, unit }, value) => {
            Request { value: Some(encode_value(value)), unit, ..about(request::Kind::Write, name) }
        }
        Stimulus::Press(control, true) => about(request::Kind::Press, control),
        Stimulus::Press(control, false) => about(request::Kind::Release, control),
        Stimulus::Hold(control, lasting) => {
            Request { lasting_ns: Some(lasting.as_nanos()), ..about(request::Kind::Press, control) }
        }
        Stimulus::Break(NameWithUnit { name, unit }, amount, lasting) => Request {
            amount,
            unit,
            lasting_ns: (lasting != Duration::MAX).then_some(lasting.as_nanos()),
            ..about(request::Kind::Fail, name)
        },
        Stimulus::Inject(component, Report { outcome, ends }, outputs) => {
            let output = |(port, value): (u16, Datum)| Output {
                port: port.into(),
                value: Some(encode_value(value)),
            };
            let outputs = outputs.into_iter().map(output).collect();
            let kind = if ends { request::Kind::Finish } else { request::Kind::Fire };
            Request { outcome, outputs, ..about(kind, component) }
        }
        Stimulus::Idle(element) => about(request::Kind::Idle, element.unwrap_or_default()),
        Stimulus::Put(what, at) => {
            let (kind, name) = match what {
                Put::Robot => (request::Kind::Move, String::new()),
                Put::Thing(name) => (request::Kind::Move, name),
                Put::New(shape) => (request::Kind::Drop, shape),
            };
            Request { pose: vec![at.x, at.y, at.heading], ..about(kind, name) }
        }
        Stimulus::Pause => about(request::Kind::Hold, String::new()),
        Stimulus::Release(Release::Continue) => about(request::Kind::Continue, String::new()),
        Stimulus::Release(Release::Step) => about(request::Kind::Step, String::new()),
        Stimulus::Stop => about(request::Kind::Stop, String::new()),
    };
    let (became, why) = match done {
        Done::Done => (Became::Done, String::new()),
        Done::Refused(why) => (Became::Refused, why),
        Done::NotReached => (Became::NotReached, String::new()),
    };
    Request { at_ns: at.as_nanos(), became: became.into(), why, ..message }
}

/// The request in a message; `None` for a kind from a later release.
fn decode_request(message: Request) -> Option<Requested> {
    let done = match message.became() {
        Became::Done => Done::Done,
        Became::Refused => Done::Refused(message.why.clone()),
        Became::NotReached => Done::NotReached,
    };
    let at = Instant::from_nanos(message.at_ns);
    let (kind, name) = (message.kind(), message.name);
    let value = |value: Option<Value>| value.map_or(Datum::Unset, decode_value);
    let what = match kind {
        request::Kind::Unknown => return None,
        request::Kind::Write => {
            Stimulus::Write(NameWithUnit { name, unit: message.unit }, value(message.value))
        }
        request::Kind::Press => match message.lasting_ns {
            Some(lasting) => Stimulus::Hold(name, Duration::from_nanos(lasting)),
            None => Stimulus::Press(name, true),
        },
        request::Kind::Release => Stimulus::Press(name, false),
        request::Kind::Fail => Stimulus::Break(
            NameWithUnit { name, unit: message.unit },
            message.amount,
            message.lasting_ns.map_or(Duration::MAX, Duration::from_nanos),
        ),
        request::Kind::Fire | request::Kind::Finish => {
            let output =
                |output: Output| Some((u16::try_from(output.port).ok()?, value(output.value)));
            let outputs = message.outputs.into_iter().filter_map(output).collect();
            let ends = kind == request::Kind::Finish;
            Stimulus::Inject(name, Report { outcome: message.outcome, ends }, outputs)
        }
        request::Kind::Idle => Stimulus::Idle(Some(name).filter(|name| !name.is_empty())),
        request::Kind::Move => {
            let what = if name.is_empty() { Put::Robot } else { Put::Thing(name) };
            Stimulus::Put(what, decode_pose(&message.pose))
        }
        request::Kind::Drop => Stimulus::Put(Put::New(name), decode_pose(&message.pose)),
        request::Kind::Hold => Stimulus::Pause,
        request::Kind::Continue => Stimulus::Release(Release::Continue),
        request::Kind::Step => Stimulus::Release(Release::Step),
        request::Kind::Stop => Stimulus::Stop,
    };
    Some(Requested { at, what, done })
}

fn decode_pose(numbers: &[f64]) -> Pose2 {
    let number = |at: usize| numbers.get(at).copied().unwrap_or_default();
    Pose2 { x: number(0), y: number(1), heading: number(2) }
}

pub(crate) fn entry(names: &(impl Names + ?Sized), id: TraceEntryId, value: ValueRef<'_>) -> Entry {
    let EntryName { path, ty, unit, .. } = names.entry(id);
    Entry {
        name: path.to_owned(),
        r#type: ty.to_owned(),
        unit: unit.to_owned(),
        value: Some(encode_value(Holder::Entry(id).named(names, value))),
    }
}

pub(crate) fn table(names: &(impl Names + ?Sized)) -> PlanTable {
    let outcomes = |id| {
        let named = |(outcome, name): (_, &str)| plan_table::Outcome {
            name: name.to_owned(),
            target: names.target(id, outcome).to_owned(),
        };
        declared(names, id).map(named).collect()
    };
    let reactions = |id| {
        let edges = (0..u16::MAX).map_while(|n| names.reaction(id, n));
        let edges = edges.map(|edge| Reaction {
            supervisor_id: edge.supervisor.0,
            outcome_id: edge.outcome.number().into(),
            target: edge.target.to_owned(),
        });
        edges.collect()
    };
    let component = |id| {
        let ComponentName { path, kind, template } = names.component(id);
        let inputs = (0..u16::MAX).map(|port| names.input(id, port).to_owned());
        Component {
            path: path.to_owned(),
            kind: match kind {
                trace::ComponentKind::Plan => plan_table::Kind::Plan,
                trace::ComponentKind::Actor => plan_table::Kind::Actor,
                trace::ComponentKind::Computation => plan_table::Kind::Computation,
                trace::ComponentKind::SubPlan => plan_table::Kind::SubPlan,
                trace::ComponentKind::Supervisor => plan_table::Kind::Supervisor,
            }
            .into(),
            template: template.to_owned(),
            outcomes: outcomes(id),
            reactions: reactions(id),
            inputs: inputs.take_while(|name| !name.is_empty()).collect(),
        }
    };
    PlanTable {
        time: Some(timestamp(Instant::ZERO)),
        components: (0..names.components()).map(|id| component(ComponentId(id))).collect(),
    }
}

pub(crate) fn timestamp(at: Instant) -> Timestamp {
    let nanos = at.as_nanos();
    // Both fit: a u64 holds 584 years of nanoseconds.
    Timestamp { seconds: (nanos / 1_000_000_000) as i64, nanos: (nanos % 1_000_000_000) as i32 }
}

/// The instant of a protobuf time stamp; times before zero become zero.
pub(crate) fn instant(time: &Option<Timestamp>) -> Instant {
    let Some(Timestamp { seconds, nanos }) = *time else { return Instant::ZERO };
    let (seconds, nanos) = (u64::try_from(seconds), u64::try_from(nanos));
    let (seconds, nanos) = (seconds.unwrap_or(0), nanos.unwrap_or(0));
    Instant::from_nanos(seconds.saturating_mul(1_000_000_000).saturating_add(nanos))
}
