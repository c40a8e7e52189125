//! One run of a scenario, in virtual time.
//!
//! At an instant: physics, then what the scenario lets happen, then the step. Without a log the truth is
//! looked at in the end only, since the simulation keeps its own list of collisions.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use afp::load::{LoadedPlan, PlanNames};
use afp_core::rt::NamedPlan;
use afp_core::trace::{Names, TraceHash};
use afp_core::{Duration, Environment, Fault, Instant, PlanState, Scheduler, StartError, Wake};
use afp_dsl::scenario::Scenario;
use afp_dsl::scenario::devices::Control;
use afp_log::{About, NameTable, Recorder, WhenFull};
use afp_run::{RobotLog, RunError, Tracer};
use afp_sim::Simulation;

use crate::setting::Setting;
use crate::stimuli::{Deed, Stimuli, owned};
use crate::verdict::{Broken, Verdict};
use crate::watch::Watch;

/// How long a run goes on when the plan has ended: the robot comes to rest.
const REST: Duration = Duration::from_millis(1000);
/// How often a log gets the robot's pose.
const SAMPLE: Duration = Duration::from_millis(20);

pub(crate) struct Drive<'a> {
    scenario: &'a Scenario,
    scheduler: Scheduler<LoadedPlan<Simulation>>,
    sim: Simulation,
    names: PlanNames,
    tracer: Tracer,
    robot: Option<RobotLog>,
    watch: Watch<'a>,
    stimuli: Stimuli,
    broken: Vec<Broken>,
    timeline: Vec<(Instant, String)>,
    trace: TraceHash,
}

impl<'a> Drive<'a> {
    pub(crate) fn new(
        scenario: &'a Scenario,
        setting: &Setting,
        mut plan: LoadedPlan<Simulation>,
        log: Option<&Path>,
    ) -> Result<Self, RunError> {
        let world = &setting.world;
        let sim = Simulation::new(&world.world, scenario.seed)
            .map_err(|error| RunError::usage(error.message, "look at the world's file"))?;
        for (entry, value) in &scenario.set {
            let set = NamedPlan::set_input(&mut plan, *entry, &owned(value));
            set.map_err(|why| refused(scenario, &why.to_string()))?;
        }
        let names = plan.names();
        let log = match log {
            Some(path) => {
                let about = about(scenario, setting);
                Some(Recorder::create(path, &about, NameTable::new(&names), WhenFull::Wait)?)
            }
            None => None,
        };
        let stimuli = Stimuli::new(scenario).map_err(|line| {
            let line = scenario.stimuli.get(line).map_or("", |stimulus| &stimulus.text);
            refused(scenario, &format!("the simulator cannot do '{line}'"))
        })?;
        let mut drive = Drive {
            scenario,
            scheduler: Scheduler::new(plan),
            sim,
            watch: Watch::new(scenario, names.entries() as usize),
            names,
            tracer: Tracer::new(log),
            robot: None,
            stimuli,
            broken: Vec::new(),
            timeline: Vec::new(),
            trace: TraceHash::default(),
        };
        drive.robot = drive.tracer.log.as_mut().map(|log| RobotLog::begin(log, &world.world));
        Ok(drive)
    }

    /// Runs the scenario to its end.
    pub(crate) fn run(mut self) -> Result<Verdict, RunError> {
        let clock = self.sim.clock();
        let mut end = Instant::from_nanos(self.scenario.until);
        let mut look = if self.robot.is_some() { Instant::ZERO } else { Instant::MAX };
        let mut wake = self.start()?;
        while self.sim.now() < end {
            let due = match wake {
                Wake::At(due) => due.max(clock.free()),
                Wake::Ended(_) => {
                    end = end.min(self.ended_at() + REST);
                    Instant::MAX
                }
            };
            self.sim.advance_to(due.min(self.stimuli.next()).min(look).min(end));
            let now = self.sim.now();
            if now == look {
                self.look();
                look = look + SAMPLE;
            }
            self.stimulate(now);
            if due <= now {
                wake = self.step(now);
            }
        }
        self.sim.emergency_stop();
        let mut broken = self.watch.finish(end, self.sim.truth().collisions());
        broken.append(&mut self.broken);
        broken.sort_by_key(|broken| broken.at);
        if let Some(log) = self.tracer.log.take() {
            log.finish()?;
        }
        Ok(Verdict {
            broken,
            end,
            ending: self.watch.ending(),
            hits: self.watch.hits,
            activations: self.watch.activations,
            timeline: self.timeline,
            trace: self.trace.get(),
        })
    }

    fn ended_at(&self) -> Instant {
        self.watch.hits.ended.map_or(Instant::ZERO, Instant::from_nanos)
    }

    fn start(&mut self) -> Result<Wake, RunError> {
        let clock = self.sim.clock();
        let Drive { scheduler, sim, tracer, .. } = self;
        let start = AssertUnwindSafe(|| scheduler.start(sim, tracer, &clock, Instant::ZERO));
        let wake = match catch_unwind(start) {
            Ok(wake) => wake.map_err(|error| cannot_start(self.scenario, error))?,
            Err(_) => self.panicked(),
        };
        let own = self.scenario.graph.main().entries.len() as u16;
        let plan = self.scheduler.plan();
        self.tracer.started(Instant::ZERO, (0..own).map(|entry| plan.entry(entry).to_owned()));
        self.tell(Instant::ZERO);
        Ok(wake)
    }

    fn step(&mut self, now: Instant) -> Wake {
        let clock = self.sim.clock();
        let Drive { scheduler, sim, tracer, .. } = self;
        let step = AssertUnwindSafe(|| scheduler.step(sim, tracer, &clock, now));
        let wake = match catch_unwind(step) {
            Ok(wake) => wake,
            Err(_) => self.panicked(),
        };
        if !self.tracer.news.is_empty() {
            self.tell(now);
        }
        wake
    }

    /// A component panicked: nothing of the plan can be trusted any more.
    fn panicked(&mut self) -> Wake {
        self.scheduler.abort(&mut self.sim, &mut self.tracer, Fault::PANIC)
    }

    fn tell(&mut self, now: Instant) {
        for owned in self.tracer.news.drain(..) {
            let (at, record) = (owned.at, owned.get());
            self.watch.hear(at, &record);
            self.trace.record(at, &record, &self.names);
            if let Some(line) = afp_run::line(at, &record, &self.names) {
                self.timeline.push((at, line));
            }
        }
        self.watch.settle(now);
    }

    fn look(&mut self) {
        if let (Some(robot), Some(log)) = (&mut self.robot, &mut self.tracer.log) {
            robot.look(log, &self.sim);
        }
    }

    fn stimulate(&mut self, now: Instant) {
        while let Some((line, deed)) = self.stimuli.take_due(now) {
            let done = match deed {
                Deed::Set(entry, value) => {
                    self.scheduler.write(entry, value).map_err(|why| why.to_string())
                }
                Deed::Hold(control, down) => {
                    self.hold(control, down);
                    Ok(())
                }
                Deed::Break(fault, time) => {
                    self.sim.inject(fault, now, time);
                    Ok(())
                }
                Deed::Inject(injection) => {
                    let active = self.scheduler.active();
                    let injected = self.scheduler.plan_mut().inject(active, &injection);
                    injected.map_err(|_| {
                        let path = self.names.component(injection.component).path;
                        format!("'{path}' is not active")
                    })
                }
            };
            if let (Err(why), Some(stimulus)) = (done, self.scenario.stimuli.get(line)) {
                let (text, span) = (stimulus.text.clone(), stimulus.span);
                self.broken.push(Broken { text, span, at: now, why });
            }
        }
    }

    fn hold(&mut self, control: Control, down: bool) {
        match (control, down) {
            (Control::Escape, true) => self.sim.press_escape(),
            (Control::Escape, false) => self.sim.release_escape(),
            (Control::Touch, true) => self.sim.press_bumper(),
            (Control::Touch, false) => self.sim.release_bumper(),
        }
    }
}

fn refused(scenario: &Scenario, why: &str) -> RunError {
    RunError::usage(format!("'{}': {why}", scenario.name), "change the scenario")
}

fn cannot_start(scenario: &Scenario, error: StartError) -> RunError {
    refused(scenario, &error.to_string())
}

/// What the log says of the run.
fn about(scenario: &Scenario, setting: &Setting) -> About {
    let world = &setting.world;
    let facts = [
        ("plan", scenario.graph.main().name.clone()),
        ("plan_file", scenario.plan_file.clone()),
        ("scenario", scenario.name.clone()),
        ("robot", "sim".to_owned()),
        ("seed", scenario.seed.to_string()),
        ("world", world.world.name.clone()),
        ("until_ns", scenario.until.to_string()),
        ("clock", "virtual".to_owned()),
        ("afp_version", env!("CARGO_PKG_VERSION").to_owned()),
    ];
    About {
        facts: facts.map(|(key, value)| (key.to_owned(), value)).to_vec(),
        attachments: vec![("world.toml".to_owned(), "application/toml", world.text.clone())],
    }
}
