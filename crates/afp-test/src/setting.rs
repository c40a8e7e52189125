//! The world of a scenario.

use std::path::{Path, PathBuf};

use afp_dsl::scenario::Scenario;
use afp_project::ProjectFile;
use afp_run::RunError;
use afp_run::world::{self, LoadedWorld};
use afp_session::{AnyRobot, Pose2};

/// The world of a scenario, with the robot at its start.
#[derive(Clone, Debug)]
pub struct Setting {
    /// The world with its text.
    pub world: LoadedWorld,
}

impl Setting {
    /// Finds the world of a scenario in `file`: its named world, relative to the file's folder or
    /// to the folder of `afp.toml`, or by default the world of its plan.
    ///
    /// # Errors
    /// The world is missing or invalid, or the robot would start in an obstacle.
    pub fn find(
        scenario: &Scenario,
        file: &Path,
        robot: &dyn AnyRobot,
    ) -> Result<Setting, RunError> {
        let mut found = match &scenario.world {
            Some(written) => world::find(Some(&place(written, file)?), file, robot)?,
            None => world::find(None, Path::new(&scenario.plan_file), robot)?,
        };
        if let Some(start) = scenario.robot {
            let pose = Pose2 { x: start.x, y: start.y, heading: start.heading };
            found = found.started_at(pose).map_err(|what| {
                let message = format!("'{}': {what}", scenario.name);
                RunError::usage(message, "change the line 'robot at ...'")
            })?;
        }
        Ok(Setting { world: found })
    }
}

/// Finds the file of a world named in a scenario.
fn place(written: &str, file: &Path) -> Result<PathBuf, RunError> {
    if written.starts_with(world::RANDOM) {
        return Ok(PathBuf::from(written));
    }
    let beside = file.parent().unwrap_or(Path::new("")).join(written);
    if beside.is_file() {
        return Ok(beside);
    }
    let project = ProjectFile::of_plan(file)?;
    let above = afp_project::shown(&project.folder.join(written));
    Ok(if above.is_file() { above } else { beside })
}
