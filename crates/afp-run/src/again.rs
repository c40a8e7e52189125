use std::path::{Path, PathBuf};

use afp_core::Instant;
use afp_core::trace::TraceHash;
use afp_session::{AnyRobot, Build, Recipe, TextFile};

use crate::Program;
use crate::error::RunError;
use crate::run::HARDWARE;
use crate::stderr::warn;
use crate::world::{self, LoadedWorld};

pub(crate) struct Again {
    /// Its log.
    pub(crate) path: PathBuf,
    pub(crate) recipe: Recipe,
    /// The hash of its trace; `None` if the log is incomplete.
    trace: Option<String>,
}

impl Again {
    /// Reads a log.
    ///
    /// # Errors
    /// The log cannot be read, or lacks the plan or the world.
    pub(crate) fn read(path: &Path) -> Result<Self, RunError> {
        let log = afp_log::read(path)?;
        let recipe = log.recipe();
        if recipe.robot == HARDWARE {
            let message = format!(
                "'{}' is the log of a real robot, which cannot be repeated",
                path.display()
            );
            return Err(RunError::usage(message, "name the log of a simulated run"));
        }
        if recipe.plan.is_empty() || !log.has_world() {
            let message = format!("'{}' names no plan or no world", path.display());
            return Err(RunError::usage(message, "name the log of a run"));
        }
        if let Some(cut) = &log.cut_short {
            warn(&format!("'{}' is incomplete: {cut}", path.display()));
        }
        Ok(Again { path: path.to_owned(), recipe, trace: log.trace().map(str::to_owned) })
    }

    /// The world of the run.
    ///
    /// # Errors
    /// The robot cannot read the world.
    pub(crate) fn world(&self, robot: &dyn AnyRobot) -> Result<LoadedWorld, RunError> {
        let TextFile { name, text } = &self.recipe.world;
        let world = world::parse(text.clone(), Some(self.path.clone()), name, robot)?;
        let Some(start) = self.recipe.start else { return Ok(world) };
        world.started_at(start).map_err(RunError::content(&self.path, ""))
    }

    /// Whether the log has this trace.
    pub(crate) fn has(&self, trace: TraceHash) -> bool {
        self.trace.as_ref().is_some_and(|logged| *logged == trace.to_string())
    }

    /// Compares this run with that of the log. `requests` counts the requests from outside.
    ///
    /// # Errors
    /// The plans are the same, but the traces differ.
    pub(crate) fn compare(
        &self,
        program: &Program<'_>,
        until: Option<Instant>,
        requests: usize,
        trace: TraceHash,
    ) -> Result<(), RunError> {
        let (texts, toolboxes) = program.text_files();
        // Logs of Python hold only the toolboxes that their plan uses.
        let is_another = |old: &TextFile| {
            toolboxes.iter().any(|new| new.name == old.name && new.text != old.text)
        };
        let differs = [
            (self.recipe.build.differs(&Build::this()), "another build of afp"),
            (texts != self.recipe.texts, "another text of the plan"),
            (self.recipe.toolboxes.iter().any(is_another), "another text of a toolbox"),
            (until != self.recipe.until, "another end"),
            (requests != self.recipe.requests.len(), "something else that came from outside"),
        ];
        let differs: Vec<_> = differs.iter().filter(|it| it.0).map(|it| it.1).collect();
        let path = self.path.display();
        if self.recipe.build.differs(&Build::this()) {
            let (old, new) = (&self.recipe.build, Build::this());
            warn(&format!("'{path}' was made by afp {old}, this is afp {new}"));
        }
        let Some(logged) = &self.trace else { return Ok(()) };
        let now = trace.to_string();
        let said = format!("the trace is {now}, that of '{path}' is {logged}");
        match (self.has(trace), differs.is_empty()) {
            (true, _) => Ok(()),
            (false, true) => Err(RunError::Differs {
                message: format!("the run did not repeat: {said}"),
                help: "a component uses a clock, a random number or a file of its own".to_owned(),
            }),
            (false, false) => {
                warn(&format!("{said}: the log has {}", differs.join(" and ")));
                Ok(())
            }
        }
    }
}
