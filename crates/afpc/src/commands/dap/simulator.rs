//! What is debugged: plans of files on the robot that is linked in, simulated, and logs.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use afp_core::devices::{DeviceRow, SignalType, signals};
use afp_debug::{Host, Launch, LogTarget, Program, SessionTarget, Surroundings, Target};
use afp_dsl::graph::Graph;
use afp_run::world;
use afp_session::{Pose2, Recipe};

use crate::plan_file::PlanFile;
use crate::{Linked, runner};

use super::senses::Senses;

/// Runs plans of files on the robot that is linked in, simulated.
pub struct Simulator<'a> {
    linked: Linked<'a>,
    /// Where what is run must lie; anywhere without one.
    folder: Option<PathBuf>,
}

impl<'a> Simulator<'a> {
    /// Runs any plan of this machine.
    pub fn new(linked: &Linked<'a>) -> Self {
        Simulator { linked: *linked, folder: None }
    }

    /// Runs plans and shows logs that lie in a folder, and no others; its path is one from the root, without links.
    pub fn inside(linked: &Linked<'a>, folder: &Path) -> Self {
        Simulator { linked: *linked, folder: Some(folder.to_owned()) }
    }

    /// # Errors
    /// A path leads out of the folder.
    pub fn check_all(&self, launch: &Launch) -> Result<(), String> {
        let world = launch.world.as_ref().filter(|world| !world.starts_with(world::RANDOM));
        let paths = [Some(&launch.program), launch.log.as_ref(), world].into_iter().flatten();
        paths.filter(|path| !path.is_empty()).try_for_each(|path| self.check(path))
    }

    /// The world that a log was recorded in.
    fn world_of_log(&self, log: &Path) -> Result<Surroundings, String> {
        let log = afp_log::read(log).map_err(|why| why.to_string())?;
        let Recipe { world, start, seed, .. } = log.recipe();
        let found = self.linked.robot.kind().world(&world.text).map_err(|why| why.to_string())?;
        let found = match start {
            Some(start) => found.started_at(start)?,
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

    fn check(&self, path: &str) -> Result<(), String> {
        let Some(folder) = &self.folder else { return Ok(()) };
        // The plan may be named behind the file.
        let file =
            path.rsplit_once(".afp:").map_or(path.to_owned(), |(file, _)| format!("{file}.afp"));
        match Path::new(&absolute(&file)).starts_with(folder) {
            true => Ok(()),
            false => Err(format!("'{path}' lies outside of '{}'", folder.display())),
        }
    }
}

impl<'a> Host<'a> for Simulator<'a> {
    fn launch(&mut self, launch: &Launch) -> Result<Box<dyn Target + 'a>, String> {
        self.check_all(launch)?;
        if let Some(log) = &launch.log {
            return Ok(Box::new(recorded(Path::new(log), self.linked.robot.kind().devices())?));
        }
        let file = PlanFile::read(&launch.program).map_err(|why| why.to_string())?;
        let shown = file.compiled.render(false);
        let graph = file.compiled.graph.clone().ok_or(shown)?;
        let linked = runner::is_linked(&file.own, &graph, &self.linked);
        if !linked.map_err(|why| why.to_string())? {
            let program = &launch.program;
            return Err(format!(
                "'{program}' needs a robot or toolboxes of its project: start 'afpc dap {program}', which builds them"
            ));
        }
        let robot = self.linked.robot;
        let asked = launch.world.as_deref().map(Path::new);
        let mut found =
            world::find(asked, &file.path, robot.kind()).map_err(|why| why.to_string())?;
        let usual = found.world.drawing().start;
        if let Some([x, y, heading]) = launch.start {
            found = found.started_at(Pose2 { x, y, heading })?;
        }
        let warning = found.warning(usual);
        let program = program(&graph, &file, &absolute);
        let launch = launch.clone();
        let make = move || {
            let session = robot.session(&graph, &*found.world, launch.seed.unwrap_or(0), &[]);
            let mut session = session.map_err(|why| format!("{why}: {}", why.help()))?;
            for (name, text) in &launch.set {
                let set = session.set(name, text);
                set.map_err(|why| why.explained(&*session, name, text).to_string())?;
            }
            Ok(session)
        };
        let target = SessionTarget::new(Arc::new(program), Box::new(make))?;
        Ok(Box::new(target.with_warnings(warning.map(str::to_owned).into_iter().collect())))
    }

    fn world(&mut self, launch: &Launch) -> Result<Surroundings, String> {
        self.check_all(launch)?;
        if let Some(log) = &launch.log {
            return self.world_of_log(Path::new(log));
        }
        let path = launch
            .program
            .rsplit_once(".afp:")
            .map_or_else(|| launch.program.clone(), |(file, _)| format!("{file}.afp"));
        // Before there is a plan, the world is the one that a new plan of the folder would have.
        let path = match (&*path, &self.folder) {
            ("", Some(folder)) => folder.join("plan.afp"),
            _ => PathBuf::from(absolute(&path)),
        };
        let kind = self.linked.robot.kind();
        let asked = launch.world.as_deref().map(Path::new);
        let found = world::find(asked, &path, kind).map_err(|why| why.to_string())?;
        let mut worlds = world::all(&path, kind).map_err(|why| why.to_string())?;
        // What would be refused is not offered; the first one is taken without being named.
        let open = |name: &str| {
            name.is_empty() || name.starts_with(world::RANDOM) || self.check(name).is_ok()
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

/// A run that is over.
fn recorded(path: &Path, devices: &'static [DeviceRow]) -> Result<LogTarget, String> {
    let mut log = afp_log::read(path).map_err(|why| why.to_string())?;
    let file = PlanFile::of_log(&log, path).map_err(|why| why.to_string())?;
    let shown = file.compiled.render(false);
    let graph = file.compiled.graph.clone().ok_or(shown)?;
    // The texts of a log are named as seen from the folder of the plan.
    let folder = file.path.parent().unwrap_or(Path::new(""));
    let folder = std::path::absolute(folder).unwrap_or_default();
    let named = |name: &str| match log.attachments.contains_key(name) {
        true => absolute(&folder.join(name).display().to_string()),
        false => absolute(name),
    };
    let program = program(&graph, &file, &named);
    let events = std::mem::take(&mut log.events);
    let target = LogTarget::new(Arc::new(program), events)?;
    let target = target.with_poses(std::mem::take(&mut log.poses));
    let senses = Senses::take(&mut log, devices);
    let target = target.with_senses(move |at, robot| senses.at(at, robot));
    Ok(target.with_pictures(move |at| log.picture(at)))
}

/// A plan with its places; texts that are not those of files go along.
fn program(graph: &Graph, file: &PlanFile, path: &dyn Fn(&str) -> String) -> Program {
    let mut program = Program::new(graph, &file.compiled.sources, path);
    program.keep_texts(&file.compiled.sources, &|path, text| {
        fs::read_to_string(path).is_ok_and(|known| known == text)
    });
    program
}

/// A path from the root, without links, where the file is there.
fn absolute(path: &str) -> String {
    let path = path.strip_prefix("file://").unwrap_or(path);
    fs::canonicalize(path).map_or_else(|_| path.to_owned(), |path| path.display().to_string())
}
