//! An actor in Python.

use afp::load::{ActorSlot, See};
use afp_core::rt::{Args, BadValue, Outputs};
use afp_core::{Duration, Fault, Instant};
use afp_session::Simulated;
use pyo3::prelude::*;

use super::PyHandle;
use super::call::PyTemplate;
use crate::callout::{self, Arguments};

/// The slot of an actor in Python.
pub struct PyActor {
    template: PyTemplate,
    running: Option<Running>,
}

/// A running actor.
struct Running {
    /// Its method.
    poll: PyHandle,
    actor: PyHandle,
}

impl PyActor {
    pub fn new(template: PyTemplate) -> Self {
        PyActor { template, running: None }
    }

    /// Calls a method of the running actor that returns nothing.
    fn call<R: Simulated>(
        &self,
        env: &mut R,
        name: &str,
        with: impl for<'py> Arguments<'py>,
    ) -> Result<(), Fault> {
        let template = &self.template;
        let running = self.running.as_ref().ok_or(Fault::INTERNAL)?;
        template.host.call_with_robot(env, &template.caller, |py| {
            callout::call(&running.actor.get(py)?.getattr(name)?, with).map(drop)
        })
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
            let poll = template.host.handles.put(actor.getattr("poll")?.unbind());
            Ok(Running { poll, actor: template.host.handles.put(actor.unbind()) })
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
        self.call(env, "interrupt", ())
    }

    fn suspend(&mut self, env: &mut R, _: Instant) -> Result<bool, Fault> {
        if !self.template.declared()?.resumable {
            return Ok(false);
        }
        self.call(env, "suspend", ()).map(|()| true)
    }

    fn resume(&mut self, env: &mut R, _: Instant, away: Duration) -> Result<(), Fault> {
        self.call(env, "resume", (away.as_secs_f64(),))
    }

    fn clear(&mut self) {
        self.running = None;
    }
}
