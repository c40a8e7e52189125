//! A supervisor in Python.

use afp::load::{See, SupervisorSlot};
use afp_core::rt::{Args, Outputs};
use afp_core::{Events, Fault, Instant};
use afp_session::Simulated;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::PyHandle;
use super::call::PyTemplate;

/// The slot of a supervisor in Python.
pub struct PySupervisor {
    template: PyTemplate,
    /// Its method.
    poll: Option<PyHandle>,
}

impl PySupervisor {
    pub fn new(template: PyTemplate) -> Self {
        PySupervisor { template, poll: None }
    }
}

impl<R: Simulated> SupervisorSlot<R> for PySupervisor {
    fn start(
        &mut self,
        args: &dyn Args,
        wanted: Events,
        see: See<'_>,
        env: &mut R,
        _: Instant,
    ) -> Result<(), Fault> {
        let template = &self.template;
        let inputs = template.inputs(args, see)?;
        let declared = template.declared()?;
        let events = (0..).zip(&declared.outcomes).filter(|(event, _)| wanted.contains(*event));
        let events: Vec<_> = events.map(|(_, event)| event.name.as_str()).collect();
        let poll = template.host.call_with_robot(env, &template.caller, |py| {
            let robot = template.host.robot.clone_ref(py);
            let wanted = PyTuple::new(py, &events)?;
            let supervisor = template.make(py, (robot, inputs.dict(py)?, wanted))?;
            Ok(template.host.handles.put(supervisor.getattr("poll")?.unbind()))
        })?;
        self.poll = Some(poll);
        Ok(())
    }

    fn poll(
        &mut self,
        args: &dyn Args,
        to: &mut dyn Outputs,
        env: &mut R,
        _: Instant,
    ) -> Result<Option<u16>, Fault> {
        let poll = self.poll.as_ref().ok_or(Fault::INTERNAL)?;
        self.template.poll(poll, args, to, env)
    }

    fn clear(&mut self) {
        self.poll = None;
    }
}
