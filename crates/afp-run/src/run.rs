//! One run from its options to its summary.

use std::fs;
use std::path::{Path, PathBuf};

use afp_core::rt::{NamedPlan, Plan};
use afp_core::{Duration, Ending, Environment, Instant, StartError};
use afp_log::{About, NameTable, Recorder, WhenFull, Written};
use afp_sim::{STEP, Simulation};

use crate::attend::{Attendants, Stimuli};
use crate::error::{EXIT_OK, EXIT_PLAN_ERROR, RunError};
use crate::hash::hash;
use crate::judge::Judge;
use crate::options::{Destination, RunOptions, Speed};
use crate::output::{check_writable, write_whole};
use crate::pace::Pace;
use crate::picture::{PictureFormat, Rasterizer};
use crate::report::{Figures, Ran, Report, StoppedBy, Summary};
use crate::rig::{Go, Rig};
use crate::stop::StopFlag;
use crate::svg::{self, Picture};
use crate::world::{self, LoadedWorld};
use crate::{Program, inputs};

/// Where logs and pictures go unless told otherwise.
const RUNS: &str = "target/afp/runs";

/// Runs a plan on the simulated robot; gives the exit code. Pictures are SVG.
///
/// # Errors
/// Wrong options, a world or an output that does not work. What a plan does wrong is no error but
/// an exit code.
pub fn run<P>(program: &Program<'_>, plan: P, options: &RunOptions) -> Result<u8, RunError>
where
    P: NamedPlan + Plan<Simulation>,
{
    run_with(program, plan, options, None)
}

/// As [`run`], with PNG pictures too.
///
/// # Errors
/// As of [`run`].
pub fn run_with<P>(
    program: &Program<'_>,
    mut plan: P,
    options: &RunOptions,
    rasterizer: Option<Rasterizer<'_>>,
) -> Result<u8, RunError>
where
    P: NamedPlan + Plan<Simulation>,
{
    options.check()?;
    let mut world = world::find(options.world.as_deref(), Path::new(program.file))?;
    inputs::set_all(&mut plan, &mut world, &options.set)?;
    let mut sim =
        Simulation::new(&world.world, options.seed).map_err(|error| RunError::Content {
            path: world.path.clone().unwrap_or_default(),
            span: error.span,
            text: world.text.clone(),
            message: error.message,
        })?;
    for failure in &options.fail {
        sim.inject(failure.fault, failure.from, failure.lasting);
    }
    let names = plan.names();
    let paths = Paths::new(program, options)?;
    let raster = paths.raster(rasterizer)?;
    let log = match &paths.log {
        None => None,
        Some(path) => {
            let about = about(program, options, &world);
            Some(Recorder::create(path, &about, NameTable::new(&names), WhenFull::Wait)?)
        }
    };
    let stop =
        StopFlag::on_signals().map_err(RunError::file("cannot handle", "signals".as_ref()))?;
    let mut attendants = Attendants {
        judge: Judge::new(&names),
        report: Report::new(options.json, options.end()),
        pace: Pace::new(options.speed),
        stop,
        stimuli: Stimuli::new(&options.press),
    };
    let mut rig = Rig::new(plan, sim, Duration::ZERO);
    if let Some(log) = log {
        rig.record(log, &world.world, options.camera);
    }
    attendants.report.head(&head(program, options, &world));
    let stopped_by = drive(&mut rig, &mut attendants, options.end())
        .map_err(|error| inputs::missing(error, &names))?;
    let setting = Setting { program, options, world: &world, stopped_by };
    finish(rig, attendants, &paths, &setting, raster)
}

/// Runs the plan to its end, or until it is stopped. The motors stand afterwards.
fn drive<P>(
    rig: &mut Rig<P>,
    attendants: &mut Attendants,
    end: Instant,
) -> Result<Option<StoppedBy>, StartError>
where
    P: NamedPlan + Plan<Simulation>,
{
    let went = rig.run(end, attendants)?;
    let stopped_by = match (went, rig.ending()) {
        (Go::Stop, None) => Some(StoppedBy::Signal),
        (_, None) => Some(StoppedBy::Until),
        (_, Some(_)) => None,
    };
    if stopped_by.is_some() {
        rig.stop(attendants);
    }
    rig.sim.emergency_stop();
    Ok(stopped_by)
}

/// What was asked for and how it came out.
struct Setting<'a> {
    program: &'a Program<'a>,
    options: &'a RunOptions,
    world: &'a LoadedWorld,
    stopped_by: Option<StoppedBy>,
}

/// Closes the log, draws the picture, prints the summary.
fn finish<P>(
    mut rig: Rig<P>,
    attendants: Attendants,
    paths: &Paths,
    setting: &Setting<'_>,
    raster: Option<Rasterizer<'_>>,
) -> Result<u8, RunError>
where
    P: NamedPlan + Plan<Simulation>,
{
    let Attendants { judge, report, pace, .. } = attendants;
    let end = rig.sim.now();
    let speed = end.as_secs_f64() / pace.spent();
    let ran = Ran {
        plan: setting.program.name,
        world: &setting.world.world,
        seed: setting.options.seed,
        stopped_by: setting.stopped_by,
        end,
        misses: rig.scheduler.misses(),
        collisions: rig.sim.truth().collisions(),
        trace: rig.trace(),
    };
    let figures = Figures::new(&ran, &judge, rig.names());
    let written = rig.finish_log()?;
    if let Some(path) = &paths.svg {
        let picture = Picture {
            world: &setting.world.world,
            title: figures.plan.clone(),
            subtitle: format!("{}, seed {}", figures.world, figures.seed),
            path: &judge.path,
            marks: &judge.marks,
            figures: figures.for_picture(),
        };
        let svg = svg::draw(&picture, rig.names());
        let bytes = match raster {
            Some(raster) => raster(&svg)?,
            None => svg.into_bytes(),
        };
        write_whole("cannot write the picture", path, bytes)?;
    }
    let lost = written.as_ref().map_or(0, |written: &Written| written.lost);
    let log = written.map(|written| written.path);
    let summary = Summary { figures, speed, log, svg: paths.svg.clone(), lost };
    let told = report.end(&summary);
    told.map_err(RunError::file("cannot write to", "standard output".as_ref()))?;
    match rig.ending() {
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

    /// What makes the picture's bytes of an SVG; `None` where it is one.
    fn raster<'a>(&self, all: Option<Rasterizer<'a>>) -> Result<Option<Rasterizer<'a>>, RunError> {
        let Some(path) = &self.svg else { return Ok(None) };
        match (PictureFormat::of(path)?, all) {
            (PictureFormat::Svg, _) => Ok(None),
            (PictureFormat::Png, Some(raster)) => Ok(Some(raster)),
            (PictureFormat::Png, None) => Err(RunError::usage(
                "this program draws SVG alone",
                "'afpc log RUN.mcap --svg PICTURE.png' draws its log as a PNG",
            )),
        }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_take_a_program_that_can_make_them() {
        let raster: Rasterizer<'_> = &|_| Ok(Vec::new());
        let of = |name: &str, raster| {
            let made = Paths { log: None, svg: Some(name.into()) }.raster(raster);
            made.map(|made| made.is_some()).map_err(|error| error.code())
        };
        let usage = crate::EXIT_USAGE;
        assert_eq!((of("a.svg", None), of("a.svg", Some(raster))), (Ok(false), Ok(false)));
        assert_eq!((of("a.png", None), of("a.png", Some(raster))), (Err(usage), Ok(true)));
    }
}
