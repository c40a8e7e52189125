//! A supervisor in Python.

use afp::load::{See, SupervisorSlot};
use afp_core::rt::{Args, Outputs};
use afp_core::{Events, Fault, Instant};
use afp_sim::Simulation;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::PyHandle;
use super::call::Callee;

/// The home of a supervisor in Python.
pub struct PySupervisor {
    callee: Callee,
    /// Its method.
    poll: Option<PyHandle>,
}

impl PySupervisor {
    pub fn new(callee: Callee) -> Self {
        PySupervisor { callee, poll: None }
    }
}

impl SupervisorSlot<Simulation> for PySupervisor {
    fn start(
        &mut self,
        args: &dyn Args,
        wanted: Events,
        see: See<'_>,
        env: &mut Simulation,
        _: Instant,
    ) -> Result<(), Fault> {
        let callee = &self.callee;
        let inputs = callee.inputs(args, see)?;
        let template = callee.template()?;
        let events = (0..).zip(&template.outcomes).filter(|(event, _)| wanted.contains(*event));
        let events: Vec<_> = events.map(|(_, event)| event.name.as_str()).collect();
        let poll = callee.host.lend(env, &template.name, |py| {
            let robot = callee.host.robot.clone_ref(py);
            let wanted = PyTuple::new(py, &events)?;
            let supervisor = callee.make(py, (robot, inputs.dict(py)?, wanted))?;
            Ok(callee.host.handles.put(supervisor.getattr("poll")?.unbind()))
        })?;
        self.poll = Some(poll);
        Ok(())
    }

    fn poll(
        &mut self,
        args: &dyn Args,
        to: &mut dyn Outputs,
        env: &mut Simulation,
        _: Instant,
    ) -> Result<Option<u16>, Fault> {
        let poll = self.poll.as_ref().ok_or(Fault::INTERNAL)?;
        self.callee.poll(poll, args, to, env)
    }

    fn clear(&mut self) {
        self.poll = None;
    }
}
