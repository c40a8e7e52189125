//! Debug targets: plans on the linked, simulated robot, and logs.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::{fs, io};

use afp_core::devices::{DeviceRow, SignalType, signals};
use afp_debug::{
    Fork, FoundMoment, Host, Launch, LogTarget, Program, SessionTarget, Surroundings, Target,
    moment,
};
use afp_dsl::files::path_of;
use afp_dsl::graph::Graph;
use afp_log::LogData;
use afp_run::{RunError, world};
use afp_session::{AnyRobot, AnyWorld, Pose2, Recipe};

use crate::plan_file::{self, PlanFile, PlanText};
use crate::{Linked, runner};

use super::senses::Senses;

/// Runs plans on the linked robot in simulation.
pub struct Simulator<'a> {
    linked: Linked<'a>,
    /// The folder that restricts all files; `None` allows any file.
    folder: Option<PathBuf>,
}

impl<'a> Simulator<'a> {
    /// Runs any plan of this machine.
    pub fn new(linked: &Linked<'a>) -> Self {
        Simulator { linked: *linked, folder: None }
    }

    /// Runs plans and shows logs only in a folder; `folder` is a canonical absolute path.
    pub fn inside(linked: &Linked<'a>, folder: &Path) -> Self {
        Simulator { linked: *linked, folder: Some(folder.to_owned()) }
    }

    /// The files of a launch, all of them readable.
    ///
    /// # Errors
    /// A path leads out of the folder, or does not exist.
    pub fn files(&self, launch: &Launch) -> Result<LaunchFiles, String> {
        let named = path_of(&launch.program);
        let (path, plan) = plan_file::split(&named);
        let inside = |path: &str| self.inside_of_folder(Path::new(&path_of(path)));
        let world = match launch.world.as_deref() {
            Some(world) if !world.starts_with(world::RANDOM) => Some(inside(world)?),
            world => world.map(PathBuf::from),
        };
        // The plan of a log comes only from the log.
        let program = match launch.log {
            Some(_) => self.inside_of_folder(&path).unwrap_or_default(),
            None => self.inside_of_folder(&path)?,
        };
        Ok(LaunchFiles {
            program,
            plan: plan.map(str::to_owned),
            log: launch.log.as_deref().map(inside).transpose()?,
            world,
        })
    }

    /// The world of the recorded run.
    fn world_of_log(&self, log: &Path) -> Result<Surroundings, String> {
        let log = afp_log::read(log).map_err(|why| why.to_string())?;
        let Recipe { world, start, seed, .. } = log.recipe();
        let found = self.linked.robot.kind().world(&world.text).map_err(|why| why.to_string())?;
        let found = match start {
            Some(start) => found.started_at(start).map_err(|why| why.message)?,
            None => found,
        };
        let worlds = vec![(world.name, "the log")];
        let (seed, cut_short) = (Some(seed), log.cut_short);
        Ok(Surroundings {
            drawing: found.drawing(),
            worlds,
            seed,
            cut_short,
            ..Surroundings::default()
        })
    }

    /// Checks that this program has the parts of a plan.
    fn check_linked(&self, file: &PlanFile, graph: &Graph, program: &str) -> Result<(), String> {
        match runner::is_linked(&file.own, graph, &self.linked).map_err(|why| why.to_string())? {
            true => Ok(()),
            false => Err(format!(
                "'{program}' needs a robot or toolboxes of its project: run 'afpc dap {program}', which builds them"
            )),
        }
    }

    /// The given path. With a restricting folder, the canonical path, so that the checked file is
    /// also the file that is read.
    fn inside_of_folder(&self, path: &Path) -> Result<PathBuf, String> {
        let Some(folder) = self.folder.as_ref().filter(|_| !path.as_os_str().is_empty()) else {
            return Ok(path.to_owned());
        };
        let named = path.display();
        let whole = whole(path).map_err(|why| format!("cannot open '{named}': {why}"))?;
        match whole.starts_with(folder) {
            true => Ok(whole),
            false => Err(format!("'{named}' is outside of '{}'", folder.display())),
        }
    }
}

/// A canonical absolute path. For a missing file, only the folder is resolved: another program may
/// replace the file at this moment.
fn whole(path: &Path) -> io::Result<PathBuf> {
    match (path.canonicalize(), path.parent(), path.file_name()) {
        (Err(_), Some(folder), Some(name)) if path.symlink_metadata().is_err() => {
            Ok(folder.canonicalize()?.join(name))
        }
        (whole, ..) => whole,
    }
}

pub struct LaunchFiles {
    /// The plan's file; empty if the launch names none.
    program: PathBuf,
    plan: Option<String>,
    log: Option<PathBuf>,
    /// The world's file, or the seed of a random world.
    world: Option<PathBuf>,
}

impl LaunchFiles {
    /// Reads and compiles the plan.
    ///
    /// # Errors
    /// A file cannot be read.
    pub fn plan(&self) -> Result<PlanFile, RunError> {
        PlanText::read_at(self.program.clone(), self.plan.as_deref())?.compile()
    }
}

impl<'a> Host<'a> for Simulator<'a> {
    fn launch(&mut self, launch: &Launch) -> Result<Box<dyn Target + 'a>, String> {
        let files = self.files(launch)?;
        if let Some(log) = &files.log {
            return Ok(Box::new(recorded(log, self.linked.robot.kind().devices())?));
        }
        let file = files.plan().map_err(|why| why.to_string())?;
        let shown = file.compiled.render(false);
        let graph = file.compiled.graph.clone().ok_or(shown)?;
        self.check_linked(&file, &graph, &launch.program)?;
        let robot = self.linked.robot;
        let found = world::find(files.world.as_deref(), &file.path, robot.kind());
        let mut found = found.map_err(|why| why.to_string())?;
        let usual = found.world.drawing().start;
        if let Some([x, y, heading]) = launch.start {
            let start = Pose2 { x, y, heading };
            found = found.started_at(start).map_err(|why| why.message)?;
        }
        let warning = found.warning(usual);
        let program = program(&graph, &file, &absolute);
        let launch = launch.clone();
        let make = move || {
            let session = robot.session(&graph, &*found.world, launch.seed.unwrap_or(0), &[]);
            let mut session = session.map_err(|why| format!("{why}: {}", why.help()))?;
            for (name, text) in &launch.set {
                session.set(name, text).map_err(|why| why.to_string())?;
            }
            Ok(session)
        };
        let target = SessionTarget::new(Arc::new(program), Box::new(make))?;
        Ok(Box::new(target.with_warnings(warning.map(str::to_owned).into_iter().collect())))
    }

    fn fork(&mut self, fork: &Fork<'_>) -> Result<(Box<dyn Target + 'a>, Vec<String>), String> {
        let files = self.files(fork.launch)?;
        let path = files.log.as_deref().ok_or("only a log continues in the simulator")?;
        let log = afp_log::read(path).map_err(|why| why.to_string())?;
        let file = match files.program.as_os_str().is_empty() {
            true => PlanFile::of_log(&log, path),
            false => files.plan(),
        };
        let file = file.map_err(|why| why.to_string())?;
        let shown = file.compiled.render(false);
        let mut graph = file.compiled.graph.clone().ok_or(shown)?;
        self.check_linked(&file, &graph, &file.path.display().to_string())?;
        let FoundMoment { moment, active, lost } = moment(fork.program, fork.state, &graph)?;
        graph.moment = Some(moment);
        let (world, place) = forked_world(&log, &file, fork.pose, self.linked.robot.kind())?;
        let at = fork.at.as_secs_f64();
        let mut notes = vec![
            format!("from {at:.3} s the simulator continues the log: '{active}' starts again"),
            place,
        ];
        if !lost.is_empty() {
            notes.push(format!("values that the log cannot give back: {}", lost.join(", ")));
        }
        let program = program(&graph, &file, &absolute);
        let (robot, seed, at) = (self.linked.robot, log.recipe().seed, fork.at);
        let make = move || {
            let session = robot.session(&graph, &*world, seed, &[]);
            let mut session = session.map_err(|why| format!("{why}: {}", why.help()))?;
            // Its time continues that of the log.
            session.wait(at);
            Ok(session)
        };
        Ok((Box::new(SessionTarget::new(Arc::new(program), Box::new(make))?), notes))
    }

    fn world(&mut self, launch: &Launch) -> Result<Surroundings, String> {
        let files = self.files(launch)?;
        if let Some(log) = &files.log {
            return self.world_of_log(log);
        }
        // Without a plan, the world is the default world of a new plan in the folder.
        let path = match &self.folder {
            Some(folder) if files.program.as_os_str().is_empty() => folder.join("plan.afp"),
            _ => PathBuf::from(absolute(&files.program.display().to_string())),
        };
        let kind = self.linked.robot.kind();
        let found = world::find(files.world.as_deref(), &path, kind);
        let found = found.map_err(|why| why.to_string())?;
        let mut worlds = world::all(&path, kind).map_err(|why| why.to_string())?;
        // Files that would be refused are not offered. The first file is the default.
        let open = |name: &str| {
            name.is_empty()
                || name.starts_with(world::RANDOM)
                || self.inside_of_folder(Path::new(name)).is_ok()
        };
        if let Some((first, _)) = worlds.first_mut().filter(|(name, _)| !open(name)) {
            first.clear();
        }
        worlds.retain(|(name, _)| open(name));
        let drops = kind.drops();
        let camera = signals(kind.devices()).any(|(.., row)| row.ty == SignalType::Image);
        Ok(Surroundings {
            drawing: found.world.drawing(),
            worlds,
            drops,
            camera,
            ..Surroundings::default()
        })
    }

    fn path(&self, path: &str) -> String {
        absolute(path)
    }
}

/// The world in which a log continues, with the robot at its place, and a sentence about the place.
/// The world of a real robot is unknown: the simulator takes the plan's.
fn forked_world(
    log: &LogData,
    file: &PlanFile,
    pose: Option<Pose2>,
    kind: &dyn AnyRobot,
) -> Result<(Arc<dyn AnyWorld>, String), String> {
    let Recipe { world, .. } = log.recipe();
    let is_simulated = !world.text.is_empty();
    let found = match is_simulated {
        true => kind.world(&world.text).map_err(|why| why.to_string())?,
        false => world::find(None, &file.path, kind).map_err(|why| why.to_string())?.world,
    };
    let start = found.drawing().start;
    let Some(pose) = pose else {
        return Ok((
            found,
            "the robot's place is unknown: it is at the start of the world".to_owned(),
        ));
    };
    // The odometry of a real robot counts from its start.
    let first = log.believed.first().map_or(Pose2::default(), |(_, first)| *first);
    let pose = if is_simulated { pose } else { start.beyond(first.to(pose)) };
    let Pose2 { x, y, heading } = pose;
    match found.started_at(pose) {
        Ok(there) => {
            let by =
                if is_simulated { "" } else { ", by its odometry from the start of the world" };
            let degrees = heading.to_degrees();
            Ok((there, format!("the robot is at {x:.2} m, {y:.2} m, {degrees:.0} deg{by}")))
        }
        Err(why) => {
            let why = why.message;
            Ok((found, format!("the robot is at the start of the world, not at its place: {why}")))
        }
    }
}

/// A finished run.
fn recorded(path: &Path, devices: &'static [DeviceRow]) -> Result<LogTarget, String> {
    let mut log = afp_log::read(path).map_err(|why| why.to_string())?;
    let file = PlanFile::of_log(&log, path).map_err(|why| why.to_string())?;
    let shown = file.compiled.render(false);
    let graph = file.compiled.graph.clone().ok_or(shown)?;
    // Source names in a log are relative to the plan's folder.
    let folder = file.path.parent().unwrap_or(Path::new(""));
    let folder = std::path::absolute(folder).unwrap_or_default();
    let named = |name: &str| match log.attachments.contains_key(name) {
        true => absolute(&folder.join(name).display().to_string()),
        false => absolute(name),
    };
    let program = program(&graph, &file, &named);
    let events = std::mem::take(&mut log.events);
    let target = LogTarget::new(Arc::new(program), events)?;
    let poses = std::mem::take(&mut log.poses);
    // A real robot has only its odometry.
    let target = target.with_poses(if poses.is_empty() { log.believed.clone() } else { poses });
    let senses = Senses::take(&mut log, devices);
    let target = target.with_senses(move |at, robot| senses.at(at, robot));
    Ok(target.with_pictures(move |at| log.picture(at)))
}

/// A plan with its places and its sources, including sources that are not files.
pub(super) fn program(graph: &Graph, file: &PlanFile, path: &dyn Fn(&str) -> String) -> Program {
    let mut program = Program::new(graph, &file.compiled.sources, path);
    program.keep_texts(&file.compiled.sources, &|path, text| {
        fs::read_to_string(path).is_ok_and(|known| known == text)
    });
    program
}

/// A canonical absolute path if the file exists.
pub(super) fn absolute(path: &str) -> String {
    let path = path_of(path);
    fs::canonicalize(&path).map_or(path, |path| path.display().to_string())
}
