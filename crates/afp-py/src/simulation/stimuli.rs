//! What happens to the robot and the plan from outside, by its names.

use afp_carbot::table::TABLE;
use afp_core::devices::{ControlId, FaultId, controls, faults, find_control};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// A control by name.
pub fn control(name: &str) -> PyResult<ControlId> {
    find_control(TABLE, name).ok_or_else(|| {
        let known: Vec<_> = controls(TABLE).map(|(_, _, row)| row.name).collect();
        let known = known.join(", ");
        PyValueError::new_err(format!("nothing called '{name}' can be pressed; there are: {known}"))
    })
}

/// A fault by its names, with its amount in SI units: a delay, seconds, or a share.
pub fn fault(
    device: &str,
    kind: &str,
    delay: Option<f64>,
    share: Option<f64>,
) -> PyResult<(FaultId, Option<f64>)> {
    let found = faults(TABLE).find(|(_, at, row)| at.name == device && row.name == kind);
    let (id, _, row) = found.ok_or_else(|| no_fault(device, kind))?;
    let of = |unit: &str| row.amount.filter(|of| of.unit == unit);
    for (given, unit, what) in [(delay, "s", "delay"), (share, "", "share")] {
        let Some(amount) = given else { continue };
        let Some(of) = of(unit) else {
            let text = format!("a {what} says nothing of '{kind}'");
            return Err(PyValueError::new_err(text));
        };
        if of.checked(Some(amount)).is_none() {
            let text = format!("{what} is {amount}; give a number from {} to {}", of.from, of.to);
            return Err(PyValueError::new_err(text));
        }
    }
    Ok((id, delay.or(share)))
}

fn no_fault(device: &str, kind: &str) -> PyErr {
    let of = faults(TABLE).filter(|(_, at, _)| at.name == device);
    let kinds: Vec<_> = of.map(|(_, _, row)| row.name).collect();
    let text = match kinds.is_empty() {
        true => format!("nothing called '{device}' can break; afp.faults() has all"),
        false => format!("'{device}' cannot be '{kind}', but: {}", kinds.join(", ")),
    };
    PyValueError::new_err(text)
}
