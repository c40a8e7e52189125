//! One run of a scenario, in virtual time.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::path::Path;

use afp_core::devices::SignalId;
use afp_core::trace::TraceEntryId;
use afp_core::{Duration, EntryId, Instant, StartError};
use afp_dsl::Compiled;
use afp_dsl::scenario::Scenario;
use afp_log::{About, Recorder, SessionLog, WhenFull};
use afp_project::ProjectFile;
use afp_run::{RunError, hashes};
use afp_session::{
    AnyRobot, AnySession, Applied, Build, Go, Holder, Loader, NamedRecord, Observer, Recipe,
    RequestError, RequestId, SampleRef, Sampling, TextFile, View,
};
use afp_toolboxes::project::own_toolbox_texts;

use crate::Recording;
use crate::setting::Setting;
use crate::stimuli;
use crate::verdict::Verdict;
use crate::watch::signals::Signals;
use crate::watch::{Broken, Watch};

/// The time after the end of the plan, in which the robot comes to rest.
const REST: Duration = Duration::from_millis(1000);
/// The interval between checks of claims about the robot, in addition to each step.
const LOOK: Duration = Duration::from_millis(5);

/// Decides whether a scenario passes.
struct Judge<'a> {
    scenario: &'a Scenario,
    watch: Watch<'a>,
    /// Whether new moments have occurred since the last check.
    unreported: &'a Cell<bool>,
    lines: BTreeMap<RequestId, usize>,
    broken: Vec<Broken>,
    /// Whether entries have always held the committed values.
    is_consistent: bool,
    timeline: Vec<(Instant, String)>,
}

/// Runs a scenario to its end; `None` if `go_on` cancels it.
pub(crate) fn run(
    scenario: &Scenario,
    setting: &Setting,
    robot: &dyn Loader,
    log: Option<Recording<'_>>,
    go_on: &mut dyn FnMut() -> bool,
) -> Result<Option<Verdict>, RunError> {
    let mut session = session(scenario, setting, robot)?;
    let lines = stimuli::request(&mut *session, scenario, None, Instant::ZERO)
        .map_err(|(line, why)| cannot_do(scenario, line, &why))?;
    let log = log.map(|to| self::log(to, scenario, setting, &*session, robot.kind()));
    let mut log = log.transpose()?;
    let signals = Signals::new(scenario, session.devices())
        .map_err(|signal| refused(scenario, &format!("the robot has no signal '{signal}'")))?;
    let unreported = Cell::new(false);
    let mut judge = Judge {
        scenario,
        unreported: &unreported,
        watch: Watch::new(scenario, session.names(), signals),
        lines,
        broken: Vec::new(),
        is_consistent: true,
        timeline: Vec::new(),
    };
    let mut until = Instant::from_nanos(scenario.until);
    let went = loop {
        let mut observers: Vec<&mut dyn Observer> = vec![&mut judge];
        observers.extend(log.as_mut().map(|log| log as &mut dyn Observer));
        let mut gate = |_: Instant, _: Instant| match !unreported.get() && go_on() {
            true => Go::On,
            false => Go::Stop,
        };
        let went = session.run(until, &mut gate, &mut observers);
        let went = went.map_err(|error| cannot_start(scenario, error))?;
        if !unreported.take() {
            break went;
        }
        until = until.min(judge.go_on_from_moments(&mut *session)?);
    };
    let (end, trace) = (session.now(), session.trace().get());
    if let Some(mut log) = log {
        // The log gets the time of the stop, and can repeat the run.
        session.stop(&mut [&mut log]);
        log.finish(&*session)?;
    }
    session.end();
    if went == Go::Stop {
        return Ok(None);
    }
    judge.note_not_reached(&*session);
    let Judge { mut watch, broken: refused, timeline, .. } = judge;
    let mut broken = watch.finish(end);
    broken.extend(refused);
    broken.sort_by_key(|broken| broken.at);
    Ok(Some(Verdict {
        broken,
        end,
        ending: watch.ending(),
        panic: None,
        hits: watch.hits,
        activations: watch.activations,
        timeline,
        trace,
    }))
}

/// The session of a scenario's plan on a robot in its world.
fn session(
    scenario: &Scenario,
    setting: &Setting,
    robot: &dyn Loader,
) -> Result<Box<dyn AnySession>, RunError> {
    let world = &setting.world;
    let session = robot.session(&scenario.graph, &*world.world, scenario.seed, &[]);
    let mut session = session.map_err(|why| world.no_session(why))?;
    for (entry, value) in &scenario.set {
        let set = session.write(EntryId(*entry), value.clone());
        set.map_err(|why| refused(scenario, &why.to_string()))?;
    }
    session.set_rest(REST);
    Ok(session)
}

fn cannot_do(scenario: &Scenario, line: usize, why: &RequestError) -> RunError {
    let line = scenario.stimuli.get(line).map_or("", |stimulus| &stimulus.text);
    refused(scenario, &format!("the simulator cannot do '{line}': {why}"))
}

fn log(
    to: Recording<'_>,
    scenario: &Scenario,
    setting: &Setting,
    session: &dyn AnySession,
    robot: &dyn AnyRobot,
) -> Result<SessionLog, RunError> {
    let about = about(scenario, setting, to.compiled, robot);
    let recorder = Recorder::create(to.path, &about, session.owned_names(), WhenFull::Wait)?;
    Ok(SessionLog::new(recorder, session.devices(), setting.world.world.scene(), false))
}

impl Observer for Judge<'_> {
    fn on_record(&mut self, named: &NamedRecord<'_>) {
        self.watch.on_record(named.at, named.record, named.names);
        if let Some(line) = afp_run::line(named.at, named.record, named.names) {
            self.timeline.push((named.at, line));
        }
    }

    fn after_step(&mut self, view: &View<'_>) {
        self.judge_instant(view.now());
        self.compare(view);
    }

    fn sampling(&self) -> Sampling {
        match self.watch.looks_at_robot() {
            true => Sampling::Following(LOOK),
            false => Sampling::Never,
        }
    }

    fn wants(&self, _: Instant, signal: SignalId) -> bool {
        self.watch.signals().wants(signal)
    }

    fn on_sample(&mut self, _: Instant, signal: SignalId, value: SampleRef<'_>) {
        self.watch.on_signal(signal, value);
    }

    fn after_samples(&mut self, at: Instant) {
        self.watch.after_samples();
        self.judge_instant(at);
    }

    fn on_request(&mut self, applied: &Applied<'_>) {
        let line = self.lines.get(&applied.id).and_then(|line| self.scenario.stimuli.get(*line));
        if let (Some(stimulus), Some(why)) = (line, applied.refused) {
            let (text, span) = (stimulus.text.clone(), stimulus.span);
            self.broken.push(Broken { text, span, at: applied.now, why: why.to_string() });
        }
        if let Some(line) = afp_run::event_line(&applied.event()) {
            self.timeline.push((applied.now, line));
        }
    }
}

impl Judge<'_> {
    fn judge_instant(&mut self, at: Instant) {
        self.watch.after_step(at);
        self.unreported.set(self.watch.moments.has_unreported());
    }

    /// Requests the actions that follow new moments, and returns the time limit.
    fn go_on_from_moments(&mut self, session: &mut dyn AnySession) -> Result<Instant, RunError> {
        let mut until = Instant::MAX;
        for (id, moment, at) in self.watch.moments.take() {
            match stimuli::request(session, self.scenario, Some(id), at) {
                Ok(lines) => self.lines.extend(lines),
                Err((line, RequestError::Ended)) => self.note_not_done(line, session.now()),
                Err((line, why)) => return Err(cannot_do(self.scenario, line, &why)),
            }
            until = moment.until.map_or(until, |after| until.min(at + Duration::from_nanos(after)));
        }
        Ok(until)
    }

    /// Notes actions that the run did not reach.
    fn note_not_reached(&mut self, session: &dyn AnySession) {
        let end = session.now();
        for (_, id, _) in session.pending() {
            if let Some(line) = self.lines.get(&id).copied() {
                self.note_not_done(line, end);
            }
        }
    }

    fn note_not_done(&mut self, line: usize, end: Instant) {
        let Some(stimulus) = self.scenario.stimuli.get(line) else { return };
        let (text, span) = (stimulus.text.clone(), stimulus.span);
        let why = format!("this did not happen: the run was over at {:.3} s", end.as_secs_f64());
        self.broken.push(Broken { text, span, at: end, why });
    }

    /// Compares the plan's entries with the commits, which finds an incomplete commit.
    fn compare(&mut self, view: &View<'_>) {
        let entries = &self.scenario.graph.main().entries;
        let held = (0..entries.len() as u16).map(|entry| view.entry(EntryId(entry)));
        let Some((index, held, known)) = self.watch.differs(held).filter(|_| self.is_consistent)
        else {
            return;
        };
        let name = entries.get(index).map_or("", |entry| entry.name.as_str());
        let holder = Holder::Entry(TraceEntryId(index as u32));
        let [held, known] = [held, known].map(|value| holder.named(view.names(), value));
        self.broken.push(Broken {
            text: "(an entry has its last committed value)".to_owned(),
            span: self.scenario.span,
            at: view.now(),
            why: format!("'{name}' is {held}, but its last commit was {known}"),
        });
        self.is_consistent = false;
    }
}

fn refused(scenario: &Scenario, why: &str) -> RunError {
    RunError::usage(format!("'{}': {why}", scenario.name), "change the scenario")
}

fn cannot_start(scenario: &Scenario, error: StartError) -> RunError {
    refused(scenario, &error.to_string())
}

/// The description of the run in the log, as complete as for other runs.
fn about(
    scenario: &Scenario,
    setting: &Setting,
    compiled: &Compiled,
    robot: &dyn AnyRobot,
) -> About {
    let world = &setting.world;
    let texts = compiled.scenario_texts(scenario).into_iter();
    let toolboxes = own_toolbox_texts(compiled, &scenario.graph);
    let recipe = Recipe {
        plan: scenario.graph.main().name.clone(),
        file: scenario.plan_file.clone(),
        texts: texts.map(|(name, text)| TextFile { name, text }).collect(),
        toolboxes: toolboxes.map(text_file).collect(),
        project: project_text(Path::new(&scenario.plan_file)),
        robot: Recipe::SIMULATED.to_owned(),
        world: TextFile { name: world.world.name().to_owned(), text: world.text.clone() },
        start: world.start,
        seed: scenario.seed,
        until: Some(Instant::from_nanos(scenario.until)),
        build: Build::this(),
        ..Recipe::default()
    };
    let mut about = About::new(&recipe);
    let own = [("scenario", scenario.name.clone()), ("clock", "virtual".to_owned())];
    let of_robot = robot.facts().iter().map(|(key, value)| (*key, (*value).to_owned()));
    let more = hashes(&recipe).into_iter().chain(own).chain(of_robot);
    about.facts.extend(more.map(|(key, value)| (key.to_owned(), value)));
    about
}

/// The text of the project file of a plan, which was read before.
fn project_text(plan: &Path) -> String {
    ProjectFile::of_plan(plan).map_or_else(|_| String::new(), |file| file.text)
}

fn text_file((name, text): (&str, &str)) -> TextFile {
    TextFile { name: name.to_owned(), text: text.to_owned() }
}
