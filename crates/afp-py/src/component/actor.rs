//! An actor in Python.

use afp::load::{ActorSlot, See};
use afp_core::rt::{Args, BadValue, Outputs};
use afp_core::{Fault, Instant};
use afp_session::Simulated;
use pyo3::prelude::*;

use super::PyHandle;
use super::call::PyTemplate;
use crate::callout;

/// The slot of an actor in Python.
pub struct PyActor {
    template: PyTemplate,
    running: Option<Running>,
}

/// The methods of a running actor.
struct Running {
    poll: PyHandle,
    interrupt: PyHandle,
}

impl PyActor {
    pub fn new(template: PyTemplate) -> Self {
        PyActor { template, running: None }
    }
}

impl<R: Simulated> ActorSlot<R> for PyActor {
    fn start(
        &mut self,
        args: &dyn Args,
        see: See<'_>,
        env: &mut R,
        _: Instant,
    ) -> Result<(), BadValue> {
        let template = &self.template;
        let inputs = template.inputs(args, see)?;
        let running = template.host.call_with_robot(env, &template.caller, |py| {
            let robot = template.host.robot.clone_ref(py);
            let actor = template.make(py, (robot, inputs.dict(py)?))?;
            let method =
                |name: &str| actor.getattr(name).map(|it| template.host.handles.put(it.unbind()));
            Ok(Running { poll: method("poll")?, interrupt: method("interrupt")? })
        })?;
        self.running = Some(running);
        Ok(())
    }

    fn poll(
        &mut self,
        args: &dyn Args,
        to: &mut dyn Outputs,
        env: &mut R,
        _: Instant,
    ) -> Result<Option<u16>, BadValue> {
        let running = self.running.as_ref().ok_or(Fault::INTERNAL)?;
        self.template.poll(&running.poll, args, to, env)
    }

    fn interrupt(&mut self, env: &mut R, _: Instant) -> Result<(), Fault> {
        let template = &self.template;
        let running = self.running.as_ref().ok_or(Fault::INTERNAL)?;
        template.host.call_with_robot(env, &template.caller, |py| {
            callout::call(&running.interrupt.get(py)?, ()).map(drop)
        })
    }

    fn clear(&mut self) {
        self.running = None;
    }
}
