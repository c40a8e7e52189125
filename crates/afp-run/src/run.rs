//! One run from its options to its summary.

mod gate;
mod paths;

use std::cell::RefCell;
use std::path::{Path, PathBuf};

use afp_core::{Ending, Instant, StartError};
use afp_log::{About, NameTable, SessionLog, Written};
use afp_project::ProjectFile;
use afp_session::{AnyRobot, AnySession, AnyWorld, Counts, Go, Observer, SessionError, Track};

use crate::error::{EXIT_OK, EXIT_PLAN_ERROR, RunError};
use crate::hash::hash;
use crate::options::{RunOptions, Speed};
use crate::output::write_whole;
use crate::pace::Pace;
use crate::picture::Rasterizer;
use crate::report::{Ran, Report, Shown, StoppedBy, Summary};
use crate::stop::StopFlag;
use crate::svg::{self, Picture};
use crate::world::{self, LoadedWorld};
use crate::{Program, inputs, requests};

use gate::RunGate;
use paths::Paths;

/// Makes the session of a run: in a world, with a seed, judged by some measures.
pub type MakeSession<'a> =
    dyn FnOnce(&dyn AnyWorld, u64, &[&str]) -> Result<Box<dyn AnySession>, SessionError> + 'a;

/// Runs a plan on a simulated robot; gives the exit code. A `rasterizer` makes PNG pictures; without one they are SVG
/// alone.
///
/// # Errors
/// Wrong options, a world or an output that does not work. What a plan does wrong is no error but
/// an exit code.
pub fn run(
    program: &Program<'_>,
    robot: &dyn AnyRobot,
    make: Box<MakeSession<'_>>,
    options: &RunOptions,
    rasterizer: Option<Rasterizer<'_>>,
) -> Result<u8, RunError> {
    options.check()?;
    let mut world = world::find(options.world.as_deref(), Path::new(program.file), robot)?;
    inputs::change_world(&mut world, &options.set, robot)?;
    let measures = measures(program, options)?;
    let measures: Vec<_> = measures.iter().map(String::as_str).collect();
    let mut session = make(&*world.world, options.seed, &measures).map_err(|why| match why {
        SessionError::World(message) => RunError::Content {
            path: world.path.clone().unwrap_or_default(),
            span: None,
            text: world.text.clone(),
            message,
        },
        other => other.into(),
    })?;
    inputs::set_all(&mut *session, &options.set)?;
    let facts = robot.facts();
    drive(&mut *session, &Setting { program, options, world: &world, facts, rasterizer })
}

/// The measures that the project asks for, and the options.
fn measures(program: &Program<'_>, options: &RunOptions) -> Result<Vec<String>, RunError> {
    let mut all = ProjectFile::of_plan(Path::new(program.file))?.project.measures;
    all.extend(options.measure.iter().cloned());
    all.sort_unstable();
    all.dedup();
    Ok(all)
}

/// What was asked for.
struct Setting<'a> {
    program: &'a Program<'a>,
    options: &'a RunOptions,
    world: &'a LoadedWorld,
    /// What the log says of the robot.
    facts: &'static [(&'static str, &'static str)],
    rasterizer: Option<Rasterizer<'a>>,
}

/// Drives a session to its end and says what it came to.
fn drive(session: &mut dyn AnySession, setting: &Setting<'_>) -> Result<u8, RunError> {
    let Setting { program, options, world, rasterizer, .. } = *setting;
    requests::make(session, &options.press, &options.fail)?;
    let paths = Paths::new(program, options)?;
    let raster = paths.raster(rasterizer)?;
    let mut log = match &paths.log {
        None => None,
        Some(path) => {
            let (about, names) = (about(setting), NameTable::new(session.names()));
            let (devices, scene) = (session.devices(), world.world.scene());
            Some(SessionLog::create(path, &about, names, devices, scene, options.camera)?)
        }
    };
    let stop =
        StopFlag::on_signals().map_err(RunError::file("cannot handle", "signals".as_ref()))?;
    let report = RefCell::new(Report::new(options.json, options.end()));
    report.borrow_mut().head(&head(setting));
    let mut counts = Counts::new(session.names());
    let mut track = Track::new(session.devices());
    let mut gate = RunGate::new(&report, Pace::new(options.speed), stop);
    let mut shown = Shown(&report);
    let mut observers: Vec<&mut dyn Observer> = vec![&mut counts, &mut track, &mut shown];
    observers.extend(log.as_mut().map(|log| log as &mut dyn Observer));
    let stopped_by = run_to_end(session, options.end(), &mut gate, &mut observers)
        .map_err(|error| inputs::missing(error, session.names()))?;
    let speed = session.now().as_secs_f64() / gate.spent();
    drop(gate);
    let written = log.map(SessionLog::finish).transpose()?;
    let came = Came { stopped_by, speed, written, counts, track, raster };
    came.finish(session, report.into_inner(), &paths, setting)
}

/// Runs the plan to its end, or until it is stopped.
fn run_to_end(
    session: &mut dyn AnySession,
    end: Instant,
    gate: &mut RunGate<'_>,
    observers: &mut [&mut dyn Observer],
) -> Result<Option<StoppedBy>, StartError> {
    loop {
        let went = session.run(end, gate, observers)?;
        if let Some(at) = gate.take_escape() {
            requests::press_stop(session, at);
            continue;
        }
        let stopped_by = match (went, session.ending()) {
            (_, Some(_)) => return Ok(None),
            (Go::Stop, None) => StoppedBy::Signal,
            (_, None) => StoppedBy::Until,
        };
        session.stop(observers);
        return Ok(Some(stopped_by));
    }
}

/// How a run came out.
struct Came<'a> {
    stopped_by: Option<StoppedBy>,
    speed: f64,
    written: Option<Written>,
    counts: Counts,
    track: Track,
    /// What makes the picture's bytes of an SVG that is not to be one.
    raster: Option<Rasterizer<'a>>,
}

impl Came<'_> {
    /// Draws the picture, prints the summary.
    fn finish(
        self,
        session: &mut dyn AnySession,
        report: Report,
        paths: &Paths,
        setting: &Setting<'_>,
    ) -> Result<u8, RunError> {
        let Came { stopped_by, speed, written, counts, track, raster } = self;
        let measured = session.end();
        let ran = Ran {
            plan: setting.program.name,
            world: setting.world.world.name(),
            seed: setting.options.seed,
            stopped_by,
            end: session.now(),
            misses: session.misses(),
            trace: session.trace(),
            distance: track.distance,
        };
        let figures = ran.figures(&counts, measured, session.names());
        if let Some(path) = &paths.svg {
            let picture = Picture {
                world: &setting.world.world.drawing(),
                title: figures.plan.clone(),
                subtitle: format!("{}, seed {}", figures.world, figures.seed),
                path: &track.path,
                marks: &track.marks,
                figures: figures.for_picture(),
            };
            let svg = svg::draw(&picture, session.names());
            let bytes = match raster {
                Some(raster) => raster(&svg)?,
                None => svg.into_bytes(),
            };
            write_whole("cannot write the picture", path, bytes)?;
        }
        let lost = written.as_ref().map_or(0, |written: &Written| written.lost);
        let log: Option<PathBuf> = written.map(|written| written.path);
        let summary = Summary { figures, speed, log, svg: paths.svg.clone(), lost };
        let told = report.end(&summary);
        told.map_err(RunError::file("cannot write to", "standard output".as_ref()))?;
        match session.ending() {
            Some(Ending::Error(_)) => Ok(EXIT_PLAN_ERROR),
            _ => Ok(EXIT_OK),
        }
    }
}

fn head(setting: &Setting<'_>) -> [(&'static str, String); 3] {
    let Setting { program, options, world, .. } = setting;
    let file = match &world.path {
        Some(path) => path.display().to_string(),
        None => "built-in room".to_owned(),
    };
    [
        ("plan", format!("{} ({})", program.name, program.file)),
        ("world", format!("{} ({file})", world.world.name())),
        ("seed", options.seed.to_string()),
    ]
}

/// What the log says of the run: enough to do it again.
fn about(setting: &Setting<'_>) -> About {
    let Setting { program, options, world, .. } = setting;
    let set = options.set.iter().map(|(name, value)| format!("{name}={value}"));
    let lines = |all: &mut dyn Iterator<Item = String>| all.collect::<Vec<_>>().join("\n");
    let until = match options.end() {
        Instant::MAX => String::new(),
        end => end.as_nanos().to_string(),
    };
    let clock = if options.speed == Speed::Max { "virtual" } else { "virtual, paced" };
    let facts = [
        ("plan", program.name.to_owned()),
        ("plan_file", program.file.to_owned()),
        ("plan_hash", plan_hash(program)),
        ("robot", "sim".to_owned()),
        ("seed", options.seed.to_string()),
        ("set", set.collect::<Vec<_>>().join("\n")),
        ("press", lines(&mut options.press.iter().map(ToString::to_string))),
        ("fail", lines(&mut options.fail.iter().map(ToString::to_string))),
        ("world", world.world.name().to_owned()),
        ("world_hash", hash(&world.text)),
        ("until_ns", until),
        ("clock", clock.to_owned()),
        ("afp_version", env!("CARGO_PKG_VERSION").to_owned()),
    ];
    let of_robot = setting.facts.iter().map(|(key, value)| (*key, (*value).to_owned()));
    let facts = facts.into_iter().chain(of_robot);
    let texts = program.texts.iter();
    let mut attachments: Vec<_> =
        texts.map(|(path, text)| ((*path).to_owned(), "text/plain", (*text).to_owned())).collect();
    attachments.push(("world.toml".to_owned(), "application/toml", world.text.clone()));
    About { facts: facts.map(|(key, value)| (key.to_owned(), value)).collect(), attachments }
}

/// The hash of the plan's text; of several files, that of their paths and texts.
fn plan_hash(program: &Program<'_>) -> String {
    match program.texts {
        [(_, text)] => hash(text),
        texts => {
            hash(&texts.iter().map(|(path, text)| format!("{path}\0{text}\0")).collect::<String>())
        }
    }
}
