//! Requests with names instead of ids, so that they remain valid beyond the program and the plan.

use std::fmt;

use afp_core::devices::{ControlId, DeviceRow, controls, faults, find_control, find_fault};
use afp_core::trace::{ComponentId, ComponentKind, Names, Outcome, TraceEntryId, declared};
use afp_core::{Duration, EntryId, Release, Value};
use afp_types::Measured;

use crate::datum::{Datum, Holder};
use crate::request::{HOLD, Held, Put, Request, RequestError, RequestOf};
use crate::sample::Pose2;

/// A request by names: a component by its path, a control or fault by device and name,
/// `wheels.slip`.
pub type Stimulus = RequestOf<ByNames>;

/// References and values by name.
#[derive(Clone, Debug, PartialEq)]
pub struct ByNames;

impl Held for ByNames {
    type Entry = NameWithUnit;
    type Value = Datum;
    type Control = String;
    type Fault = NameWithUnit;
    type Component = String;
    type Outcome = Report;
}

/// A name and the SI unit of its value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NameWithUnit {
    /// The name.
    pub name: String,
    /// The SI unit, empty for a plain number; requests may omit it.
    pub unit: String,
}

/// A state or event that a component reports.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// Its name.
    pub outcome: String,
    /// Whether it is a state, which ends an element.
    pub ends: bool,
}

impl Stimulus {
    /// Replaces the ids of a session's request by names.
    pub fn new(
        request: &Request,
        devices: &[DeviceRow],
        names: &(impl Names + ?Sized),
    ) -> Stimulus {
        let path = |id: ComponentId| names.component(id).path.to_owned();
        let dotted = |device: &DeviceRow, name: &str| format!("{}.{name}", device.name);
        let control = |id: ControlId| {
            let found = controls(devices).find(|(known, ..)| *known == id);
            found.map(|(_, device, row)| dotted(device, row.name)).unwrap_or_default()
        };
        match request {
            Request::Write(entry, value) => {
                let id = TraceEntryId::from(*entry);
                let entry = names.entry(id);
                let entry =
                    NameWithUnit { name: entry.path.to_owned(), unit: entry.unit.to_owned() };
                Stimulus::Write(entry, Holder::Entry(id).named(names, value.as_deref()))
            }
            Request::Press(id, held) => Stimulus::Press(control(*id), *held),
            Request::Hold(id, lasting) => Stimulus::Hold(control(*id), *lasting),
            Request::Break(id, amount, lasting) => {
                let found = faults(devices).find(|(known, ..)| known == id);
                let name = found.map(|(_, device, row)| dotted(device, row.name));
                let unit = found.and_then(|(.., row)| row.amount).map_or("", |amount| amount.unit);
                let name = name.unwrap_or_default();
                Stimulus::Break(NameWithUnit { name, unit: unit.to_owned() }, *amount, *lasting)
            }
            Request::Inject(component, outcome, outputs) => {
                let report = Report {
                    outcome: names.outcome(*component, *outcome).to_owned(),
                    ends: names.component(*component).kind != ComponentKind::Supervisor,
                };
                let named = |value: &Value| Holder::Unknown.named(names, value.as_deref());
                let outputs = outputs.iter().map(|(port, value)| (*port, named(value)));
                Stimulus::Inject(path(*component), report, outputs.collect())
            }
            Request::Idle(element) => Stimulus::Idle(element.map(path)),
            Request::Put(what, at) => Stimulus::Put(what.clone(), *at),
            Request::Pause => Stimulus::Pause,
            Request::Release(how) => Stimulus::Release(*how),
            Request::Stop => Stimulus::Stop,
        }
    }

    /// Replaces the names by ids of a session.
    ///
    /// # Errors
    /// A name that the session does not know.
    pub fn request(
        &self,
        devices: &[DeviceRow],
        names: &(impl Names + ?Sized),
    ) -> Result<Request, RequestError> {
        let control = |name: &str| find_control(devices, name).ok_or(RequestError::NoControl);
        let component = |path: &String| {
            let mut ids = (0..names.components()).map(ComponentId);
            ids.find(|id| names.component(*id).path == path).ok_or(RequestError::NoElement)
        };
        Ok(match self {
            Stimulus::Write(NameWithUnit { name, .. }, value) => {
                let mut ids = (0..names.entries()).map(TraceEntryId);
                let unknown = || RequestError::NoEntry(name.clone());
                let id = ids.find(|id| names.entry(*id).path == name).ok_or_else(unknown)?;
                let number = u16::try_from(id.0).map_err(|_| unknown())?;
                let value = Holder::Entry(id).value(names, value).ok_or_else(unknown)?;
                Request::Write(EntryId(number), value)
            }
            Stimulus::Press(name, held) => Request::Press(control(name)?, *held),
            Stimulus::Hold(name, lasting) => Request::Hold(control(name)?, *lasting),
            Stimulus::Break(NameWithUnit { name, .. }, amount, lasting) => {
                let found = name.split_once('.').and_then(|(at, of)| find_fault(devices, at, of));
                Request::Break(found.ok_or(RequestError::NoFault)?, *amount, *lasting)
            }
            Stimulus::Inject(path, Report { outcome, .. }, outputs) => {
                let component = component(path)?;
                let known = declared(names, component).map(|(known, _)| known);
                let outcome = known
                    .chain([Outcome::Error, Outcome::DeadlineMissed])
                    .find(|known| names.outcome(component, *known) == outcome)
                    .ok_or_else(|| RequestError::NoOutcome(format!("{path}.{outcome}")))?;
                let value = |value| Holder::Unknown.value(names, value);
                let outputs = outputs.iter().filter_map(|(at, it)| Some((*at, value(it)?)));
                Request::Inject(component, outcome, outputs.collect())
            }
            Stimulus::Idle(path) => Request::Idle(path.as_ref().map(component).transpose()?),
            Stimulus::Put(what, at) => Request::Put(what.clone(), *at),
            Stimulus::Pause => Request::Pause,
            Stimulus::Release(how) => Request::Release(*how),
            Stimulus::Stop => Request::Stop,
        })
    }
}

impl fmt::Display for Stimulus {
    /// In the words of scenarios, as far as they exist.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Stimulus::Write(NameWithUnit { name, unit }, value) if unit.is_empty() => {
                write!(f, "set {name} = {value}")
            }
            Stimulus::Write(NameWithUnit { name, unit }, value) => {
                write!(f, "set {name} = {value} {unit}")
            }
            Stimulus::Press(control, true) => write!(f, "press {control}"),
            Stimulus::Press(control, false) => write!(f, "release {control}"),
            Stimulus::Hold(control, HOLD) => write!(f, "press {control}"),
            Stimulus::Hold(control, lasting) => {
                write!(f, "press {control} for {} s", lasting.as_secs_f64())
            }
            Stimulus::Break(NameWithUnit { name, unit }, amount, lasting) => {
                write!(f, "fail {name}")?;
                if let Some(amount) = amount {
                    write!(f, " = {}", Measured::new(*amount, unit))?;
                }
                match *lasting {
                    Duration::MAX => Ok(()),
                    lasting => write!(f, " for {} s", lasting.as_secs_f64()),
                }
            }
            Stimulus::Inject(component, Report { outcome, ends }, _) => {
                let word = if *ends { "finish" } else { "fire" };
                write!(f, "{word} {component}.{outcome}")
            }
            Stimulus::Idle(Some(path)) => write!(f, "idle {path}"),
            Stimulus::Idle(None) => f.write_str("idle all"),
            Stimulus::Put(what, Pose2 { x, y, heading }) => {
                match what {
                    Put::Robot => f.write_str("move the robot")?,
                    Put::Thing(name) => write!(f, "move {name}")?,
                    Put::New(shape) => write!(f, "drop {shape}")?,
                }
                write!(f, " to {x:.2} m, {y:.2} m, {:.0}°", heading.to_degrees())
            }
            Stimulus::Pause => f.write_str("hold"),
            Stimulus::Release(Release::Continue) => f.write_str("continue"),
            Stimulus::Release(Release::Step) => f.write_str("step"),
            Stimulus::Stop => f.write_str("stop"),
        }
    }
}
