//! A run that can be driven bit by bit, in the one way in which plans are driven everywhere.
//!
//! Between steps anybody may look and write; what a run does depends only on the times at which that was.

use std::path::{Path, PathBuf};

use afp::load::{Injection, LoadedPlan, PlanNames};
use afp_core::rt::NamedPlan;
use afp_core::trace::{ComponentId, Ending, Kind, Names, TraceEntryId};
use afp_core::{Duration, Environment, Fault, Instant, Value, WriteError};
use afp_dsl::graph::Graph;
use afp_log::{About, NameTable, Recorder, WhenFull};
use afp_run::inputs::missing;
use afp_run::rig::Rig;
use afp_run::world::LoadedWorld;
use afp_sim::Simulation;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

use super::stimuli::Deed;
use super::visitor::Visitor;
use crate::errors::{error, log_error, run_error};
use crate::pause::{Halt, Pause};

/// What a run begins with.
pub struct Setting<'a> {
    pub graph: &'a Graph,
    pub world: &'a LoadedWorld,
    pub seed: u64,
    pub file: &'a Path,
    pub log: Option<&'a Path>,
}

/// A run.
pub struct Session {
    pub rig: Rig<LoadedPlan<Simulation>>,
    pub visitor: Visitor,
    pub stopped_by: Option<&'static str>,
    started: bool,
    obstacles: Vec<String>,
    own_entries: u32,
    log: Option<PathBuf>,
}

impl Session {
    /// A run about to start.
    pub fn new(
        plan: LoadedPlan<Simulation>,
        setting: &Setting<'_>,
        pause: Pause,
    ) -> PyResult<Session> {
        let world = &setting.world.world;
        let sim = Simulation::new(world, setting.seed).map_err(|why| error(why.message))?;
        let mut rig = Rig::new(plan, sim, Duration::ZERO);
        if let Some(path) = setting.log {
            let names = NameTable::new(rig.names());
            let log = Recorder::create(path, &about(setting), names, WhenFull::Wait);
            rig.record(log.map_err(|why| log_error(&why))?, world, false);
        }
        let own_entries = setting.graph.main().entries.len();
        Ok(Session {
            rig,
            visitor: Visitor::new(pause),
            stopped_by: None,
            started: false,
            obstacles: world.obstacles.iter().map(|obstacle| obstacle.name.clone()).collect(),
            own_entries: u32::try_from(own_entries).unwrap_or(u32::MAX),
            log: setting.log.map(Path::to_owned),
        })
    }

    /// Drives the plan to its end or to `until`, where it is stopped if `stop` is set; whether it still runs.
    ///
    /// # Errors
    /// The plan cannot start; what a stimulus or a handler of a signal raised.
    pub fn run(&mut self, until: Instant, stop: bool) -> PyResult<bool> {
        self.drive(until, usize::MAX)?;
        if stop && self.is_running() {
            self.stop("until");
        }
        Ok(self.is_running())
    }

    /// Drives the plan until there are more than `seen` records, or to `until`; whether it still runs.
    ///
    /// # Errors
    /// As [`Session::run`].
    pub fn listen(&mut self, seen: usize, until: Instant) -> PyResult<bool> {
        self.drive(until, seen.saturating_add(1))?;
        Ok(self.is_running())
    }

    fn drive(&mut self, until: Instant, enough: usize) -> PyResult<()> {
        self.start()?;
        self.visitor.enough = enough;
        let Session { rig, visitor, .. } = self;
        if rig.ending().is_none() {
            rig.run(until, visitor).map_err(|why| cannot_start(why, rig.names()))?;
        }
        self.obey()
    }

    /// Makes the plan's next step; whether it still runs.
    ///
    /// # Errors
    /// As [`Session::run`].
    pub fn step(&mut self) -> PyResult<bool> {
        if !self.started {
            self.start()?;
            return self.obey().map(|()| self.is_running());
        }
        self.visitor.enough = usize::MAX;
        while self.is_running() {
            let due = self.rig.due();
            self.rig.tick(Instant::MAX, &mut self.visitor);
            self.obey()?;
            if self.rig.sim.now() >= due {
                break;
            }
        }
        Ok(self.is_running())
    }

    fn start(&mut self) -> PyResult<()> {
        if !self.started {
            let Session { rig, visitor, .. } = self;
            rig.start(visitor).map_err(|why| cannot_start(why, rig.names()))?;
            self.started = true;
        }
        Ok(())
    }

    /// Does what made the run halt.
    fn obey(&mut self) -> PyResult<()> {
        match self.visitor.halt.take() {
            None => {}
            Some(Halt::Asked) if self.is_running() => self.stop("stop"),
            Some(Halt::Aborted) if self.is_running() => self.rig.abort(&mut self.visitor),
            Some(Halt::Asked | Halt::Aborted) => {}
            Some(Halt::Raised(why)) => return Err(why),
        }
        if !self.is_running() {
            self.rig.sim.emergency_stop();
        }
        Ok(())
    }

    fn stop(&mut self, by: &'static str) {
        self.stopped_by = Some(by);
        self.rig.stop(&mut self.visitor);
        self.rig.sim.emergency_stop();
    }

    fn is_running(&self) -> bool {
        self.rig.ending().is_none()
    }

    /// Plans something; what is planned for one instant happens in that order.
    ///
    /// # Errors
    /// The instant is over.
    pub fn plan(&mut self, at: Instant, deed: Deed) -> Result<(), String> {
        let now = self.rig.sim.now();
        if at < now {
            return Err(format!("{} s is over: it is {} s", at.as_secs_f64(), now.as_secs_f64()));
        }
        self.visitor.plan(at, deed);
        Ok(())
    }

    /// An instant to come, or now.
    pub fn moment(&self, at: Option<Instant>) -> PyResult<Instant> {
        match self.is_running() {
            true => Ok(at.unwrap_or(self.rig.sim.now())),
            false => Err(PyRuntimeError::new_err("the plan has ended; nothing happens any more")),
        }
    }

    /// Writes an entry at once before the start, at the next step later.
    ///
    /// # Errors
    /// The value does not fit, or too many writes wait.
    pub fn write(&mut self, entry: u16, value: &Value) -> Result<(), WriteError> {
        match self.started {
            false => NamedPlan::set_input(self.rig.scheduler.plan_mut(), entry, value),
            true => self.rig.scheduler.write(entry, value.clone()),
        }
    }

    /// What lets a component report an outcome.
    pub fn injection(&self, path: &str, outcome: &str) -> PyResult<Injection> {
        let mut ids = (0..self.rig.names().components()).map(ComponentId);
        let component = ids.find(|id| {
            let about = self.rig.names().component(*id);
            about.path == path && matches!(about.kind, Kind::Actor | Kind::Supervisor)
        });
        let component = component.ok_or_else(|| {
            PyValueError::new_err(format!("the plan has no actor or supervisor '{path}'"))
        })?;
        let known = (0..u16::MAX).map(|number| self.rig.names().outcome(component, number));
        let known: Vec<_> = known.take_while(|name| !name.is_empty()).collect();
        let found = (0..).zip(&known).find(|(_, name)| **name == outcome);
        let (outcome, _) = found.ok_or_else(|| {
            let known = known.join(", ");
            PyValueError::new_err(format!("'{path}' has no '{outcome}'; there are: {known}"))
        })?;
        Ok(Injection { component, outcome, outputs: Vec::new() })
    }

    /// An actor or sub-plan by its path.
    pub fn element(&self, path: &str) -> PyResult<ComponentId> {
        let about = |id: &ComponentId| self.rig.names().component(*id);
        let mut ids = (0..self.rig.names().components()).map(ComponentId);
        let found = ids.find(|id| {
            let about = about(id);
            about.path == path && matches!(about.kind, Kind::Actor | Kind::SubPlan)
        });
        found.ok_or_else(|| {
            PyValueError::new_err(format!("the plan has no actor or sub-plan '{path}'"))
        })
    }

    /// The names of the plan's own entries.
    pub fn own_entries(&self) -> Vec<String> {
        let ids = (0..self.own_entries).map(TraceEntryId);
        ids.map(|id| self.rig.names().entry(id).path.to_owned()).collect()
    }

    /// The active element of the outermost plan.
    pub fn active(&self) -> Option<String> {
        let part = self.rig.scheduler.active()?;
        Some(self.rig.names().component(ComponentId(u32::from(part) + 1)).path.to_owned())
    }

    /// How the plan ended.
    pub fn ending(&self) -> &'static str {
        match self.rig.scheduler.ending() {
            None => "running",
            Some(Ending::Ok) => "ok",
            Some(Ending::Interrupted) => "interrupted",
            Some(Ending::Error(_)) => "error",
        }
    }

    /// The fault that ended the plan.
    pub fn fault(&self) -> Option<Fault> {
        match self.rig.scheduler.ending() {
            Some(Ending::Error(fault)) => Some(fault),
            _ => None,
        }
    }

    /// What the robot touched: obstacle, first and last time.
    pub fn collisions(&self) -> Vec<(String, f64, f64)> {
        let truth = self.rig.sim.truth();
        let told = truth.collisions().iter().map(|collision| {
            let name = self.obstacles.get(collision.obstacle).cloned().unwrap_or_default();
            (name, collision.begin.as_secs_f64(), collision.end.as_secs_f64())
        });
        told.collect()
    }

    /// Ends the log; where it is.
    pub fn close(&mut self) -> PyResult<Option<PathBuf>> {
        self.rig.finish_log().map_err(|why| run_error(&why))?;
        Ok(self.log.clone())
    }
}

fn cannot_start(why: afp_core::StartError, names: &PlanNames) -> PyErr {
    run_error(&missing(why, names))
}

/// What the log says of the run.
fn about(setting: &Setting<'_>) -> About {
    let facts = [
        ("plan", setting.graph.main().name.clone()),
        ("plan_file", setting.file.display().to_string()),
        ("robot", "sim".to_owned()),
        ("seed", setting.seed.to_string()),
        ("world", setting.world.world.name.clone()),
        ("clock", "virtual".to_owned()),
        ("afp_version", env!("CARGO_PKG_VERSION").to_owned()),
    ];
    About {
        facts: facts.map(|(key, value)| (key.to_owned(), value)).to_vec(),
        attachments: vec![(
            "world.toml".to_owned(),
            "application/toml",
            setting.world.text.clone(),
        )],
    }
}
