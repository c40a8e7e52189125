//! Finds the world of a run.

pub mod change;

use std::fs;
use std::path::{Path, PathBuf};

use afp_project::{ProjectFile, shown};
use afp_sim::{World, WorldError};

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

/// What asks for a room made up instead of a file, before the seed.
const RANDOM: &str = "random:";

/// The world of a plan: the file asked for, which may also be a map (`.yaml`) or `random:SEED`, else `[run] world` of `afp.toml`, else
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
    let seed = path.to_str().and_then(|name| name.strip_prefix(RANDOM));
    if let Some(seed) = seed.and_then(|seed| seed.parse().ok()) {
        return parse(World::random_text(seed), Some(path.to_owned()));
    }
    let text = fs::read_to_string(path).map_err(RunError::file("cannot read the world", path))?;
    if path.extension().is_some_and(|extension| extension == "yaml" || extension == "yml") {
        return parse(map(path, text)?, Some(path.to_owned()));
    }
    parse(text, Some(path.to_owned()))
}

/// The text of the world of a map, with the picture that lies beside it.
fn map(path: &Path, yaml: String) -> Result<String, RunError> {
    let wrong = |error: WorldError| RunError::Content {
        path: path.to_owned(),
        span: error.span,
        text: yaml.clone(),
        message: error.message,
    };
    let picture = path.with_file_name(World::map_picture(&yaml).map_err(wrong)?);
    let bytes =
        fs::read(&picture).map_err(RunError::file("cannot read the map's picture", &picture))?;
    let name = path.file_stem().map(|name| name.to_string_lossy()).unwrap_or_default();
    World::map_text(&name, &yaml, &bytes).map_err(wrong)
}

fn parse(text: String, path: Option<PathBuf>) -> Result<LoadedWorld, RunError> {
    match World::parse(&text) {
        Ok(world) => Ok(LoadedWorld { world, text, path }),
        Err(error) => Err(RunError::Content {
            path: path.unwrap_or_else(|| "built-in room".into()),
            span: error.span,
            text,
            message: error.message,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_world_may_be_made_up_or_a_map_with_a_picture_beside_it() {
        let room = find(Some(Path::new("random:7")), Path::new("plan.afp")).unwrap();
        assert_eq!(room.world, World::random(7));
        let folder = tempfile::tempdir().unwrap();
        let yaml = folder.path().join("hall.yaml");
        let text =
            "image: hall.pgm\nresolution: 1\norigin: [-1.5, -1.5, 0]\noccupied_thresh: 0.6\n";
        fs::write(&yaml, text).unwrap();
        let missing = find(Some(&yaml), Path::new("plan.afp")).unwrap_err().to_string();
        assert!(missing.contains("hall.pgm"), "{missing}");
        fs::write(folder.path().join("hall.pgm"), "P2 4 4 1\n0 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1")
            .unwrap();
        let map = find(Some(&yaml), Path::new("plan.afp")).unwrap();
        assert_eq!((map.world.name.as_str(), map.world.obstacles.len()), ("hall", 1));
    }
}
