//! The shared state of all clients: channels with their last messages, values of parameters,
//! services.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::Sender;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::{LogError, Messages};
use afp_core::devices::{DeviceRow, controls, faults};
use afp_core::trace::{Names, TraceEntryId};
use afp_core::{Duration, Instant};
use afp_session::{AnySession, Datum, Request, Stimulus};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use super::protocol;
use super::queue::{Queue, Sent};

/// The channel with all entries.
const CONFIGURATION: &str = "/plan/configuration";

/// A client's question to the run, with a callback for the answer.
pub(crate) enum Question {
    /// A stimulus for the robot or the plan.
    Do { what: Stimulus, answer: Box<dyn FnOnce(Result<(), String>) + Send> },
    /// Writes entries from names and strings. For each entry the answer gets its new value or an
    /// error.
    Write { entries: Vec<(String, String)>, answer: Box<dyn FnOnce(Vec<Written>) + Send> },
}

/// The new value of an entry, or an error.
pub(crate) type Written = Result<Datum, String>;

/// A service of the robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Service {
    Press(String),
    Fail(String),
    Stop,
}

/// The maximum number of clients.
const CLIENTS: usize = 8;

/// A client's place, free again after drop.
pub(crate) struct Place(Arc<Hub>);

impl Drop for Place {
    fn drop(&mut self) {
        self.0.taken.fetch_sub(1, Ordering::AcqRel);
    }
}

pub(crate) struct Hub {
    name: String,
    services: Vec<Service>,
    shared: Mutex<Shared>,
    inbox: Sender<Question>,
    open: AtomicUsize,
    taken: AtomicUsize,
    over: AtomicBool,
}

#[derive(Default)]
struct Shared {
    channels: Vec<Channel>,
    units: BTreeMap<String, String>,
    parameters: BTreeMap<String, Value>,
    clients: Vec<Arc<Queue>>,
}

struct Channel {
    advertised: Value,
    configuration: bool,
    last: Option<Sent>,
}

impl Hub {
    pub fn new(
        name: &str,
        names: &dyn Names,
        services: Vec<Service>,
        inbox: Sender<Question>,
    ) -> Hub {
        let entries = (0..names.entries()).map(|id| names.entry(TraceEntryId(id)));
        let units: BTreeMap<_, _> =
            entries.map(|entry| (entry.path.to_owned(), entry.unit.to_owned())).collect();
        let parameters = units.keys().map(|path| (path.clone(), Value::Null)).collect();
        Hub {
            name: name.to_owned(),
            services,
            shared: Mutex::new(Shared { units, parameters, ..Shared::default() }),
            inbox,
            open: AtomicUsize::new(0),
            taken: AtomicUsize::new(0),
            over: AtomicBool::new(false),
        }
    }

    fn shared(&self) -> MutexGuard<'_, Shared> {
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A place for a client; `None` if all are taken.
    pub fn take_place(hub: &Arc<Hub>) -> Option<Place> {
        let more = |taken| (taken < CLIENTS).then_some(taken + 1);
        hub.taken.fetch_update(Ordering::AcqRel, Ordering::Acquire, more).ok()?;
        Some(Place(Arc::clone(hub)))
    }

    /// Adds a client and sends it the channels, parameters and services.
    pub fn join(&self, queue: &Arc<Queue>) {
        let mut shared = self.shared();
        let info = json!({
            "op": "serverInfo", "name": self.name, "supportedEncodings": ["json"],
            "capabilities": ["parameters", "parametersSubscribe", "services"], "metadata": {},
        });
        queue.answer(info.to_string());
        let channels: Vec<_> = shared.channels.iter().map(|each| &each.advertised).collect();
        queue.answer(json!({"op": "advertise", "channels": channels}).to_string());
        let services = self.services.iter().zip(1_u32..).map(|(it, id)| it.advertised(id));
        let services: Vec<_> = services.collect();
        queue.answer(json!({"op": "advertiseServices", "services": services}).to_string());
        shared.clients.push(Arc::clone(queue));
    }

    /// Removes a client.
    pub fn leave(&self, queue: &Arc<Queue>) {
        self.shared().clients.retain(|known| !Arc::ptr_eq(known, queue));
    }

    pub fn clients(&self) -> usize {
        self.shared().clients.len()
    }

    /// Subscribes a client to a channel: it gets the last message, and all later ones.
    pub fn subscribe(&self, queue: &Queue, channel: u32, subscription: u32) -> Result<(), String> {
        let shared = self.shared();
        let number = usize::try_from(channel).unwrap_or(usize::MAX);
        let found = shared.channels.get(number);
        let found = found.ok_or_else(|| format!("there is no channel {channel}"))?;
        queue.subscribe(channel, subscription);
        found.last.iter().for_each(|last| queue.message(channel, last));
        Ok(())
    }

    /// The values of parameters, of all without a name, as a message.
    pub fn values(&self, names: &[String], id: Option<&str>) -> String {
        let shared = self.shared();
        match names {
            [] => protocol::values(&shared.parameters, id),
            names => protocol::values(&shared.known(names), id),
        }
    }

    /// The values of parameters after a write or a failed write, as a message: the run's message
    /// comes later.
    pub fn values_after(&self, written: Vec<(String, Option<Datum>)>, id: &str) -> String {
        let shared = self.shared();
        let (names, written): (Vec<_>, Vec<_>) = written.into_iter().unzip();
        let mut values = shared.known(&names);
        for (name, datum) in names.iter().zip(written) {
            if let (Some(value), Some(datum)) = (values.get_mut(name), datum) {
                *value = shared.shown(name, &datum);
            }
        }
        protocol::values(&values, Some(id))
    }

    /// Subscribes a client to changes of parameters, of all without a name.
    pub fn watch(&self, queue: &Queue, names: &[String]) {
        let shared = self.shared();
        match names {
            [] => queue.watch(shared.parameters.keys().cloned()),
            names => queue.watch(shared.known(names).into_keys()),
        }
    }

    pub fn service(&self, id: u32) -> Option<&Service> {
        self.services.get(usize::try_from(id.checked_sub(1)?).ok()?)
    }

    /// Sends a question to the run.
    pub fn ask(&self, question: Question) {
        self.open.fetch_add(1, Ordering::Release);
        // Without a run, there is no receiver.
        let _ = self.inbox.send(question);
    }

    pub fn is_asked(&self) -> bool {
        self.open.load(Ordering::Acquire) > 0
    }

    pub fn answered(&self) {
        self.open.fetch_sub(1, Ordering::Release);
    }

    pub fn end(&self) {
        self.over.store(true, Ordering::Release);
    }

    pub fn is_over(&self) -> bool {
        self.over.load(Ordering::Acquire)
    }

    /// Replaces the values of all entries and sends the changed ones to subscribers.
    fn configure(shared: &mut Shared, entries: Vec<(String, Datum)>) {
        let mut changed = Vec::new();
        for (path, datum) in entries {
            let value = shared.shown(&path, &datum);
            if shared.parameters.get(&path) != Some(&value) {
                changed.push((path.clone(), value.clone()));
                shared.parameters.insert(path, value);
            }
        }
        for client in &shared.clients {
            let watched = changed.iter().filter(|(name, _)| client.watches(name));
            let watched: BTreeMap<_, _> = watched.cloned().collect();
            if !watched.is_empty() {
                client.answer(protocol::values(&watched, None));
            }
        }
    }
}

impl Shared {
    /// The existing parameters among these names, with their values.
    fn known(&self, names: &[String]) -> BTreeMap<String, Value> {
        let known = names.iter().filter_map(|name| self.parameters.get_key_value(name));
        known.map(|(name, value)| (name.clone(), value.clone())).collect()
    }

    fn shown(&self, entry: &str, datum: &Datum) -> Value {
        shown(datum, self.units.get(entry).map_or("", String::as_str))
    }
}

/// A value as a parameter, with a unit for quantities.
fn shown(datum: &Datum, unit: &str) -> Value {
    match datum {
        Datum::Unset | Datum::Object(_) => Value::Null,
        Datum::Bool(truth) => json!(truth),
        Datum::Int(integer) => json!(integer),
        Datum::Float(number) if unit.is_empty() => json!(number),
        Datum::Text(text) | Datum::Choice(text) => json!(text),
        Datum::Float(_) => json!(datum.in_unit(unit).to_string()),
    }
}

impl Service {
    /// The services of a session's robot, and the service that stops the plan.
    pub fn all(session: &dyn AnySession) -> Vec<Service> {
        let devices = session.devices();
        let dotted = |device: &DeviceRow, name: &str| format!("{}.{name}", device.name);
        let presses = controls(devices).filter_map(|(id, at, row)| {
            session.can(&Request::Press(id, true)).ok()?;
            Some(Service::Press(dotted(at, row.name)))
        });
        let fails = faults(devices).filter_map(|(id, at, row)| {
            let amount = row.amount.map(|amount| amount.default);
            session.can(&Request::Break(id, amount, Duration::MAX)).ok()?;
            Some(Service::Fail(dotted(at, row.name)))
        });
        presses.chain(fails).chain([Service::Stop]).collect()
    }

    fn advertised(&self, id: u32) -> Value {
        let number = json!({"type": "number"});
        let (name, ty, properties) = match self {
            Service::Press(control) => {
                (format!("press/{control}"), "afp.Press", json!({"held": {"type": "boolean"}}))
            }
            Service::Fail(fault) => {
                (format!("fail/{fault}"), "afp.Fail", json!({"amount": number, "seconds": number}))
            }
            Service::Stop => ("stop".to_owned(), "afp.Stop", json!({})),
        };
        let schema = |properties: Value| {
            let schema = json!({"type": "object", "properties": properties}).to_string();
            json!({"encoding": "json", "schemaName": ty, "schemaEncoding": "jsonschema", "schema": schema})
        };
        let (request, response) = (schema(properties), schema(json!({})));
        json!({"id": id, "name": name, "type": ty, "request": request, "response": response})
    }
}

/// The run's end of the message stream.
pub(crate) struct Stream(pub Arc<Hub>);

impl Messages for Stream {
    fn open(&mut self, topic: &str, schema: &str, set: &[u8]) -> Result<u16, LogError> {
        let mut shared = self.0.shared();
        let id = shared.channels.len() as u16;
        let advertised = json!({
            "id": id, "topic": topic, "encoding": "protobuf", "schemaName": schema,
            "schema": STANDARD.encode(set), "schemaEncoding": "protobuf",
        });
        let message = json!({"op": "advertise", "channels": [advertised]}).to_string();
        shared.clients.iter().for_each(|client| client.answer(message.clone()));
        let configuration = topic == CONFIGURATION;
        shared.channels.push(Channel { advertised, configuration, last: None });
        Ok(id)
    }

    fn send(&mut self, channel: u16, _: u32, at: Instant, message: &[u8]) -> Result<(), LogError> {
        let mut shared = self.0.shared();
        let sent = Sent { at: at.as_nanos(), payload: message.into() };
        shared.clients.iter().for_each(|client| client.message(channel.into(), &sent));
        let Some(known) = shared.channels.get_mut(usize::from(channel)) else { return Ok(()) };
        known.last = Some(sent);
        if known.configuration
            && let Some(all) = crate::configuration(message)
        {
            Hub::configure(&mut shared, all.entries);
        }
        Ok(())
    }

    fn came(&mut self, _: Vec<(String, String)>) -> Result<(), LogError> {
        Ok(())
    }

    fn flush(&mut self) -> Result<(), LogError> {
        Ok(())
    }

    fn finish(self: Box<Self>, _: bool) -> Result<(PathBuf, u64), LogError> {
        Ok((PathBuf::new(), 0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknown_names_are_not_kept() {
        let (ask, _inbox) = std::sync::mpsc::channel();
        let hub = Hub::new("P", &crate::LogNames::default(), Vec::new(), ask);
        let queue = Queue::default();
        hub.watch(&queue, &["x".repeat(1 << 20)]);
        hub.watch(&queue, &[]);
        assert!(!queue.watches(&"x".repeat(1 << 20)));
    }
}
