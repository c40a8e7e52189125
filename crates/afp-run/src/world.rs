//! Finds the world of a run.

pub mod change;
mod measure;
mod named;
mod place;

use std::borrow::Cow;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use afp_output::{read_file, read_text};
use afp_project::{ProjectFile, shown};
use afp_session::{AnyRobot, AnyWorld, Drawing, Pose2, SessionError, WorldError};

use crate::error::RunError;

pub(crate) use measure::Measure;
pub(crate) use named::named;

/// The name of the world without a file.
pub(crate) const BUILT_IN: &str = "built-in room";

const NO_WORLD: &str = "cannot read the world";

/// The limit for the picture of a map, in bytes.
const LONGEST_PICTURE: u64 = 64 << 20;

/// A world and its text.
#[derive(Clone, Debug)]
pub struct LoadedWorld {
    pub world: Arc<dyn AnyWorld>,
    pub text: String,
    /// Its file; `None` for the built-in room.
    pub path: Option<PathBuf>,
    /// The start of the robot, if it differs from that of the file.
    pub start: Option<Pose2>,
}

impl LoadedWorld {
    /// The same world with another start of the robot.
    ///
    /// # Errors
    /// The robot cannot start there.
    pub fn started_at(self, start: Pose2) -> Result<LoadedWorld, WorldError> {
        let world = self.world.started_at(start)?;
        Ok(LoadedWorld { world, start: Some(start), ..self })
    }

    /// The error of a session in this world, with the file.
    pub fn no_session(&self, why: SessionError) -> RunError {
        let SessionError::World(why) = why else { return why.into() };
        let help = match self.path {
            Some(_) => "",
            None => "it comes from the robot's 'Simulated::new': look there, or name another world",
        };
        let path = self.path.clone().unwrap_or_else(|| BUILT_IN.into());
        let why = WorldError::new(None, why.to_string()).with_help(help);
        RunError::content(path, &*self.text)(why)
    }

    /// A warning if the robot starts outside of its world, but `usual` is inside.
    pub fn warning(&self, usual: Pose2) -> Option<&'static str> {
        let drawing = self.world.drawing();
        let strange = is_outside(&drawing, drawing.start) && !is_outside(&drawing, usual);
        strange.then_some("the robot starts outside of its world")
    }
}

/// Whether a place is outside of the bounding box of a world.
fn is_outside(world: &Drawing, at: Pose2) -> bool {
    let beyond = |of: fn(&[f64; 2]) -> f64, at: f64| {
        let all = || world.things.iter().flat_map(|thing| thing.outline.iter().map(of));
        all().all(|corner| corner < at) || all().all(|corner| corner > at)
    };
    beyond(|corner| corner[0], at.x) || beyond(|corner| corner[1], at.y)
}

/// The prefix of a seed for a generated room.
pub const RANDOM: &str = "random:";

/// Finds the world of a plan: the requested file (a world, a map `.yaml` or `random:SEED`), else
/// `[run] world` of `afp.toml`, else `worlds/<plan file>.toml` next to the plan's folder, else the
/// built-in room. A robot with a profile has the measures of the project in it.
///
/// # Errors
/// The requested file does not exist; the world or the project file is wrong.
pub fn find(
    asked: Option<&Path>,
    plan: &Path,
    robot: &dyn AnyRobot,
) -> Result<LoadedWorld, RunError> {
    let file = ProjectFile::of_plan(plan)?;
    let beside = beside(plan);
    let world = match (asked, &file.project.world) {
        (Some(path), _) => load(path, robot),
        (None, Some(path)) => load(&shown(&file.folder.join(path)), robot),
        (None, None) if beside.is_file() => load(&tidy(&beside), robot),
        (None, None) => built_in(robot),
    }?;
    match file.project.profile() {
        Some(profile) => world.with(&profile.in_world(), robot),
        None => Ok(world),
    }
}

/// The robot's built-in room.
///
/// # Errors
/// The room is invalid.
pub(crate) fn built_in(robot: &dyn AnyRobot) -> Result<LoadedWorld, RunError> {
    parse(robot.default_world().to_owned(), None, "", robot)
}

/// Checks that a requested world exists, without a robot to read it.
///
/// # Errors
/// The file does not exist.
pub fn check(asked: &Path) -> Result<(), RunError> {
    let is_made_up = asked.to_str().is_some_and(|name| name.starts_with(RANDOM));
    match is_made_up {
        true => Ok(()),
        false => fs::metadata(asked).map(|_| ()).map_err(RunError::file(NO_WORLD, asked)),
    }
}

/// Lists possible worlds for a plan as arguments of `--world`, each with its origin in words: first
/// the default of [`find`], then the other files in the same folders and in the folder `worlds` next
/// to the plan, then a generated one. The built-in world has no name.
///
/// # Errors
/// The project file is wrong.
pub fn all(plan: &Path, robot: &dyn AnyRobot) -> Result<Vec<(String, &'static str)>, RunError> {
    let project = ProjectFile::of_plan(plan)?;
    let named = project.project.world.as_ref().map(|path| shown(&project.folder.join(path)));
    let beside = tidy(&beside(plan));
    let mut all = Vec::new();
    let mut add = |path: &Path, from| {
        let name = path.display().to_string();
        if !all.iter().any(|(known, _)| *known == name) {
            all.push((name, from));
        }
    };
    if let Some(path) = &named {
        add(path, "afp.toml");
    }
    if beside.is_file() {
        add(&beside, "next to the plan");
    }
    let inside = plan.with_file_name("worlds").join("world.toml");
    for like in named.iter().chain([&beside, &tidy(&inside)]) {
        files_like(like).iter().for_each(|path| add(path, "a file"));
    }
    if all.is_empty() || named.is_none() && !beside.is_file() {
        all.insert(0, (String::new(), "built in"));
    }
    if robot.made_up_world(1).is_some() {
        all.push((format!("{RANDOM}1"), "generated"));
    }
    Ok(all)
}

/// The files in the folder of a world with the same extension, by name.
fn files_like(world: &Path) -> Vec<PathBuf> {
    let Some(Ok(entries)) = world.parent().map(fs::read_dir) else { return Vec::new() };
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let mut alike: Vec<_> = paths.filter(|path| path.extension() == world.extension()).collect();
    alike.sort();
    alike
}

/// The default path of a plan's world.
fn beside(plan: &Path) -> PathBuf {
    let folder = match plan.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let file = Path::new("worlds").join(plan.file_name().unwrap_or_default());
    folder.join("..").join(file).with_extension("toml")
}

/// `plans/../worlds/x.toml` as `worlds/x.toml`, if the folder is a plain name.
fn tidy(path: &Path) -> PathBuf {
    let mut tidy = PathBuf::new();
    for part in path.components() {
        let plain = matches!(tidy.components().next_back(), Some(std::path::Component::Normal(_)));
        match part {
            std::path::Component::ParentDir if plain => {
                tidy.pop();
            }
            other => tidy.push(other),
        }
    }
    tidy
}

fn load(path: &Path, robot: &dyn AnyRobot) -> Result<LoadedWorld, RunError> {
    if let Some(seed) = path.to_str().and_then(|name| name.strip_prefix(RANDOM)) {
        let wrong =
            |why: &str, help: &str| RunError::usage(format!("'{RANDOM}{seed}': {why}"), help);
        let number = seed.parse().map_err(|_| {
            wrong("the seed of a world is a whole number from 0 on", "such as 'random:7'")
        })?;
        let text = robot.made_up_world(number);
        let none = || wrong("this robot has no random worlds", "name a file");
        return parse(text.ok_or_else(none)?, Some(path.to_owned()), &stem(path), robot);
    }
    let text = read_text(path).map_err(RunError::file(NO_WORLD, path))?;
    if path.extension().is_some_and(|extension| extension == "yaml" || extension == "yml") {
        return parse(map(path, text, robot)?, Some(path.to_owned()), &stem(path), robot);
    }
    parse(text, Some(path.to_owned()), &stem(path), robot)
}

/// The default name of a world, from its file.
fn stem(path: &Path) -> Cow<'_, str> {
    path.file_stem().unwrap_or_default().to_string_lossy()
}

/// The text of the world of a map, with its picture.
fn map(path: &Path, yaml: String, robot: &dyn AnyRobot) -> Result<String, RunError> {
    let wrong = || RunError::content(path, &*yaml);
    let picture = path.with_file_name(robot.picture_of_map(&yaml).map_err(wrong())?);
    let bytes =
        read_file(&picture, LONGEST_PICTURE).map_err(|error| no_picture(&picture, path, error))?;
    robot.text_of_map(&stem(path), &yaml, &bytes).map_err(wrong())
}

/// The error for a picture that cannot be read, at the map that names it.
fn no_picture(picture: &Path, map: &Path, error: std::io::Error) -> RunError {
    let message = format!("cannot read the map's picture '{}': {error}", picture.display());
    let help = format!(
        "check 'image' in '{}'; its path is relative to the folder of that file",
        map.display()
    );
    RunError::Missing { message, help }
}

/// Reads the text of a world. `path` names it in errors; `name` is its default name.
///
/// # Errors
/// The first mistake.
pub(crate) fn parse(
    text: String,
    path: Option<PathBuf>,
    name: &str,
    robot: &dyn AnyRobot,
) -> Result<LoadedWorld, RunError> {
    match robot.world(&text) {
        Ok(world) => Ok(LoadedWorld { world: named(world, name), text, path, start: None }),
        Err(error) => Err(RunError::content(path.unwrap_or_else(|| BUILT_IN.into()), text)(error)),
    }
}

#[cfg(test)]
mod tests {
    use afp_session::kind;
    use afp_sim::{Simulation, World};

    use super::*;

    fn typed(loaded: &LoadedWorld) -> World {
        loaded.world.as_any().downcast_ref::<World>().unwrap().clone()
    }

    #[test]
    fn an_invalid_seed_is_not_a_file() {
        let plan = Path::new("plan.afp");
        for wrong in ["random:-1", "random:", "random:1.5"] {
            let error = find(Some(Path::new(wrong)), plan, &kind::<Simulation>()).unwrap_err();
            assert!(error.to_string().contains("a whole number from 0 on"), "{error}");
        }
    }

    #[test]
    fn the_list_of_worlds_has_the_projects_and_the_plans_worlds() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        for name in ["plans", "worlds", "rooms"] {
            fs::create_dir(path(name)).unwrap();
        }
        for name in
            ["worlds/p.toml", "worlds/other.toml", "worlds/notes.md", "rooms/a.txt", "rooms/b.txt"]
        {
            fs::write(path(name), "").unwrap();
        }
        let told = |plan: &str| {
            let all = all(&path(plan), &kind::<Simulation>()).unwrap();
            let base = folder.path().display().to_string();
            let each = all.into_iter().map(|(name, from)| {
                format!("{} ({from})", name.strip_prefix(&format!("{base}/")).unwrap_or(&name))
            });
            each.collect::<Vec<_>>().join(", ")
        };
        let files = "worlds/other.toml (a file)";
        assert_eq!(
            told("plans/p.afp"),
            format!("worlds/p.toml (next to the plan), {files}, random:1 (generated)")
        );
        assert_eq!(
            told("plans/q.afp"),
            format!(" (built in), {files}, worlds/p.toml (a file), random:1 (generated)")
        );
        fs::write(path("afp.toml"), "[run]\nworld = \"rooms/b.txt\"\n").unwrap();
        assert_eq!(
            told("plans/p.afp"),
            format!(
                "rooms/b.txt (afp.toml), worlds/p.toml (next to the plan), rooms/a.txt (a file), {files}, random:1 (generated)"
            )
        );
    }

    #[test]
    fn a_world_may_be_random_or_a_map_with_a_picture() {
        let room = find(Some(Path::new("random:7")), Path::new("plan.afp"), &kind::<Simulation>())
            .unwrap();
        assert_eq!(typed(&room), World::random(7));
        let folder = tempfile::tempdir().unwrap();
        let yaml = folder.path().join("hall.yaml");
        let text = "image: hall.pgm\nresolution: 1\norigin: [-1.5, -1.5, 0]\noccupied_thresh: 0.6\nfree_thresh: 0.2\nnegate: 0\n";
        fs::write(&yaml, text).unwrap();
        let missing = find(Some(&yaml), Path::new("plan.afp"), &kind::<Simulation>())
            .unwrap_err()
            .to_string();
        assert!(
            missing.contains("hall.pgm") && missing.contains("the folder of that file"),
            "{missing}"
        );
        fs::write(folder.path().join("hall.pgm"), "P2 4 4 1\n0 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1")
            .unwrap();
        let map = find(Some(&yaml), Path::new("plan.afp"), &kind::<Simulation>()).unwrap();
        assert_eq!((map.world.name(), typed(&map).obstacles.len()), ("hall", 1));
    }
}
