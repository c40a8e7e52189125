//! A computation in Python.

use afp::load::{ComputationSlot, See};
use afp_core::Fault;
use afp_core::rt::{Args, Outputs};
use pyo3::exceptions::PyTypeError;

use super::call::Callee;

/// A computation in Python.
pub struct PyComputation {
    callee: Callee,
}

impl PyComputation {
    pub fn new(callee: Callee) -> Self {
        PyComputation { callee }
    }
}

impl ComputationSlot for PyComputation {
    fn compute(&self, args: &dyn Args, see: See<'_>, to: &mut dyn Outputs) -> Result<u16, Fault> {
        let callee = &self.callee;
        let inputs = callee.inputs(args, see)?;
        let name = &callee.template()?.name;
        let told = callee.host.ask(name, |py| {
            let said = callee.make(py, (inputs.dict(py)?,))?;
            let none = || PyTypeError::new_err(format!("'{name}' returned None, not a state"));
            callee.told(&said)?.ok_or_else(none)
        })?;
        Ok(told.give(to))
    }
}
