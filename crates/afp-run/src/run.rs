//! One run from its options to its summary.

mod armed;
mod driver;
mod gate;
mod hardware;
mod paths;
pub(crate) mod realtime;
mod self_check;

use std::io;
use std::path::Path;
use std::sync::{Mutex, PoisonError};
use std::time::SystemTime;

use afp_core::trace::Names;
use afp_core::{Duration, Ending, Instant};
use afp_log::svg::{self, Picture};
use afp_log::{About, LogError, Recorder, SessionLog, WhenFull, Written};
use afp_project::{ProjectFile, Realtime};
use afp_session::{
    AnyRobot, AnySession, AnyWorld, Build, Counts, Figures, LastResort, Recipe, Requested,
    SessionError, TextFile, Track, Watch,
};

use crate::again::Again;
use crate::beside::DebuggerParts;

use crate::drawn::nothing_to_draw;
use crate::error::{EXIT_OK, EXIT_PLAN_ERROR, RunError};
use crate::hash::hash;
use crate::live;
use crate::options::{OnRobot, RunOptions, TimeKeeper};
use crate::output::write_whole;
use crate::pace::Pace;
use crate::picture::Rasterizer;
use crate::report::{Ran, Report, Requests, RunFigures, Shown, StoppedBy, Summary};
use crate::stderr::warn;
use crate::stop::StopFlag;
use crate::world::{self, BUILT_IN, LoadedWorld};
use crate::{Extras, Program, inputs, requests};

use driver::{AnyObserver, Driven, Driver, watchdog};
use gate::RunGate;
use paths::Paths;

pub use armed::notify;
pub(crate) use hardware::HARDWARE;
pub use hardware::{OpenHardware, run_on_hardware};

/// Opens the session of a run in a world, with a seed and measures.
pub type MakeSession<'a> =
    dyn FnOnce(&dyn AnyWorld, u64, &[&str]) -> Result<Box<dyn AnySession>, SessionError> + 'a;

/// Runs a plan on a simulated robot and returns the exit code.
///
/// # Errors
/// The options are invalid, or the world or an output fails. A fault of the plan is not an error; it
/// has an exit code.
pub fn run(
    program: &Program<'_>,
    robot: &dyn AnyRobot,
    make: Box<MakeSession<'_>>,
    options: &RunOptions,
    extras: Extras<'_>,
) -> Result<u8, RunError> {
    options.check()?;
    if options.robot == OnRobot::Hardware {
        let message = "this program was built without the robot's hardware";
        let help = "'afpc build --hardware' links it, if the robot's project has it";
        return Err(RunError::usage(message, help));
    }
    if options.attach && extras.debugger.is_none() {
        let message = "'--attach' needs a debugger, and this program has none";
        let help = "run the plan with 'afpc run', which has one with the feature 'dap'";
        return Err(RunError::usage(message, help));
    }
    if options.disarmed && !armed::wait(None)? {
        return Ok(EXIT_OK);
    }
    let again = options.again.as_deref().map(Again::read).transpose()?;
    let world = match &again {
        Some(again) => again.world(robot)?,
        None if options.self_check => world::built_in(robot)?,
        None => find_world(program, options, robot)?,
    };
    let recipe = recipe(program, options, &world, again.as_ref())?;
    let measures: Vec<_> = recipe.measures.iter().map(String::as_str).collect();
    let mut session =
        make(&*world.world, recipe.seed, &measures).map_err(|why| world.no_session(why))?;
    if options.self_check {
        inputs::set_all(&mut *session, &options.set)?;
        return self_check::check(&mut *session);
    }
    match &again {
        Some(again) => requests::repeat(&mut *session, &again.recipe)?,
        None => {
            inputs::set_all(&mut *session, &options.set)?;
            requests::make(&mut *session, &options.press, &options.fail)?;
        }
    }
    let (facts, world, again) = (robot.facts(), &world, again.as_ref());
    let setting = Setting { program, options, recipe, world, facts, again, extras };
    drive(&mut *session, Guards::default(), &setting)
}

/// The world of the options.
fn find_world(
    program: &Program<'_>,
    options: &RunOptions,
    robot: &dyn AnyRobot,
) -> Result<LoadedWorld, RunError> {
    let asked = options.world.as_deref();
    let mut world = world::find(asked, Path::new(program.file), robot)?;
    let usual = world.world.drawing().start;
    inputs::change_world(&mut world, &options.set, robot)?;
    if let Some(start) = options.start {
        let refused = |why| RunError::usage(format!("'--start': {why}"), "choose another start");
        world = world.started_at(start).map_err(refused)?;
    }
    world.warning(usual).into_iter().for_each(warn);
    Ok(world)
}

/// The recipe that repeats the run, without requests from outside.
fn recipe(
    program: &Program<'_>,
    options: &RunOptions,
    world: &LoadedWorld,
    again: Option<&Again>,
) -> Result<Recipe, RunError> {
    let mut measures = measures(program, options)?;
    let build = Build::this();
    let (texts, toolboxes) = program.text_files();
    let (plan, file) = (program.name.to_owned(), program.file.to_owned());
    let project = program.project.to_owned();
    let end = Some(options.end()).filter(|end| *end < Instant::MAX);
    if let Some(Again { recipe, .. }) = again {
        measures.extend(recipe.measures.iter().cloned());
        let until = options.until.map(|until| Instant::ZERO + until).or(recipe.until);
        let recipe = recipe.clone();
        let recipe = Recipe { plan, file, texts, toolboxes, project, ..recipe };
        return Ok(Recipe { measures, until, build, ..recipe });
    }
    Ok(Recipe {
        plan,
        file,
        texts,
        toolboxes,
        project,
        robot: Recipe::SIMULATED.to_owned(),
        world: TextFile { name: world.world.name().to_owned(), text: world.text.clone() },
        start: world.start,
        seed: options.seed,
        measures,
        settings: options.set.clone(),
        until: end,
        requests: Vec::new(),
        build,
    })
}

fn measures(program: &Program<'_>, options: &RunOptions) -> Result<Vec<String>, RunError> {
    let mut all = ProjectFile::of_plan(Path::new(program.file))?.project.measures;
    all.extend(options.measure.iter().cloned());
    all.sort_unstable();
    all.dedup();
    Ok(all)
}

const STANDARD_OUTPUT: &str = "standard output";

struct Setting<'a> {
    program: &'a Program<'a>,
    options: &'a RunOptions,
    recipe: Recipe,
    world: &'a LoadedWorld,
    /// The run that is repeated.
    again: Option<&'a Again>,
    /// The robot's metadata in the log.
    facts: &'static [(&'static str, &'static str)],
    extras: Extras<'a>,
}

fn log_of(
    path: &Path,
    session: &dyn AnySession,
    setting: &Setting<'_>,
) -> Result<SessionLog, RunError> {
    let Setting { options, world, .. } = *setting;
    let (devices, scene) = (session.devices(), world.world.scene());
    let names = session.owned_names();
    let recorder = Recorder::create(path, &about(setting), names, WhenFull::Wait)?;
    if let Some(kept) = recorder.kept() {
        let kept = kept.display();
        warn(&format!(
            "an earlier run of this log was killed: 'afpc log {kept} recover' saves its intact data"
        ));
    }
    let log = SessionLog::new(recorder, devices, scene, options.camera);
    Ok(if options.robot == OnRobot::Hardware { log.in_real_time() } else { log })
}

/// The scheduling of a real robot's control loop, and the guards that stop the robot if the session
/// cannot.
#[derive(Default)]
struct Guards {
    last_resort: Option<LastResort>,
    /// The watch of the session, and how late the session may be.
    watch: Option<(Watch, Duration)>,
    realtime: Realtime,
}

/// Drives a session to its end and returns the outcome.
fn drive(
    session: &mut dyn AnySession,
    guards: Guards,
    setting: &Setting<'_>,
) -> Result<u8, RunError> {
    let Setting { program, options, world, extras, .. } = *setting;
    let end = setting.recipe.until.unwrap_or(Instant::MAX);
    let paths = Paths::new(program, options, world.path.as_deref())?;
    let raster = paths.raster(extras.rasterizer)?;
    let keeper = options.time_keeper();
    let stop = stop_flag(keeper).map_err(RunError::file("cannot handle", "signals".as_ref()))?;
    stop.set_last_resort(guards.last_resort);
    let mut log = paths.log.as_deref().map(|path| log_of(path, session, setting)).transpose()?;
    let report = new_report(setting, end)?;
    let mut counts = Counts::new(session.names());
    let mut track = track(&paths, session);
    let live = options.live.map(|at| live::begin(at, program.name, session)).transpose()?;
    let mut sent = None;
    if let Some(live) = &live {
        let recorder = Recorder::stream(live.messages(), session.owned_names())?;
        let (devices, scene) = (session.devices(), world.world.scene());
        sent = Some(SessionLog::new(recorder, devices, scene, options.camera));
    }
    let pace = Pace::new(keeper).map_err(RunError::file("cannot watch", "the keys".as_ref()))?;
    let debugger = extras.debugger.filter(|_| keeper != TimeKeeper::Nobody);
    let debugger = debugger.map(|beside| beside.start(session)).transpose()?;
    let parts = debugger.map_or_else(DebuggerParts::default, Into::into);
    let DebuggerParts { mut relay, control: debugger, end_service } = parts;
    let asked = debugger.as_ref().map(|(_, steering)| steering.asked());
    let mut gate = RunGate::new(&report, pace, stop.clone(), live.as_deref(), asked);
    let mut requests = Requests::default();
    let mut shown = Shown(&report);
    let mut observers: Vec<&mut AnyObserver<'_>> =
        vec![&mut counts, &mut track, &mut requests, &mut shown];
    let logs = log.iter_mut().chain(&mut sent);
    observers.extend(logs.map(|log| log as &mut AnyObserver<'_>));
    observers.extend(relay.iter_mut().map(|relay| &mut **relay as &mut AnyObserver<'_>));
    let names = session.owned_names();
    let Guards { watch, realtime, .. } = guards;
    let watchdog = watch.map(|watch| watchdog(watch, realtime, stop.clone(), names));
    let driver = Driver { watchdog, realtime, keeper, end, live: live.as_deref(), debugger };
    armed::notify("READY=1");
    // The robot stops before anything slow is written.
    let driven = driver.drive(session, &mut gate, &mut observers);
    stop.set_last_resort(None);
    drop(relay);
    end_service.into_iter().for_each(|end| end());
    let Driven { stopped_by, measured, lost } = driven?;
    let speed = session.now().as_secs_f64() / gate.spent();
    drop(gate);
    let written = log.map(|log| log.finish(session)).transpose();
    sent.map(|sent| sent.finish(session)).transpose()?;
    drop(live);
    let requests = requests.finish(session);
    let asked = requests.len();
    let came = Came { stopped_by, speed, measured, lost, written, counts, track, requests, raster };
    let code = came.finish(
        session,
        report.into_inner().unwrap_or_else(PoisonError::into_inner),
        &paths,
        setting,
    )?;
    let until = setting.recipe.until;
    // A run that was stopped has no trace to compare.
    let again = setting.again.filter(|_| stopped_by != Some(StoppedBy::Signal));
    again.map_or(Ok(()), |again| again.compare(program, until, asked, session.trace()))?;
    Ok(stop.exit_code().filter(|_| stopped_by.is_some()).unwrap_or(code))
}

/// The report of a run, with its head.
///
/// # Errors
/// Standard output cannot be written.
fn new_report(setting: &Setting<'_>, end: Instant) -> Result<Mutex<Report>, RunError> {
    let report = Report::new(setting.options.json, end, setting.options.time_keeper());
    let mut report = report.map_err(RunError::file("cannot write to", STANDARD_OUTPUT.as_ref()))?;
    report.head(&head(setting));
    Ok(Mutex::new(report))
}

/// Only the picture needs the path. Without it, a run of days takes no more memory than a short run.
fn track(paths: &Paths, session: &dyn AnySession) -> Track {
    let track = if paths.svg.is_some() { Track::new } else { Track::distance_alone };
    track(session.devices())
}

/// The flag that signals raise. With a real robot no signal suspends the process. If keys are read,
/// the terminal is restored before the process is suspended.
fn stop_flag(keeper: TimeKeeper) -> io::Result<StopFlag> {
    let stop = StopFlag::on_signals()?;
    match keeper {
        TimeKeeper::Robot => stop.stay_awake()?,
        TimeKeeper::Gate(_) => stop.lend_terminal()?,
        TimeKeeper::Nobody => {}
    }
    Ok(stop)
}

/// The outcome of a run.
struct Came<'a> {
    stopped_by: Option<StoppedBy>,
    speed: f64,
    measured: Figures,
    /// The number of items that a full queue lost before the observers.
    lost: u64,
    written: Result<Option<Written>, LogError>,
    counts: Counts,
    track: Track,
    requests: Vec<Requested>,
    /// Converts an SVG to the bytes of another picture format.
    raster: Option<Rasterizer<'a>>,
}

impl Came<'_> {
    /// Draws the picture and prints the summary, also if the log or the picture cannot be written.
    fn finish(
        self,
        session: &mut dyn AnySession,
        report: Report,
        paths: &Paths,
        setting: &Setting<'_>,
    ) -> Result<u8, RunError> {
        let Came { stopped_by, speed, measured, lost, written, .. } = self;
        let Came { counts, track, requests, raster, .. } = self;
        let ran = Ran {
            plan: setting.program.name,
            world: setting.world.world.name(),
            seed: setting.recipe.seed,
            stopped_by,
            end: session.now(),
            misses: session.misses(),
            // An incomplete trace has no hash.
            trace: Some(session.trace()).filter(|_| lost == 0),
            distance: track.way(),
            requests,
            times: session.loop_times().filter(|_| setting.options.rt_report),
        };
        let figures = ran.figures(&counts, measured, session.names());
        let svg = paths.svg.as_deref();
        let drawn = svg.map(|path| draw(path, &figures, &track, raster, session.names(), setting));
        let drawn = drawn.unwrap_or(Ok(()));
        let log = written.as_ref().ok().and_then(Option::as_ref);
        let log = log.map(|written| written.path.clone());
        let svg = paths.svg.clone().filter(|_| drawn.is_ok());
        let repeats = setting.again.is_some_and(|again| again.has(session.trace()));
        let told = report.end(&Summary { figures, speed, log, svg, lost, repeats });
        told.map_err(RunError::file("cannot write to", STANDARD_OUTPUT.as_ref()))?;
        written?;
        drawn?;
        match session.ending() {
            Some(Ending::Error(_)) => Ok(EXIT_PLAN_ERROR),
            _ => Ok(EXIT_OK),
        }
    }
}

fn draw(
    path: &Path,
    figures: &RunFigures,
    track: &Track,
    raster: Option<Rasterizer<'_>>,
    names: &dyn Names,
    setting: &Setting<'_>,
) -> Result<(), RunError> {
    let picture = Picture {
        world: &setting.world.world.drawing().ended(&track.things),
        title: figures.plan.clone(),
        subtitle: format!("{}, seed {}", figures.world, figures.seed),
        path: &track.path,
        marks: &track.marks,
        figures: figures.for_picture(),
    };
    if track.path.is_empty() && setting.world.world.scene().is_empty() {
        return Err(nothing_to_draw());
    }
    let svg = svg::draw(&picture, names);
    let bytes = match raster {
        Some(raster) => raster(&svg)?,
        None => svg.into_bytes(),
    };
    write_whole("cannot write the picture", path, bytes)
}

fn head(setting: &Setting<'_>) -> Vec<(&'static str, String)> {
    let Setting { program, options, recipe, world, again, .. } = setting;
    let plan = ("plan", format!("{} ({})", program.name, program.file));
    if options.robot == OnRobot::Hardware {
        return vec![plan, ("robot", "hardware, in real time".to_owned())];
    }
    let file = match &world.path {
        Some(path) => path.display().to_string(),
        None => BUILT_IN.to_owned(),
    };
    let called = match world.world.name() {
        "" => file,
        name => format!("{name} ({file})"),
    };
    let mut head = vec![plan, ("world", called), ("seed", recipe.seed.to_string())];
    head.extend(again.map(|again| ("again", again.path.display().to_string())));
    head
}

/// The run's metadata in the log: enough to repeat it.
fn about(setting: &Setting<'_>) -> About {
    let Setting { options, recipe, facts, .. } = setting;
    let mut about = About::new(recipe);
    let clock = match options.time_keeper() {
        TimeKeeper::Nobody => "virtual",
        TimeKeeper::Gate(_) => "virtual, paced",
        TimeKeeper::Robot => "the robot's",
    };
    let more = hashes(recipe).into_iter().chain([("clock", clock.to_owned())]);
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).ok();
    let since = since.filter(|_| options.robot == OnRobot::Hardware);
    let wall = since.map(|since| ("wall_clock_s", format!("{:.3}", since.as_secs_f64())));
    about.facts.extend(more.chain(wall).map(|(key, value)| (key.to_owned(), value)));
    about.facts.extend(facts.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())));
    about
}

/// The hashes of a run's plan and world, as in its log.
pub fn hashes(recipe: &Recipe) -> [(&'static str, String); 2] {
    [("plan_hash", plan_hash(&recipe.texts)), ("world_hash", hash(&recipe.world.text))]
}

/// The hash of the plan's text. Several files are hashed with their paths.
pub(crate) fn plan_hash(texts: &[TextFile]) -> String {
    match texts {
        [one] => hash(&one.text),
        all => {
            hash(&all.iter().map(|it| format!("{}\0{}\0", it.name, it.text)).collect::<String>())
        }
    }
}
