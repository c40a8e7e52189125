//! From a file's name to a checked plan.

use std::path::{Path, PathBuf};

use afp_dsl::files::{Disk, Files, read_text};
use afp_dsl::graph::Graph;
use afp_dsl::{Compiled, compile_plan};
use afp_log::LogData;
use afp_project::Robot;
use afp_run::RunError;
use afp_session::{Recipe, TextFile};
use afp_syntax::source::Source;
use afp_toolboxes::project::OwnToolboxes;
use clap::Args;

use crate::nearby::unreadable;
use crate::no_plan::NoPlan;
use crate::reader::Reader;

/// A plan to work on.
#[derive(Args, Clone, Debug)]
pub struct PlanArgument {
    /// File with the plan; append ':Plan' to select a plan other than the first
    #[arg(value_name = "FILE[:PLAN]")]
    pub plan: String,
}

/// A compiled plan.
pub struct PlanFile {
    /// The file name from the command line.
    pub path: PathBuf,
    /// The compiler's result.
    pub compiled: Compiled,
    /// The project of the file, and its toolboxes.
    pub own: OwnToolboxes,
    /// The used toolboxes whose sources are only in a log: from Python or from another project.
    pub foreign: Vec<String>,
    /// The robot of a log's project, if the project is not here.
    pub robot: Option<Robot>,
}

/// The text of a file, read once because the file may be a pipe.
pub struct PlanText<'a> {
    /// The file name from the command line.
    pub path: PathBuf,
    /// The contents.
    pub text: String,
    /// The selected plan; the first plan if `None`.
    pub plan: Option<&'a str>,
}

impl PlanText<'_> {
    /// Reads `FILE` or `FILE:Plan`.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn read(argument: &str) -> Result<PlanText<'_>, RunError> {
        let (path, plan) = split(argument);
        PlanText::read_at(path, plan)
    }

    /// Reads a file and selects one of its plans.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn read_at(path: PathBuf, plan: Option<&str>) -> Result<PlanText<'_>, RunError> {
        let text = read_text(&path).map_err(unreadable(&path))?;
        Ok(PlanText { path, text, plan })
    }

    /// Compiles the plan.
    ///
    /// # Errors
    /// The project file or a toolbox cannot be read, or is invalid.
    pub fn compile(self) -> Result<PlanFile, RunError> {
        let source = Source::new(self.path.display().to_string(), self.text);
        PlanFile::compile_with((self.path, &source), &Disk::default(), self.plan, None)
    }
}

impl PlanFile {
    /// Reads and compiles `FILE` or `FILE:Plan`.
    ///
    /// # Errors
    /// A file cannot be read.
    pub fn read(argument: &str) -> Result<PlanFile, RunError> {
        PlanText::read(argument)?.compile()
    }

    /// The plan of a log, from the sources in the log, or else from the plan's file.
    ///
    /// # Errors
    /// The log names no plan, or its file cannot be read.
    pub fn of_log(log: &LogData, at: &Path) -> Result<PlanFile, RunError> {
        let recipe = log.recipe();
        let Recipe { plan, file, texts, .. } = &recipe;
        if file.is_empty() {
            return Err(RunError::usage(
                "the log does not name the plan of its run",
                "name a complete log",
            ));
        }
        let path = path_of_log(log, at);
        let Some(first) = texts.first() else {
            return PlanFile::read(&format!("{}:{plan}", path.display()));
        };
        let read = |path: &str| {
            let found = texts.iter().find(|known| known.name == path);
            found.map(|it| it.text.clone()).ok_or_else(|| "it is not in the log".to_owned())
        };
        let source = Source::new(&first.name, &first.text);
        PlanFile::compile_with((path, &source), &read, Some(plan), Some(&recipe))
    }

    /// Compiles a plan, of a log with the toolboxes and the robot that its project may lack here.
    fn compile_with(
        (path, source): (PathBuf, &Source),
        files: &dyn Files,
        plan: Option<&str>,
        logged: Option<&Recipe>,
    ) -> Result<PlanFile, RunError> {
        let own = OwnToolboxes::of_plan(&path)?;
        let mut toolboxes = own.with_built_in()?;
        let mut foreign = Vec::new();
        for TextFile { name, text } in logged.iter().flat_map(|recipe| &recipe.toolboxes) {
            if !own.files().iter().any(|file| file.toolbox.name == *name) {
                toolboxes.add(Source::new(name, text), name);
                foreign.push(name.clone());
            }
        }
        let robot = logged.and_then(|recipe| foreign_robot(recipe, &own));
        if let Some(toolbox) = robot.as_ref().and_then(|robot| robot.toolbox.as_ref()) {
            toolboxes.set_robot(toolbox);
        }
        let compiled = compile_plan(source, &toolboxes, files, plan);
        let used = |name: &String| {
            let mut graphs = compiled.graph.iter();
            graphs.any(|graph| compiled.toolbox_texts(graph).any(|(used, _)| used == name))
        };
        foreign.retain(used);
        Ok(PlanFile { path, compiled, own, foreign, robot })
    }

    /// Reports the diagnostics.
    ///
    /// # Errors
    /// The output for tools cannot be written.
    pub fn report(&self, reader: Reader) -> Result<(), NoPlan> {
        reader.tell(&self.compiled.diags, &self.compiled.sources)
    }

    /// Reports the diagnostics to people, and returns the graph.
    ///
    /// # Errors
    /// The plan has errors.
    pub fn checked(self) -> Result<(PlanFile, Graph), NoPlan> {
        self.checked_for(Reader::People)
    }

    /// Reports the diagnostics, and returns the graph.
    ///
    /// # Errors
    /// The plan has errors, the output for tools cannot be written.
    pub fn checked_for(mut self, reader: Reader) -> Result<(PlanFile, Graph), NoPlan> {
        self.report(reader)?;
        let graph = self.compiled.graph.take().ok_or(NoPlan::Wrong)?;
        Ok((self, graph))
    }
}

/// The robot of a log, unless a project is here that decides it.
fn foreign_robot(recipe: &Recipe, own: &OwnToolboxes) -> Option<Robot> {
    if own.project.exists { None } else { afp_project::read(&recipe.project).0.robot }
}

/// The plan file of a log. Its recorded path can be relative to another folder. The search includes
/// the folders around the log, and prefers a file with the recorded text.
pub fn path_of_log(log: &LogData, at: &Path) -> PathBuf {
    let Recipe { file, texts, .. } = log.recipe();
    let log = std::path::absolute(at).unwrap_or_else(|_| at.to_owned());
    let around = log.ancestors().skip(1).map(|folder| folder.join(&file));
    let found: Vec<_> =
        std::iter::once(PathBuf::from(&file)).chain(around).filter(|path| path.is_file()).collect();
    let text = texts.first().map(|first| &first.text);
    let ran = |path: &&PathBuf| read_text(path).is_ok_and(|known| Some(&known) == text);
    found.iter().find(ran).or(found.first()).cloned().unwrap_or_else(|| file.into())
}

/// Splits `FILE:Plan`; a file with the colon in its own name wins.
pub fn split(argument: &str) -> (PathBuf, Option<&str>) {
    match argument.rsplit_once(':') {
        Some((path, plan)) if !Path::new(argument).exists() && !plan.contains(['/', '\\']) => {
            (path.into(), Some(plan))
        }
        _ => (argument.into(), None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_toolboxes_of_a_log_are_found() {
        let plan = "use std\nuse mine\nplan P {\n    start a\n    actor a: Beep { Done -> terminate }\n}\n";
        let mine = "toolbox mine\nactor Beep { state Done }\n";
        let texts = [("p.afp", plan), ("toolbox/mine", mine), ("toolbox/other", "toolbox other\n")];
        let project = ("afp.toml", "[robot]\ntoolbox = \"mine\"\nsim = \"Mine\"\n");
        let texts = texts.into_iter().chain([project]);
        let facts = [("plan", "P"), ("plan_file", "/nowhere/p.afp"), ("plan_text", "p.afp")];
        let owned = |(name, text): (&str, &str)| (name.to_owned(), text.to_owned());
        let log = LogData {
            facts: facts.map(owned).into(),
            attachments: texts.map(owned).collect(),
            ..LogData::default()
        };
        let file = PlanFile::of_log(&log, Path::new("/nowhere/p.mcap")).unwrap();
        assert!(file.compiled.graph.is_some(), "{}", file.compiled.render(false));
        assert_eq!(file.foreign, ["mine"], "the plan does not use the other file");
        assert_eq!(file.robot.unwrap().sim.as_deref(), Some("Mine"));
    }
}
