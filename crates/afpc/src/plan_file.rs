//! From a file's name to a checked plan.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use afp_dsl::graph::Graph;
use afp_dsl::source::Source;
use afp_dsl::toolbox::Toolboxes;
use afp_dsl::{Compiled, compile_plan};
use afp_run::RunError;
use afp_run::settings::Settings;

/// A plan that was read and compiled.
pub struct PlanFile {
    /// The file as it was named.
    pub path: PathBuf,
    /// What became of it.
    pub compiled: Compiled,
}

/// Why there is no graph.
pub enum NoPlan {
    /// A file cannot be read.
    File(RunError),
    /// The plan is wrong; it has been said.
    Wrong,
}

impl From<RunError> for NoPlan {
    fn from(error: RunError) -> Self {
        NoPlan::File(error)
    }
}

impl PlanFile {
    /// Reads and compiles `FILE` or `FILE:Plan`.
    ///
    /// # Errors
    /// A file cannot be read.
    pub fn read(argument: &str) -> Result<PlanFile, RunError> {
        let (path, plan) = split(argument);
        let text =
            fs::read_to_string(&path).map_err(RunError::file("cannot read the plan", &path))?;
        let toolboxes = toolboxes(&path)?;
        let source = Source::new(path.display().to_string(), text);
        let compiled = compile_plan(&source, &toolboxes, &read_used, plan);
        Ok(PlanFile { path, compiled })
    }

    /// Reads and compiles, tells standard error what is wrong, and gives the graph.
    ///
    /// # Errors
    /// A file cannot be read, or the plan has errors.
    pub fn graph(argument: &str) -> Result<(PlanFile, Graph), NoPlan> {
        let mut file = PlanFile::read(argument)?;
        if !file.compiled.diags.is_empty() {
            anstream::eprintln!("{}", file.compiled.render(true));
        }
        let graph = file.compiled.graph.take().ok_or(NoPlan::Wrong)?;
        Ok((file, graph))
    }
}

/// The text of a file that a plan file uses.
fn read_used(path: &str) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| match error.kind() {
        ErrorKind::NotFound => "there is no such file".to_owned(),
        _ => error.to_string().to_lowercase(),
    })
}

/// `FILE:Plan` taken apart; a file whose own name holds the colon wins.
fn split(argument: &str) -> (PathBuf, Option<&str>) {
    match argument.rsplit_once(':') {
        Some((path, plan)) if !Path::new(argument).exists() && !plan.contains(['/', '\\']) => {
            (path.into(), Some(plan))
        }
        _ => (argument.into(), None),
    }
}

/// The built-in toolboxes and those that the project's `afp.toml` names.
fn toolboxes(plan: &Path) -> Result<Toolboxes, RunError> {
    let mut toolboxes = Toolboxes::default();
    for toolbox in afp_toolboxes::ALL {
        toolboxes.add(Source::new(toolbox.file_name, toolbox.text), toolbox.rust_path);
    }
    let folder = match plan.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let settings = Settings::find(folder)?;
    for (name, toolbox) in &settings.toolboxes {
        let path = settings.folder.join(&toolbox.path);
        let text = fs::read_to_string(&path)
            .map_err(RunError::file("cannot read the toolbox of afp.toml,", &path))?;
        let krate = toolbox.krate.as_deref().unwrap_or(name).replace('-', "_");
        toolboxes.add(Source::new(path.display().to_string(), text), &krate);
    }
    Ok(toolboxes)
}
