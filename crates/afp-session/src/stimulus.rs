//! Requests with names in place of ids, so that they outlive the program and the plan that they were made for.

use std::fmt;

#[cfg(feature = "load")]
use afp::load::Injection;
use afp_core::devices::{ControlId, DeviceRow, controls, faults, find_control, find_fault};
#[cfg(feature = "load")]
use afp_core::trace::ComponentKind;
use afp_core::trace::{ComponentId, Names, TraceEntryId};
#[cfg(feature = "load")]
use afp_core::trace::{Outcome, declared};
use afp_core::{Duration, EntryId};
use afp_types::Measured;

use crate::datum::{Datum, Holder};
use crate::request::{HOLD, Put, Request, RequestError};
use crate::sample::Pose2;

/// Something that comes from outside, by names.
#[derive(Clone, Debug, PartialEq)]
pub enum Stimulus {
    /// An entry of the plan itself is written.
    Write {
        /// Its name.
        entry: String,
        /// The value, quantities in SI units.
        value: Datum,
        /// The SI unit.
        unit: String,
    },
    /// A control is held down until it is let go, or let go, whoever holds it.
    Press {
        /// Device and control, `touch.touch`.
        control: String,
        /// Whether it is held down.
        held: bool,
    },
    /// A control is held down for a while, and then for as long as somebody else holds it.
    Hold {
        /// Device and control.
        control: String,
        /// For how long.
        lasting: Duration,
    },
    /// Something breaks.
    Break {
        /// Device and fault, `wheels.slip`.
        fault: String,
        /// By how much, in SI units; none for as much as the robot's devices declare.
        amount: Option<f64>,
        /// The SI unit of the amount, empty for a plain number; what asks need not say it.
        unit: String,
        /// For how long; [`Duration::MAX`] is for good.
        lasting: Duration,
    },
    /// A component reports an outcome at its next poll, whatever it sees.
    Inject {
        /// Its path.
        component: String,
        /// The state or event.
        outcome: String,
        /// Whether it is a state, by which an element ends.
        ends: bool,
        /// The outputs that come with it, by position among the template's.
        outputs: Vec<(u16, Datum)>,
    },
    /// An actor, those of a sub-plan, or all of them (none) do nothing from their next start on.
    Idle {
        /// The path.
        element: Option<String>,
    },
    /// Something of a simulated world is put somewhere by hand: metres, radians.
    Put {
        /// What.
        what: Put,
        /// Where.
        at: Pose2,
    },
    /// The plan ends as interrupted.
    Stop,
}

impl Stimulus {
    /// A request of a session with those devices and names.
    pub fn new(
        request: &Request,
        devices: &[DeviceRow],
        names: &(impl Names + ?Sized),
    ) -> Stimulus {
        let dotted = |device: &DeviceRow, name: &str| format!("{}.{name}", device.name);
        let control = |id: ControlId| {
            let found = controls(devices).find(|(known, ..)| *known == id);
            found.map(|(_, device, row)| dotted(device, row.name)).unwrap_or_default()
        };
        match request {
            Request::Write(entry, value) => {
                let id = TraceEntryId::from(*entry);
                Stimulus::Write {
                    entry: names.entry(id).path.to_owned(),
                    value: Holder::Entry(id).named(names, value.as_deref()),
                    unit: names.entry(id).unit.to_owned(),
                }
            }
            Request::Press(id, held) => Stimulus::Press { control: control(*id), held: *held },
            Request::Hold(id, lasting) => {
                Stimulus::Hold { control: control(*id), lasting: *lasting }
            }
            Request::Break(id, amount, lasting) => {
                let found = faults(devices).find(|(known, ..)| known == id);
                let fault = found.map(|(_, device, row)| dotted(device, row.name));
                let unit = found.and_then(|(.., row)| row.amount).map_or("", |amount| amount.unit);
                Stimulus::Break {
                    fault: fault.unwrap_or_default(),
                    amount: *amount,
                    unit: unit.to_owned(),
                    lasting: *lasting,
                }
            }
            #[cfg(feature = "load")]
            Request::Inject(Injection { component, outcome, outputs }) => Stimulus::Inject {
                component: names.component(*component).path.to_owned(),
                outcome: names.outcome(*component, *outcome).to_owned(),
                ends: names.component(*component).kind != ComponentKind::Supervisor,
                outputs: outputs
                    .iter()
                    .map(|(port, value)| (*port, Holder::Unknown.named(names, value.as_deref())))
                    .collect(),
            },
            Request::Idle(element) => {
                let path = |id: &ComponentId| names.component(*id).path.to_owned();
                Stimulus::Idle { element: element.as_ref().map(path) }
            }
            Request::Put(what, at) => Stimulus::Put { what: what.clone(), at: *at },
            Request::Stop => Stimulus::Stop,
        }
    }

    /// The request of a session with those devices and names.
    ///
    /// # Errors
    /// A name that is not known there.
    pub fn request(
        &self,
        devices: &[DeviceRow],
        names: &(impl Names + ?Sized),
    ) -> Result<Request, RequestError> {
        Ok(match self {
            Stimulus::Write { entry, value, .. } => {
                let mut ids = (0..names.entries()).map(TraceEntryId);
                let unknown = || RequestError::NoEntry(entry.clone());
                let id = ids.find(|id| names.entry(*id).path == entry).ok_or_else(unknown)?;
                let number = u16::try_from(id.0).map_err(|_| unknown())?;
                let value = Holder::Entry(id).value(names, value).ok_or_else(unknown)?;
                Request::Write(EntryId(number), value)
            }
            Stimulus::Press { control, held } => {
                let id = find_control(devices, control).ok_or(RequestError::NoControl)?;
                Request::Press(id, *held)
            }
            Stimulus::Hold { control, lasting } => {
                let id = find_control(devices, control).ok_or(RequestError::NoControl)?;
                Request::Hold(id, *lasting)
            }
            Stimulus::Break { fault, amount, lasting, .. } => {
                let found = fault.split_once('.').and_then(|(at, of)| find_fault(devices, at, of));
                Request::Break(found.ok_or(RequestError::NoFault)?, *amount, *lasting)
            }
            Stimulus::Inject { component, outcome, outputs, .. } => {
                injection(names, component, outcome, outputs)?
            }
            Stimulus::Idle { element: None } => Request::Idle(None),
            Stimulus::Idle { element: Some(path) } => {
                Request::Idle(Some(find(names, path).ok_or(RequestError::NoElement)?))
            }
            Stimulus::Put { what, at } => Request::Put(what.clone(), *at),
            Stimulus::Stop => Request::Stop,
        })
    }
}

fn find(names: &(impl Names + ?Sized), path: &str) -> Option<ComponentId> {
    (0..names.components()).map(ComponentId).find(|id| names.component(*id).path == path)
}

#[cfg(feature = "load")]
fn injection(
    names: &(impl Names + ?Sized),
    path: &str,
    outcome: &str,
    outputs: &[(u16, Datum)],
) -> Result<Request, RequestError> {
    let component = find(names, path).ok_or(RequestError::NoElement)?;
    let known = declared(names, component).map(|(known, _)| known);
    let outcome = known
        .chain([Outcome::Error, Outcome::DeadlineMissed])
        .find(|known| names.outcome(component, *known) == outcome)
        .ok_or_else(|| RequestError::NoOutcome(format!("{path}.{outcome}")))?;
    let outputs = outputs
        .iter()
        .filter_map(|(port, value)| Some((*port, Holder::Unknown.value(names, value)?)));
    Ok(Request::Inject(Injection { component, outcome, outputs: outputs.collect() }))
}

#[cfg(not(feature = "load"))]
fn injection(
    _: &(impl Names + ?Sized),
    _: &str,
    _: &str,
    _: &[(u16, Datum)],
) -> Result<Request, RequestError> {
    Err(RequestError::Compiled)
}

impl fmt::Display for Stimulus {
    /// In the words of scenarios, as far as they have such words.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Stimulus::Write { entry, value, unit } if unit.is_empty() => {
                write!(f, "set {entry} = {value}")
            }
            Stimulus::Write { entry, value, unit } => write!(f, "set {entry} = {value} {unit}"),
            Stimulus::Press { control, held: true } => write!(f, "press {control}"),
            Stimulus::Press { control, held: false } => write!(f, "release {control}"),
            Stimulus::Hold { control, lasting: HOLD } => write!(f, "press {control}"),
            Stimulus::Hold { control, lasting } => {
                write!(f, "press {control} for {} s", lasting.as_secs_f64())
            }
            Stimulus::Break { fault, amount, unit, lasting } => {
                write!(f, "fail {fault}")?;
                if let Some(amount) = amount {
                    write!(f, " = {}", Measured::new(*amount, unit))?;
                }
                match *lasting {
                    Duration::MAX => Ok(()),
                    lasting => write!(f, " for {} s", lasting.as_secs_f64()),
                }
            }
            Stimulus::Inject { component, outcome, ends, .. } => {
                let word = if *ends { "finish" } else { "fire" };
                write!(f, "{word} {component}.{outcome}")
            }
            Stimulus::Idle { element: Some(path) } => write!(f, "idle {path}"),
            Stimulus::Idle { element: None } => f.write_str("idle all"),
            Stimulus::Put { what, at: Pose2 { x, y, heading } } => {
                match what {
                    Put::Robot => f.write_str("move the robot")?,
                    Put::Thing(name) => write!(f, "move {name}")?,
                    Put::New(shape) => write!(f, "drop {shape}")?,
                }
                write!(f, " to {x:.2} m, {y:.2} m, {:.0}°", heading.to_degrees())
            }
            Stimulus::Stop => f.write_str("stop"),
        }
    }
}
