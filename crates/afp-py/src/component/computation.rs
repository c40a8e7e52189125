//! A computation in Python.

use afp::load::{ComputationSlot, See};
use afp_core::rt::{Args, BadValue, Outputs};
use pyo3::exceptions::PyTypeError;

use super::call::PyTemplate;

/// A computation in Python.
pub struct PyComputation {
    template: PyTemplate,
}

impl PyComputation {
    pub fn new(template: PyTemplate) -> Self {
        PyComputation { template }
    }
}

impl ComputationSlot for PyComputation {
    fn compute(
        &self,
        args: &dyn Args,
        see: See<'_>,
        to: &mut dyn Outputs,
    ) -> Result<u16, BadValue> {
        let template = &self.template;
        let inputs = template.inputs(args, see)?;
        let name = &template.declared()?.name;
        let outcome = template.host.call(name, |py| {
            let said = template.make(py, (inputs.dict(py)?,))?;
            let none = || PyTypeError::new_err(format!("'{name}' returned None, not a state"));
            template.outcome(&said)?.ok_or_else(none)
        })?;
        Ok(outcome.give(to))
    }
}
