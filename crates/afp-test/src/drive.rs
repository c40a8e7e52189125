//! One run of a scenario, in virtual time.
//!
//! Without a log, and unless claims are about the robot, the truth is looked at in the end only, since
//! the simulation keeps its own list of collisions.

use std::path::Path;

use afp::load::{LoadedPlan, PlanNames};
use afp_core::rt::NamedPlan;
use afp_core::trace::{Names, Record};
use afp_core::{Duration, Environment, Instant, PlanState, StartError};
use afp_dsl::scenario::Scenario;
use afp_dsl::scenario::devices::Control;
use afp_log::{About, NameTable, Recorder, WhenFull};
use afp_run::RunError;
use afp_run::rig::{Company, Go, Rig};
use afp_sim::{Simulation, Truth};

use crate::setting::Setting;
use crate::stimuli::{Deed, Stimuli, owned};
use crate::verdict::{Broken, Verdict};
use crate::watch::Watch;

/// How long a run goes on when the plan has ended: the robot comes to rest.
const REST: Duration = Duration::from_millis(1000);

type Loaded = LoadedPlan<Simulation>;

/// Everybody who attends the run of a scenario.
struct Attendants<'a> {
    scenario: &'a Scenario,
    watch: Watch<'a>,
    stimuli: Stimuli,
    broken: Vec<Broken>,
    /// Whether entries have always held what was committed.
    sound: bool,
    timeline: Vec<(Instant, String)>,
    go_on: &'a mut dyn FnMut() -> bool,
}

/// Runs a scenario to its end; `None` when `go_on` called it off.
pub(crate) fn run(
    scenario: &Scenario,
    setting: &Setting,
    plan: Loaded,
    log: Option<&Path>,
    go_on: &mut dyn FnMut() -> bool,
) -> Result<Option<Verdict>, RunError> {
    let mut rig = rig(scenario, setting, plan, log)?;
    let stimuli = Stimuli::new(scenario).map_err(|line| {
        let line = scenario.stimuli.get(line).map_or("", |stimulus| &stimulus.text);
        refused(scenario, &format!("the simulator cannot do '{line}'"))
    })?;
    let mut attendants = Attendants {
        scenario,
        watch: Watch::new(scenario, rig.names().entries() as usize),
        stimuli,
        broken: Vec::new(),
        sound: true,
        timeline: Vec::new(),
        go_on,
    };
    let until = Instant::from_nanos(scenario.until);
    let went = rig.run(until, &mut attendants).map_err(|error| cannot_start(scenario, error))?;
    rig.sim.emergency_stop();
    rig.finish_log()?;
    if went == Go::Stop {
        return Ok(None);
    }
    let end = rig.sim.now();
    let Attendants { mut watch, broken: refused, timeline, .. } = attendants;
    let mut broken = watch.finish(end, rig.sim.truth().collisions());
    broken.extend(refused);
    broken.sort_by_key(|broken| broken.at);
    Ok(Some(Verdict {
        broken,
        end,
        ending: watch.ending(),
        hits: watch.hits,
        activations: watch.activations,
        timeline,
        trace: rig.trace().get(),
    }))
}

/// The plan of a scenario on a robot in its world.
fn rig(
    scenario: &Scenario,
    setting: &Setting,
    mut plan: Loaded,
    log: Option<&Path>,
) -> Result<Rig<Loaded>, RunError> {
    let world = &setting.world.world;
    let sim = Simulation::new(world, scenario.seed)
        .map_err(|error| RunError::usage(error.message, "look at the world's file"))?;
    for (entry, value) in &scenario.set {
        let set = NamedPlan::set_input(&mut plan, *entry, &owned(value));
        set.map_err(|why| refused(scenario, &why.to_string()))?;
    }
    let mut rig = Rig::new(plan, sim, REST);
    if let Some(path) = log {
        let (about, names) = (about(scenario, setting), NameTable::new(rig.names()));
        rig.record(Recorder::create(path, &about, names, WhenFull::Wait)?, world, false);
    }
    Ok(rig)
}

impl Company<Loaded> for Attendants<'_> {
    fn wait(&mut self, _: Instant, _: Instant) -> Go {
        match (self.go_on)() {
            true => Go::On,
            false => Go::Stop,
        }
    }

    fn next(&self) -> Instant {
        self.stimuli.next()
    }

    fn happen(&mut self, rig: &mut Rig<Loaded>, now: Instant) {
        while let Some((line, deed)) = self.stimuli.take_due(now) {
            if let (Err(why), Some(stimulus)) =
                (act(deed, rig, now), self.scenario.stimuli.get(line))
            {
                let (text, span) = (stimulus.text.clone(), stimulus.span);
                self.broken.push(Broken { text, span, at: now, why });
            }
        }
    }

    fn hear(&mut self, at: Instant, record: &Record<'_>, names: &PlanNames, _: &Truth<'_>) {
        self.watch.hear(at, record);
        if let Some(line) = afp_run::line(at, record, names) {
            self.timeline.push((at, line));
        }
    }

    fn settle(&mut self, rig: &Rig<Loaded>, now: Instant) {
        self.watch.settle(now, &rig.sim.truth());
        self.compare(rig, now);
    }

    fn follows(&self) -> bool {
        self.watch.looks_at_robot()
    }
}

impl Attendants<'_> {
    /// Whatever the plan holds has been committed: half a commit would be seen here.
    fn compare(&mut self, rig: &Rig<Loaded>, now: Instant) {
        let plan = rig.scheduler.plan();
        let entries = &self.scenario.graph.main().entries;
        let held = (0..entries.len() as u16).map(|entry| plan.entry(entry));
        let Some((place, held, known)) = self.watch.differs(held).filter(|_| self.sound) else {
            return;
        };
        let name = entries.get(place).map_or("", |entry| entry.name.as_str());
        self.broken.push(Broken {
            text: "(entries hold what was committed)".to_owned(),
            span: self.scenario.span,
            at: now,
            why: format!("'{name}' holds {held}, its last commit was {known}"),
        });
        self.sound = false;
    }
}

/// Does what a scenario lets happen.
fn act(deed: Deed, rig: &mut Rig<Loaded>, now: Instant) -> Result<(), String> {
    match deed {
        Deed::Set(entry, value) => {
            return rig.scheduler.write(entry, value).map_err(|why| why.to_string());
        }
        Deed::Hold(Control::Escape, true) => rig.sim.press_escape(),
        Deed::Hold(Control::Escape, false) => rig.sim.release_escape(),
        Deed::Hold(Control::Touch, true) => rig.sim.press_bumper(),
        Deed::Hold(Control::Touch, false) => rig.sim.release_bumper(),
        Deed::Break(fault, time) => rig.sim.inject(fault, now, time),
        Deed::Idle(element) => {
            if !rig.scheduler.plan_mut().idle(element) {
                return Err("there is no such actor".to_owned());
            }
        }
        Deed::Inject(injection) => {
            let active = rig.scheduler.active();
            let injected = rig.scheduler.plan_mut().inject(active, &injection);
            return injected.map_err(|_| {
                let path = rig.names().component(injection.component).path;
                format!("'{path}' is not active")
            });
        }
    }
    Ok(())
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
