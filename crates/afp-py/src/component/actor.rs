//! An actor in Python.

use afp::load::{ActorSlot, See};
use afp_core::rt::{Args, Outputs};
use afp_core::{Fault, Instant};
use afp_sim::Simulation;
use pyo3::prelude::*;

use super::PyHandle;
use super::call::Callee;

/// The home of an actor in Python.
pub struct PyActor {
    callee: Callee,
    running: Option<Running>,
}

/// The methods of a running actor.
struct Running {
    poll: PyHandle,
    interrupt: PyHandle,
}

impl PyActor {
    pub fn new(callee: Callee) -> Self {
        PyActor { callee, running: None }
    }
}

impl ActorSlot<Simulation> for PyActor {
    fn start(
        &mut self,
        args: &dyn Args,
        see: See<'_>,
        env: &mut Simulation,
        _: Instant,
    ) -> Result<(), Fault> {
        let callee = &self.callee;
        let inputs = callee.inputs(args, see)?;
        let running = callee.host.lend(env, &callee.template()?.name, |py| {
            let robot = callee.host.robot.clone_ref(py);
            let actor = callee.make(py, (robot, inputs.dict(py)?))?;
            let method =
                |name: &str| actor.getattr(name).map(|it| callee.host.handles.put(it.unbind()));
            Ok(Running { poll: method("poll")?, interrupt: method("interrupt")? })
        })?;
        self.running = Some(running);
        Ok(())
    }

    fn poll(
        &mut self,
        args: &dyn Args,
        to: &mut dyn Outputs,
        env: &mut Simulation,
        _: Instant,
    ) -> Result<Option<u16>, Fault> {
        let running = self.running.as_ref().ok_or(Fault::INTERNAL)?;
        self.callee.poll(&running.poll, args, to, env)
    }

    fn interrupt(&mut self, env: &mut Simulation, _: Instant) -> Result<(), Fault> {
        let callee = &self.callee;
        let running = self.running.as_ref().ok_or(Fault::INTERNAL)?;
        callee
            .host
            .lend(env, &callee.template()?.name, |py| running.interrupt.get(py)?.call0().map(drop))
    }

    fn clear(&mut self) {
        self.running = None;
    }
}
