//! Stimuli for the robot and the plan, by name.

use afp_core::Value;
use afp_core::devices::{ControlId, FaultId, faults, find_control, find_stop};
use afp_dsl::graph::Graph;
use afp_dsl::types::Type;
use afp_run::requests::{no_control, no_fault};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::link::devices;
use crate::value::to_port;

/// A control by name; the default is the one that ends a run.
pub fn control(name: Option<&str>) -> PyResult<ControlId> {
    let Some(name) = name else {
        let none =
            || PyValueError::new_err("the robot has no control that ends plans; name a control");
        return find_stop(devices()).ok_or_else(none);
    };
    let none = || PyValueError::new_err(no_control(devices(), name));
    find_control(devices(), name).ok_or_else(none)
}

/// A fault by its names, with its amount in SI units: a delay in seconds, or a share.
pub fn fault(
    device: &str,
    kind: &str,
    delay: Option<f64>,
    share: Option<f64>,
) -> PyResult<(FaultId, Option<f64>)> {
    let found = faults(devices()).find(|(_, at, row)| at.name == device && row.name == kind);
    let unknown = || PyValueError::new_err(no_fault(devices(), device, kind));
    let (id, _, row) = found.ok_or_else(unknown)?;
    let of = |unit: &str| row.amount.filter(|of| of.unit == unit);
    for (given, unit, what) in [(delay, "s", "delay"), (share, "", "share")] {
        let Some(amount) = given else { continue };
        let Some(of) = of(unit) else {
            let text = format!("a {what} has no amount '{kind}'");
            return Err(PyValueError::new_err(text));
        };
        if of.checked(Some(amount)).is_none() {
            let text = format!("{what} is {amount}; give a number from {} to {}", of.from, of.to);
            return Err(PyValueError::new_err(text));
        }
    }
    Ok((id, delay.or(share)))
}

/// The values of an outcome: one for each of its connected outputs, as in a scenario.
///
/// # Errors
/// A value is missing, not connected or does not fit.
pub fn outputs(
    graph: &Graph,
    (component, outcome, number): (&str, &str, u16),
    given: &Bound<'_, PyDict>,
) -> PyResult<Vec<(u16, Value)>> {
    let wanted = afp_dsl::outputs(graph, component, number);
    for name in given.keys() {
        let name: String = name.extract()?;
        if !wanted.iter().any(|(_, known, _)| *known == name) {
            let text = format!("'{component}.{outcome}' has no connected output '{name}'");
            return Err(PyValueError::new_err(text));
        }
    }
    let value = |(port, name, ty): &(u16, String, Type)| {
        let missing = || {
            let what = format!("'{component}.{outcome}' also has the output '{name}'");
            let help = format!("give outputs={{\"{name}\": ...}}");
            PyValueError::new_err(format!("{what}, which has no value here: {help}"))
        };
        let value = given.get_item(name)?.ok_or_else(missing)?;
        Ok((*port, to_port(ty, &value)?))
    };
    wanted.iter().map(value).collect()
}
