//! What happened as messages of the file, and back: names beside ids, so that a reader needs no tables.

use afp_core::trace::{
    self, Cause, ComponentId, ComponentName, EntryName, Names, TraceEntryId, declared,
};
use afp_core::{Duration, Instant, ValueRef};
use afp_session::{
    Datum, Done, EndingKind, EventKind, Holder, Miss, Pose2, Put, Requested, RunEvent, Stimulus,
};
use prost::Message;
use prost_types::Timestamp;

use crate::proto::afp::plan_event::{self, Kind};
use crate::proto::afp::plan_table::{Component, Outcome, Reaction};
use crate::proto::afp::request::{self, Became, Output};
use crate::proto::afp::{Entry, PlanEvent, PlanTable, Request, Value, plan_table, value};

/// What happened, as the bytes of a message: to be kept or sent without a log around it.
pub fn pack(event: &RunEvent) -> Vec<u8> {
    encode(event.clone()).encode_to_vec()
}

/// What [`pack`] made bytes of; none for other bytes.
pub fn unpack(bytes: &[u8]) -> Option<RunEvent> {
    PlanEvent::decode(bytes).ok().map(decode)
}

/// What happened, as a message.
pub(crate) fn encode(event: RunEvent) -> PlanEvent {
    let kind = kind(event.kind);
    let missed = event.missed;
    let cause = missed.and_then(|miss| miss.cause);
    PlanEvent {
        time: Some(timestamp(event.at)),
        kind: kind.into(),
        component: event.component,
        outcome: event.outcome,
        target: event.target,
        entry: event.entry,
        port: event.port,
        old: event.old.map(encode_value),
        value: event.value.map(encode_value),
        supervisor: event.supervisor,
        element: event.element,
        element_id: event.element_id.0,
        on: event.on,
        fault: event.fault,
        fault_text: event.fault_text,
        lateness_ns: missed.map_or(0, |miss| miss.lateness.as_nanos()),
        cause: match cause {
            None => plan_event::Cause::NoCause,
            Some(Cause::LateRelease) => plan_event::Cause::LateRelease,
            Some(Cause::LongPoll) => plan_event::Cause::LongPoll,
        }
        .into(),
        skipped: missed.map_or(0, |miss| miss.skipped),
        ending: match event.ending {
            None => plan_event::Ending::NotEnded,
            Some(EndingKind::Ok) => plan_event::Ending::Ok,
            Some(EndingKind::Interrupted) => plan_event::Ending::EndedInterrupted,
            Some(EndingKind::Error) => plan_event::Ending::Error,
        }
        .into(),
        lost: event.lost,
        asked_ns: event.asked.map_or(0, Instant::as_nanos),
        component_id: event.component_id.0,
        outcome_id: event.outcome_id.into(),
        entry_id: event.entry_id.0,
        supervisor_id: event.supervisor_id.0,
        unit: event.unit,
        request: event.request.map(encode_request),
    }
}

/// What a message says.
pub(crate) fn decode(message: PlanEvent) -> RunEvent {
    let kind = known(message.kind());
    let missed = (kind == EventKind::Missed).then(|| Miss {
        lateness: Duration::from_nanos(message.lateness_ns),
        cause: match message.cause() {
            plan_event::Cause::NoCause => None,
            plan_event::Cause::LateRelease => Some(Cause::LateRelease),
            plan_event::Cause::LongPoll => Some(Cause::LongPoll),
        },
        skipped: message.skipped,
    });
    let ending = match message.ending() {
        plan_event::Ending::NotEnded => None,
        plan_event::Ending::Ok => Some(EndingKind::Ok),
        plan_event::Ending::EndedInterrupted => Some(EndingKind::Interrupted),
        plan_event::Ending::Error => Some(EndingKind::Error),
    };
    let asked = Instant::from_nanos(message.asked_ns);
    RunEvent {
        at: instant(&message.time),
        kind,
        missed,
        ending,
        asked: (kind == EventKind::ClockWentBack).then_some(asked),
        component: message.component,
        component_id: ComponentId(message.component_id),
        outcome: message.outcome,
        // Positions are below this; a damaged one is that of nothing.
        outcome_id: u16::try_from(message.outcome_id).unwrap_or(u16::MAX),
        target: message.target,
        supervisor: message.supervisor,
        element: message.element,
        element_id: ComponentId(message.element_id),
        on: message.on,
        supervisor_id: ComponentId(message.supervisor_id),
        entry: message.entry,
        entry_id: TraceEntryId(message.entry_id),
        port: message.port,
        old: message.old.map(decode_value),
        value: message.value.map(decode_value),
        unit: message.unit,
        fault: message.fault,
        fault_text: message.fault_text,
        lost: message.lost,
        request: message.request.and_then(decode_request),
    }
}

fn kind(kind: EventKind) -> Kind {
    match kind {
        EventKind::Unknown => Kind::Unknown,
        EventKind::ClockWentBack => Kind::ClockWentBack,
        EventKind::StopRequested => Kind::StopRequested,
        EventKind::Requested => Kind::Requested,
        EventKind::Injected => Kind::Injected,
        EventKind::Polled => Kind::Polled,
        EventKind::Missed => Kind::Missed,
        EventKind::Event => Kind::Event,
        EventKind::AlreadyThere => Kind::AlreadyThere,
        EventKind::Interrupted => Kind::Interrupted,
        EventKind::Finished => Kind::Finished,
        EventKind::Committed => Kind::Committed,
        EventKind::Input => Kind::Input,
        EventKind::Started => Kind::Started,
        EventKind::Diverted => Kind::Diverted,
        EventKind::Resumed => Kind::Resumed,
        EventKind::Faulted => Kind::Faulted,
        EventKind::Ended => Kind::Ended,
        EventKind::Lost => Kind::Lost,
    }
}

fn known(kind: Kind) -> EventKind {
    match kind {
        Kind::Unknown => EventKind::Unknown,
        Kind::ClockWentBack => EventKind::ClockWentBack,
        Kind::StopRequested => EventKind::StopRequested,
        Kind::Requested => EventKind::Requested,
        Kind::Injected => EventKind::Injected,
        Kind::Polled => EventKind::Polled,
        Kind::Missed => EventKind::Missed,
        Kind::Event => EventKind::Event,
        Kind::AlreadyThere => EventKind::AlreadyThere,
        Kind::Interrupted => EventKind::Interrupted,
        Kind::Finished => EventKind::Finished,
        Kind::Committed => EventKind::Committed,
        Kind::Input => EventKind::Input,
        Kind::Started => EventKind::Started,
        Kind::Diverted => EventKind::Diverted,
        Kind::Resumed => EventKind::Resumed,
        Kind::Faulted => EventKind::Faulted,
        Kind::Ended => EventKind::Ended,
        Kind::Lost => EventKind::Lost,
    }
}

/// A value as a message.
pub(crate) fn encode_value(datum: Datum) -> Value {
    Value {
        value: match datum {
            Datum::Unset => None,
            Datum::Truth(truth) => Some(value::Value::Truth(truth)),
            Datum::Integer(integer) => Some(value::Value::Integer(integer)),
            Datum::Number(number) => Some(value::Value::Number(number)),
            Datum::Text(text) => Some(value::Value::Text(text)),
            Datum::Choice(choice) => Some(value::Value::Choice(choice)),
            Datum::Object(object) => Some(value::Value::Object(object)),
        },
    }
}

/// What the message of a value says.
pub(crate) fn decode_value(message: Value) -> Datum {
    match message.value {
        None => Datum::Unset,
        Some(value::Value::Truth(truth)) => Datum::Truth(truth),
        Some(value::Value::Integer(integer)) => Datum::Integer(integer),
        Some(value::Value::Number(number)) => Datum::Number(number),
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
        Stimulus::Write { entry, value, unit } => {
            Request { value: Some(encode_value(value)), unit, ..about(request::Kind::Write, entry) }
        }
        Stimulus::Press { control, held: true } => about(request::Kind::Press, control),
        Stimulus::Press { control, held: false } => about(request::Kind::Release, control),
        Stimulus::Hold { control, lasting } => {
            Request { lasting_ns: Some(lasting.as_nanos()), ..about(request::Kind::Press, control) }
        }
        Stimulus::Break { fault, amount, unit, lasting } => Request {
            amount,
            unit,
            lasting_ns: (lasting != Duration::MAX).then_some(lasting.as_nanos()),
            ..about(request::Kind::Fail, fault)
        },
        Stimulus::Inject { component, outcome, ends, outputs } => {
            let output = |(port, value): (u16, Datum)| Output {
                port: port.into(),
                value: Some(encode_value(value)),
            };
            let outputs = outputs.into_iter().map(output).collect();
            let kind = if ends { request::Kind::Finish } else { request::Kind::Fire };
            Request { outcome, outputs, ..about(kind, component) }
        }
        Stimulus::Idle { element } => about(request::Kind::Idle, element.unwrap_or_default()),
        Stimulus::Put { what, at } => {
            let (kind, name) = match what {
                Put::Robot => (request::Kind::Move, String::new()),
                Put::Thing(name) => (request::Kind::Move, name),
                Put::New(shape) => (request::Kind::Drop, shape),
            };
            Request { pose: vec![at.x, at.y, at.heading], ..about(kind, name) }
        }
        Stimulus::Stop => about(request::Kind::Stop, String::new()),
    };
    let (became, why) = match done {
        Done::Done => (Became::Done, String::new()),
        Done::Refused(why) => (Became::Refused, why),
        Done::NotReached => (Became::NotReached, String::new()),
    };
    Request { at_ns: at.as_nanos(), became: became.into(), why, ..message }
}

/// What the message of a request says; none for a kind that this release does not know.
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
            Stimulus::Write { entry: name, value: value(message.value), unit: message.unit }
        }
        request::Kind::Press => match message.lasting_ns {
            Some(lasting) => {
                Stimulus::Hold { control: name, lasting: Duration::from_nanos(lasting) }
            }
            None => Stimulus::Press { control: name, held: true },
        },
        request::Kind::Release => Stimulus::Press { control: name, held: false },
        request::Kind::Fail => Stimulus::Break {
            fault: name,
            amount: message.amount,
            unit: message.unit,
            lasting: message.lasting_ns.map_or(Duration::MAX, Duration::from_nanos),
        },
        request::Kind::Fire | request::Kind::Finish => {
            let output =
                |output: Output| Some((u16::try_from(output.port).ok()?, value(output.value)));
            let outputs = message.outputs.into_iter().filter_map(output).collect();
            let ends = kind == request::Kind::Finish;
            Stimulus::Inject { component: name, outcome: message.outcome, ends, outputs }
        }
        request::Kind::Idle => {
            Stimulus::Idle { element: Some(name).filter(|name| !name.is_empty()) }
        }
        request::Kind::Move => {
            let what = if name.is_empty() { Put::Robot } else { Put::Thing(name) };
            Stimulus::Put { what, at: decode_pose(&message.pose) }
        }
        request::Kind::Drop => {
            Stimulus::Put { what: Put::New(name), at: decode_pose(&message.pose) }
        }
        request::Kind::Stop => Stimulus::Stop,
    };
    Some(Requested { at, what, done })
}

fn decode_pose(numbers: &[f64]) -> Pose2 {
    let number = |at: usize| numbers.get(at).copied().unwrap_or_default();
    Pose2 { x: number(0), y: number(1), heading: number(2) }
}

/// A value of an entry as a message.
pub(crate) fn entry(names: &(impl Names + ?Sized), id: TraceEntryId, value: ValueRef<'_>) -> Entry {
    let EntryName { path, ty, unit, .. } = names.entry(id);
    Entry {
        name: path.to_owned(),
        r#type: ty.to_owned(),
        unit: unit.to_owned(),
        value: Some(encode_value(Datum::new(names, Holder::Entry(id), value))),
    }
}

/// What the plan consists of, as a message.
pub(crate) fn table(names: &(impl Names + ?Sized)) -> PlanTable {
    let outcomes = |id| {
        let named = |(outcome, name): (_, &str)| Outcome {
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

/// The instant of a protobuf time stamp; one before zero counts as zero.
pub(crate) fn instant(time: &Option<Timestamp>) -> Instant {
    let Some(Timestamp { seconds, nanos }) = *time else { return Instant::ZERO };
    let (seconds, nanos) = (u64::try_from(seconds), u64::try_from(nanos));
    let (seconds, nanos) = (seconds.unwrap_or(0), nanos.unwrap_or(0));
    Instant::from_nanos(seconds.saturating_mul(1_000_000_000).saturating_add(nanos))
}

/// An instant as protobuf writes it.
pub(crate) fn timestamp(at: Instant) -> Timestamp {
    let nanos = at.as_nanos();
    // Both fit: a u64 holds 584 years of nanoseconds.
    Timestamp { seconds: (nanos / 1_000_000_000) as i64, nanos: (nanos % 1_000_000_000) as i32 }
}
