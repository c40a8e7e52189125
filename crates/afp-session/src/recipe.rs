//! A whole run as data: all that it takes to repeat it.

use std::fmt;

use afp_core::Instant;

use crate::any::AnySession;
use crate::request::RequestError;
use crate::sample::Pose2;
use crate::stimulus::Stimulus;

/// All that it takes to repeat a run. Logs hold one; the same build makes the same trace of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recipe {
    /// The name of the plan.
    pub plan: String,
    /// The plan's file, as it was named.
    pub file: String,
    /// The texts of the plan's file, then of those that it uses, by paths from a folder that all of them are in.
    pub texts: Vec<TextFile>,
    /// The texts of the toolboxes of the plan's project, by their names; built-in ones belong to the build.
    pub toolboxes: Vec<TextFile>,
    /// The kind of robot.
    pub robot: String,
    /// The world, by its name; a value that was changed for the run stands in the text.
    pub world: TextFile,
    /// Where the robot starts instead of where the world says.
    pub start: Option<Pose2>,
    /// The seed of all noise.
    pub seed: u64,
    /// The measures that judge the run.
    pub measures: Vec<String>,
    /// What was set before the start as it was written, for people: the requests have the entries, the world's text
    /// the rest.
    pub settings: Vec<(String, String)>,
    /// When the plan is stopped at the latest.
    pub until: Option<Instant>,
    /// What came from outside, in the order in which it was asked for.
    pub requests: Vec<(Instant, Stimulus)>,
    /// What ran it.
    pub build: Build,
}

/// A text and what it is called.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TextFile {
    /// Its path or its name.
    pub name: String,
    /// The text.
    pub text: String,
}

/// What ran a plan.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Build {
    /// The version.
    pub version: String,
    /// The commit of the sources, where it is known.
    pub commit: Option<String>,
}

/// A request of a recipe that its session cannot take.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("'{what}' at {} s: {why}", .at.as_secs_f64())]
pub struct RecipeError {
    /// When it was to come.
    pub at: Instant,
    /// What.
    pub what: Box<Stimulus>,
    /// Why not.
    #[source]
    pub why: RequestError,
}

impl Recipe {
    /// The kind of a robot in a simulator.
    pub const SIMULATED: &'static str = "sim";

    /// Asks a session that has not started for all that came from outside.
    ///
    /// # Errors
    /// The first request that its plan or robot cannot take: they are not those of the recipe.
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
    /// What this is when nobody says more.
    pub fn this() -> Build {
        let commit = option_env!("AFP_COMMIT").filter(|commit| !commit.is_empty());
        Build { version: env!("CARGO_PKG_VERSION").to_owned(), commit: commit.map(str::to_owned) }
    }

    /// Whether it is another one, as far as is known of both.
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
