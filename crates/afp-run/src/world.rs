//! Finds the world of a run.

use std::fs;
use std::path::{Path, PathBuf};

use afp_project::{ProjectFile, shown};
use afp_sim::World;

use crate::error::RunError;

/// The room for plans that come without a world.
const ROOM: &str = include_str!("../../../worlds/wall_following.toml");

/// A world and its text.
#[derive(Clone, Debug)]
pub struct LoadedWorld {
    /// The world.
    pub world: World,
    /// The text of its file.
    pub text: String,
    /// Its file; `None` for the built-in room.
    pub path: Option<PathBuf>,
}

/// The world of a plan: the file asked for, else `[run] world` of `afp.toml`, else
/// `worlds/<plan file>.toml` beside the plan's folder, else the built-in room.
///
/// # Errors
/// A file that is named but not there; a world that says something wrong.
pub fn find(asked: Option<&Path>, plan: &Path) -> Result<LoadedWorld, RunError> {
    if let Some(path) = asked {
        return load(path);
    }
    let file = ProjectFile::of_plan(plan)?;
    if let Some(path) = &file.project.world {
        return load(&shown(&file.folder.join(path)));
    }
    let folder = match plan.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let file = Path::new("worlds").join(plan.file_name().unwrap_or_default());
    let beside = folder.join("..").join(file).with_extension("toml");
    match beside.is_file() {
        true => load(&tidy(&beside)),
        false => parse(ROOM.to_owned(), None),
    }
}

/// `plans/../worlds/x.toml` as `worlds/x.toml`, as long as the folder is a plain name.
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

fn load(path: &Path) -> Result<LoadedWorld, RunError> {
    let text = fs::read_to_string(path).map_err(RunError::file("cannot read the world", path))?;
    parse(text, Some(path.to_owned()))
}

fn parse(text: String, path: Option<PathBuf>) -> Result<LoadedWorld, RunError> {
    match World::parse(&text) {
        Ok(world) => Ok(LoadedWorld { world, text, path }),
        Err(error) => Err(RunError::Content {
            path: path.unwrap_or_else(|| "built-in room".into()),
            place: error.place,
            text,
            message: error.message,
        }),
    }
}
