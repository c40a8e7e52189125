//! An actor in Python.

use afp::load::{ActorSlot, See};
use afp_core::rt::{Args, Outputs};
use afp_core::{Fault, Instant};
use afp_sim::Simulation;
use pyo3::prelude::*;

use super::call::Callee;

/// The home of an actor in Python.
pub struct PyActor {
    callee: Callee,
    running: Option<Running>,
}

/// The methods of a running actor.
struct Running {
    poll: Py<PyAny>,
    interrupt: Py<PyAny>,
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
            let actor = callee.maker(py).call1((robot, inputs.dict(py)?))?;
            let method = |name: &str| actor.getattr(name).map(Bound::unbind);
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
        let callee = &self.callee;
        let running = self.running.as_ref().ok_or(Fault::INTERNAL)?;
        let live = callee.live(args)?;
        let told = callee.host.lend(env, &callee.template()?.name, |py| {
            callee.told(&call(py, &running.poll, &live)?)
        })?;
        Ok(told.map(|told| {
            let outcome = told.outcome;
            told.give(to);
            outcome
        }))
    }

    fn interrupt(&mut self, env: &mut Simulation, _: Instant) -> Result<(), Fault> {
        let callee = &self.callee;
        let running = self.running.as_ref().ok_or(Fault::INTERNAL)?;
        callee.host.lend(env, &callee.template()?.name, |py| running.interrupt.call0(py).map(drop))
    }

    fn clear(&mut self) {
        self.running = None;
    }
}

/// Calls a `poll`, with the live inputs if there are any.
pub(super) fn call<'py>(
    py: Python<'py>,
    poll: &Py<PyAny>,
    live: &super::call::Inputs<'_>,
) -> PyResult<Bound<'py, PyAny>> {
    match live.is_empty() {
        true => poll.bind(py).call0(),
        false => poll.bind(py).call1((live.dict(py)?,)),
    }
}
