//! A run as data, complete enough to repeat it.

use std::fmt;

use afp_core::Instant;

use crate::any::AnySession;
use crate::request::RequestError;
use crate::sample::Pose2;
use crate::stimulus::Stimulus;

/// The data to repeat a run. A log holds one; the same build makes the same trace from it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recipe {
    /// The name of the plan.
    pub plan: String,
    /// The path of the plan's file, as given.
    pub file: String,
    /// The text of the plan's file, then of the files that it uses. The paths are relative to a
    /// common folder.
    pub texts: Vec<TextFile>,
    /// The texts of the project's toolboxes, by name; built-in toolboxes belong to the build.
    pub toolboxes: Vec<TextFile>,
    /// The text of the project file; empty without a project.
    pub project: String,
    /// The kind of robot.
    pub robot: String,
    /// The world, by name; its text contains the values that were changed for the run.
    pub world: TextFile,
    /// The start of the robot, if it differs from that of the world.
    pub start: Option<Pose2>,
    /// The seed of all noise.
    pub seed: u64,
    /// The measures that judge the run.
    pub measures: Vec<String>,
    /// Settings from before the start as written, for people only: the requests set the entries,
    /// and the world's text contains the rest.
    pub settings: Vec<(String, String)>,
    /// The time limit of the plan.
    pub until: Option<Instant>,
    /// The requests from outside, in the order in which they were made.
    pub requests: Vec<(Instant, Stimulus)>,
    /// The build that ran it.
    pub build: Build,
}

/// A text and its name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TextFile {
    /// Its path or name.
    pub name: String,
    /// The text.
    pub text: String,
}

/// The build of the program that ran a plan.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Build {
    /// The version.
    pub version: String,
    /// The commit of the sources, if known.
    pub commit: Option<String>,
}

/// A request of a recipe that its session refuses.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("'{what}' at {} s: {why}", .at.as_secs_f64())]
pub struct RecipeError {
    /// The time of the request.
    pub at: Instant,
    /// The request.
    pub what: Box<Stimulus>,
    /// The reason.
    #[source]
    pub why: RequestError,
}

impl Recipe {
    /// The kind of a robot in a simulator.
    pub const SIMULATED: &'static str = "sim";

    /// Makes all requests of the recipe in a session that has not started.
    ///
    /// # Errors
    /// The first request that the plan or robot refuses: they are not those of the recipe.
    pub fn ask(&self, session: &mut dyn AnySession) -> Result<(), RecipeError> {
        for (at, what) in &self.requests {
            let request = what.request(session.devices(), session.names());
            let asked = request.and_then(|request| session.at(*at, request));
            asked.map_err(|why| RecipeError { at: *at, what: Box::new(what.clone()), why })?;
        }
        Ok(())
    }
}

impl Build {
    /// The build of this program.
    pub fn this() -> Build {
        let commit = option_env!("AFP_COMMIT").filter(|commit| !commit.is_empty());
        Build { version: env!("CARGO_PKG_VERSION").to_owned(), commit: commit.map(str::to_owned) }
    }

    /// Whether the builds differ, as far as both are known.
    pub fn differs(&self, other: &Build) -> bool {
        let commits = self.commit.as_ref().zip(other.commit.as_ref());
        self.version != other.version || commits.is_some_and(|(mine, other)| mine != other)
    }
}

impl fmt::Display for Build {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.version)?;
        self.commit.as_ref().map_or(Ok(()), |commit| write!(f, " ({commit})"))
    }
}
