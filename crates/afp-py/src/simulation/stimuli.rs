//! What happens to the robot and the plan from outside.

use afp::load::Injection;
use afp_carbot::table::{TABLE, named};
use afp_core::devices::faults;
use afp_core::trace::ComponentId;
use afp_core::{Duration, Value};
use afp_dsl::scenario::devices::amount;
use afp_sim::Fault;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Something to be done at an instant.
#[derive(Clone, Debug)]
pub enum Deed {
    /// An entry is written.
    Write(u16, Value),
    /// A control is held down or let go.
    Hold(Control, bool),
    /// Something breaks for a while.
    Break(Fault, Duration),
    /// A component reports what it does not see.
    Inject(Injection),
    /// An actor, those of a sub-plan, or all of them do nothing from their next start on.
    Idle(Option<ComponentId>),
}

/// What people hold down.
#[derive(Clone, Copy, Debug)]
pub enum Control {
    Escape,
    Bumper,
}

impl Control {
    /// A control by name.
    pub fn named(name: &str) -> PyResult<Control> {
        match name {
            "escape" => Ok(Control::Escape),
            "touch" => Ok(Control::Bumper),
            _ => Err(PyValueError::new_err(format!(
                "nothing called '{name}' can be pressed; there are: escape, touch"
            ))),
        }
    }
}

/// A fault by its names.
pub fn fault(
    device: &str,
    kind: &str,
    time: Option<Duration>,
    share: Option<f64>,
) -> PyResult<Fault> {
    let known = amount(kind).map(|(name, _)| name);
    if time.is_some() && known != Some("time") || share.is_some() && known != Some("share") {
        let what = if share.is_some() { "share" } else { "delay" };
        let text = format!("a {what} says nothing of '{kind}'");
        return Err(PyValueError::new_err(text));
    }
    if let Some(share) = share.filter(|share| !(0.0..=1.0).contains(share)) {
        return Err(PyValueError::new_err(format!("share is {share}; give a number from 0 to 1")));
    }
    let amount = time.map(Duration::as_secs_f64).or(share);
    named(device, kind, amount).ok_or_else(|| {
        let of = faults(TABLE).filter(|(_, at, _)| at.name == device);
        let kinds: Vec<_> = of.map(|(_, _, row)| row.name).collect();
        let text = match kinds.is_empty() {
            true => format!("nothing called '{device}' can break; afp.faults() has all"),
            false => format!("'{device}' cannot be '{kind}', but: {}", kinds.join(", ")),
        };
        PyValueError::new_err(text)
    })
}
