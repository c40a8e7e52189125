//! One run from its options to its summary.

use std::fs;
use std::path::{Path, PathBuf};

use afp_core::rt::{NamedPlan, Plan};
use afp_core::trace::{Ending, Names, TraceHash};
use afp_core::{Instant, Scheduler};
use afp_log::{About, NameTable, Recorder, WhenFull, Written};
use afp_sim::{STEP, Simulation};

use crate::drive::{Drive, Stimuli};
use crate::error::{EXIT_OK, EXIT_PLAN_ERROR, RunError};
use crate::hash::hash;
use crate::judge::Judge;
use crate::options::{Destination, RunOptions, Speed};
use crate::output::{check_writable, write_whole};
use crate::pace::Pace;
use crate::report::{Figures, Ran, Report, StoppedBy, Summary};
use crate::robot::RobotLog;
use crate::stop::StopFlag;
use crate::svg::{self, Picture};
use crate::tracer::Tracer;
use crate::world::{self, LoadedWorld};
use crate::{Program, inputs};

/// Where logs and pictures go unless told otherwise.
const RUNS: &str = "target/afp/runs";

/// Runs a plan on the simulated robot; gives the exit code.
///
/// # Errors
/// Wrong options, a world or an output that does not work. What a plan does wrong is no error but
/// an exit code.
pub fn run<P>(program: &Program<'_>, mut plan: P, options: &RunOptions) -> Result<u8, RunError>
where
    P: NamedPlan + Plan<Simulation>,
{
    options.check()?;
    inputs::set(&mut plan, &options.set)?;
    let world = world::find(options.world.as_deref(), Path::new(program.file))?;
    let sim = Simulation::new(&world.world, options.seed).map_err(|error| RunError::Content {
        path: world.path.clone().unwrap_or_default(),
        place: error.place,
        text: world.text.clone(),
        message: error.message,
    })?;
    let names = plan.names();
    let paths = Paths::new(program, options)?;
    let log = match &paths.log {
        None => None,
        Some(path) => {
            let about = about(program, options, &world);
            Some(Recorder::create(path, &about, NameTable::new(&names), WhenFull::Wait)?)
        }
    };
    let stop =
        StopFlag::on_signals().map_err(RunError::file("cannot handle", "signals".as_ref()))?;
    let mut drive = Drive {
        scheduler: Scheduler::new(plan),
        sim,
        names: &names,
        tracer: Tracer::new(log),
        judge: Judge::new(&names),
        trace: TraceHash::default(),
        report: Report::new(options.json, options.end()),
        pace: Pace::new(options.speed),
        stop,
        robot_log: None,
        stimuli: Stimuli::new(&options.press),
        end: options.end(),
    };
    drive.robot_log = drive.tracer.log.as_mut().map(|log| RobotLog::begin(log, &world.world));
    drive.report.head(&head(program, options, &world));
    let stopped_by = drive.run().map_err(|error| inputs::missing(error, &names))?;
    finish(drive, &paths, &Setting { program, options, world: &world, stopped_by })
}

/// What was asked for and how it came out.
struct Setting<'a> {
    program: &'a Program<'a>,
    options: &'a RunOptions,
    world: &'a LoadedWorld,
    stopped_by: Option<StoppedBy>,
}

/// Closes the log, draws the picture, prints the summary.
fn finish<P, N: Names>(
    mut drive: Drive<'_, P, N>,
    paths: &Paths,
    setting: &Setting<'_>,
) -> Result<u8, RunError>
where
    P: NamedPlan + Plan<Simulation>,
{
    let end = drive.sim.now();
    let speed = end.as_secs_f64() / drive.pace.spent();
    let truth = drive.sim.truth();
    let ran = Ran {
        plan: setting.program.name,
        world: &setting.world.world,
        seed: setting.options.seed,
        stopped_by: setting.stopped_by,
        end,
        misses: drive.scheduler.misses(),
        trace: drive.trace,
        collisions: truth.collisions(),
    };
    let figures = Figures::new(&ran, &drive.judge, drive.names);
    let written = drive.tracer.log.take().map(Recorder::finish).transpose()?;
    if let Some(path) = &paths.svg {
        let picture = Picture {
            world: &setting.world.world,
            title: figures.plan.clone(),
            subtitle: format!("{}, seed {}", figures.world, figures.seed),
            path: &drive.judge.path,
            marks: &drive.judge.marks,
            figures: figures.for_picture(),
        };
        write_whole("cannot write the picture", path, svg::draw(&picture, drive.names))?;
    }
    let lost = written.as_ref().map_or(0, |written: &Written| written.lost);
    let log = written.map(|written| written.path);
    let ending = drive.judge.ending;
    let summary = Summary { figures, speed, log, svg: paths.svg.clone(), lost };
    let told = drive.report.end(&summary);
    told.map_err(RunError::file("cannot write to", "standard output".as_ref()))?;
    match ending {
        Some(Ending::Error(_)) => Ok(EXIT_PLAN_ERROR),
        _ => Ok(EXIT_OK),
    }
}

/// Where output goes.
struct Paths {
    log: Option<PathBuf>,
    svg: Option<PathBuf>,
}

impl Paths {
    /// Makes the default folder where it is needed, and finds out now what would fail later.
    fn new(program: &Program<'_>, options: &RunOptions) -> Result<Self, RunError> {
        let stem = Path::new(program.file).file_stem().unwrap_or("plan".as_ref());
        let path = |asked: &Option<Destination>, extension| -> Result<_, RunError> {
            match asked {
                Some(Destination::None) => Ok(None),
                Some(Destination::File(path)) => Ok(Some(path.clone())),
                None => {
                    let folder = Path::new(RUNS);
                    fs::create_dir_all(folder)
                        .map_err(RunError::file("cannot make the folder", folder))?;
                    let mut name = stem.to_owned();
                    name.push(extension);
                    Ok(Some(folder.join(name)))
                }
            }
        };
        let paths = Paths { log: path(&options.log, ".mcap")?, svg: path(&options.svg, ".svg")? };
        if let Some(path) = &paths.svg {
            check_writable("cannot write the picture", path)?;
        }
        Ok(paths)
    }
}

fn head(
    program: &Program<'_>,
    options: &RunOptions,
    world: &LoadedWorld,
) -> [(&'static str, String); 3] {
    let file = match &world.path {
        Some(path) => path.display().to_string(),
        None => "built-in room".to_owned(),
    };
    [
        ("plan", format!("{} ({})", program.name, program.file)),
        ("world", format!("{} ({file})", world.world.name)),
        ("seed", options.seed.to_string()),
    ]
}

/// What the log says of the run: enough to do it again.
fn about(program: &Program<'_>, options: &RunOptions, world: &LoadedWorld) -> About {
    let set = options.set.iter().map(|(name, value)| format!("{name}={value}"));
    let until = match options.end() {
        Instant::MAX => String::new(),
        end => end.as_nanos().to_string(),
    };
    let facts = [
        ("plan", program.name.to_owned()),
        ("plan_file", program.file.to_owned()),
        ("plan_hash", plan_hash(program)),
        ("robot", "sim".to_owned()),
        ("seed", options.seed.to_string()),
        ("set", set.collect::<Vec<_>>().join("\n")),
        ("world", world.world.name.clone()),
        ("world_hash", hash(&world.text)),
        ("physics_step_ns", STEP.as_nanos().to_string()),
        ("until_ns", until),
        (
            "clock",
            if options.speed == Speed::Max { "virtual" } else { "virtual, paced" }.to_owned(),
        ),
        ("afp_version", env!("CARGO_PKG_VERSION").to_owned()),
    ];
    let texts = program.texts.iter();
    let mut attachments: Vec<_> =
        texts.map(|(path, text)| ((*path).to_owned(), "text/plain", (*text).to_owned())).collect();
    attachments.push(("world.toml".to_owned(), "application/toml", world.text.clone()));
    About { facts: facts.map(|(key, value)| (key.to_owned(), value)).to_vec(), attachments }
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
