//! What accompanies a run: it keeps what happens, lets happen what was asked for, and looks at signals.

use std::collections::BTreeMap;

use afp::load::{LoadedPlan, PlanNames};
use afp_core::Instant;
use afp_core::trace::{Names, Record};
use afp_log::OwnedRecord;
use afp_run::rig::{Company, Go, Rig};
use afp_sim::{Simulation, Truth};
use pyo3::PyErr;

use super::stimuli::{Control, Deed};
use crate::errors::error;
use crate::pause::{Halt, Pause};

/// The company of a run.
pub struct Visitor {
    /// What happened, without polls that saw nothing.
    pub records: Vec<OwnedRecord>,
    /// Time, x, y, heading.
    pub path: Vec<[f64; 4]>,
    /// Why the run does not go on.
    pub halt: Option<Halt>,
    /// With how many records the run is to halt.
    pub enough: usize,
    pause: Pause,
    deeds: BTreeMap<(Instant, usize), Deed>,
    deeds_so_far: usize,
}

impl Visitor {
    /// Nothing has happened yet.
    pub fn new(pause: Pause) -> Visitor {
        Visitor {
            records: Vec::new(),
            path: Vec::new(),
            halt: None,
            enough: usize::MAX,
            pause,
            deeds: BTreeMap::new(),
            deeds_so_far: 0,
        }
    }

    /// Plans something; what is planned for one instant happens in that order.
    pub fn plan(&mut self, at: Instant, deed: Deed) {
        self.deeds.insert((at, self.deeds_so_far), deed);
        self.deeds_so_far += 1;
    }
}

impl Company<LoadedPlan<Simulation>> for Visitor {
    fn wait(&mut self, _: Instant, _: Instant) -> Go {
        if self.halt.is_none() {
            self.halt = self.pause.look();
        }
        match self.halt.is_some() || self.records.len() >= self.enough {
            true => Go::Stop,
            false => Go::On,
        }
    }

    fn next(&self) -> Instant {
        self.deeds.keys().next().map_or(Instant::MAX, |(at, _)| *at)
    }

    fn happen(&mut self, rig: &mut Rig<LoadedPlan<Simulation>>, now: Instant) {
        while let Some(first) = self.deeds.first_entry().filter(|first| first.key().0 <= now) {
            if let Err(why) = happen(rig, now, first.remove()) {
                self.halt = Some(Halt::Raised(why));
            }
        }
    }

    fn hear(&mut self, at: Instant, record: &Record<'_>, _: &PlanNames, _: &Truth<'_>) {
        self.records.push(OwnedRecord::new(at, record));
    }

    fn looks(&self) -> bool {
        true
    }

    fn look(&mut self, now: Instant, truth: &Truth<'_>) {
        let pose = truth.pose();
        self.path.push([now.as_secs_f64(), pose.x, pose.y, pose.heading]);
    }
}

/// Lets something happen.
fn happen(rig: &mut Rig<LoadedPlan<Simulation>>, now: Instant, deed: Deed) -> Result<(), PyErr> {
    let time = now.as_secs_f64();
    let sim = &mut rig.sim;
    match deed {
        Deed::Write(entry, value) => {
            let written = rig.scheduler.write(entry, value);
            written.map_err(|why| error(format!("at {time} s: {why}")))?;
        }
        Deed::Hold(Control::Escape, true) => sim.press_escape(),
        Deed::Hold(Control::Escape, false) => sim.release_escape(),
        Deed::Hold(Control::Bumper, true) => sim.press_bumper(),
        Deed::Hold(Control::Bumper, false) => sim.release_bumper(),
        Deed::Break(fault, lasting) => sim.inject(fault, now, lasting),
        Deed::Idle(element) => {
            rig.scheduler.plan_mut().idle(element);
        }
        Deed::Inject(injection) => {
            let active = rig.scheduler.active();
            let done = rig.scheduler.plan_mut().inject(active, &injection);
            let path = || rig.names().component(injection.component).path.to_owned();
            done.map_err(|_| error(format!("at {time} s: '{}' is not active", path())))?;
        }
    }
    Ok(())
}
