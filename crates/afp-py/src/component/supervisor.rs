//! A supervisor in Python.

use afp::load::{See, SupervisorSlot};
use afp_core::rt::{Args, BadValue, Outputs};
use afp_core::{Duration, Events, Fault, Instant, OnReturn};
use afp_session::Simulated;
use pyo3::prelude::*;
use pyo3::types::PySet;

use super::PyHandle;
use super::call::PyTemplate;
use crate::callout;

/// The slot of a supervisor in Python.
pub struct PySupervisor {
    template: PyTemplate,
    watching: Option<Watching>,
}

/// A watching supervisor.
struct Watching {
    /// Its method.
    poll: PyHandle,
    supervisor: PyHandle,
    /// The set of wanted events passed to it.
    wanted: PyHandle,
    /// The current content of that set.
    told: Events,
}

impl PySupervisor {
    pub fn new(template: PyTemplate) -> Self {
        PySupervisor { template, watching: None }
    }
}

impl<R: Simulated> SupervisorSlot<R> for PySupervisor {
    fn start(
        &mut self,
        args: &dyn Args,
        see: See<'_>,
        env: &mut R,
        _: Instant,
    ) -> Result<(), BadValue> {
        let template = &self.template;
        let inputs = template.inputs(args, see)?;
        let watching = template.host.call_with_robot(env, &template.caller, |py| {
            let robot = template.host.robot.clone_ref(py);
            let wanted = PySet::empty(py)?;
            let supervisor = template.make(py, (robot, inputs.dict(py)?, &wanted))?;
            let poll = template.host.handles.put(supervisor.getattr("poll")?.unbind());
            let wanted = template.host.handles.put(wanted.into_any().unbind());
            let supervisor = template.host.handles.put(supervisor.unbind());
            Ok(Watching { poll, supervisor, wanted, told: Events::from_bits(0) })
        })?;
        self.watching = Some(watching);
        Ok(())
    }

    fn poll(
        &mut self,
        args: &dyn Args,
        wanted: Events,
        to: &mut dyn Outputs,
        env: &mut R,
        _: Instant,
    ) -> Result<Option<u16>, BadValue> {
        let watching = self.watching.as_mut().ok_or(Fault::INTERNAL)?;
        if watching.told != wanted {
            let template = &self.template;
            let events = (0..).zip(&template.declared()?.outcomes);
            let events = events.filter(|(event, _)| wanted.contains(*event));
            let names: Vec<_> = events.map(|(_, event)| event.name.as_str()).collect();
            template.host.call_with_robot(env, &template.caller, |py| {
                let set = watching.wanted.get(py)?.cast::<PySet>()?.clone();
                set.clear();
                names.iter().try_for_each(|name| set.add(name))
            })?;
            watching.told = wanted;
        }
        self.template.poll(&watching.poll, args, to, env)
    }

    fn resume(&mut self, env: &mut R, _: Instant, away: Duration) -> Result<OnReturn, Fault> {
        let template = &self.template;
        let watching = self.watching.as_ref().ok_or(Fault::INTERNAL)?;
        template.host.call_with_robot(env, &template.caller, |py| {
            let resume = watching.supervisor.get(py)?.getattr("resume")?;
            callout::call(&resume, (away.as_secs_f64(),)).map(drop)
        })?;
        Ok(OnReturn::Continues)
    }

    fn clear(&mut self) {
        self.watching = None;
    }
}
