//! The targets that a plan is checked against: those of `afp.toml`, or the one that was named.

use std::fs;
use std::path::{Path, PathBuf};

use afp_dsl::timing::{BUILT_IN, Target, targets};
use afp_run::RunError;

/// The target of that name, from `afp.toml` or built in; without a name all that `afp.toml` has.
///
/// # Errors
/// `afp.toml` cannot be read or says something wrong; there is no such target.
pub fn choose(plan: &Path, name: Option<&str>) -> Result<Vec<Target>, RunError> {
    let own = match project_file(plan) {
        Some(path) => read(path)?,
        None => Vec::new(),
    };
    let Some(name) = name else { return Ok(own) };
    let named = own.iter().find(|target| target.name == name).cloned();
    match named.or_else(|| Target::built_in(name)) {
        Some(target) => Ok(vec![target]),
        None => {
            let names = own.iter().map(|target| target.name.as_str());
            let built_in = BUILT_IN.iter().map(|(name, ..)| *name);
            let known: Vec<_> = built_in.chain(names).map(|name| format!("'{name}'")).collect();
            let message = format!("there is no target '{name}'");
            let help =
                format!("name one of {}, or add '[target.{name}]' to afp.toml", known.join(", "));
            Err(RunError::usage(message, help))
        }
    }
}

/// The nearest `afp.toml` in the plan's folder or above it.
fn project_file(plan: &Path) -> Option<PathBuf> {
    let plan = std::path::absolute(plan).ok()?;
    let files = plan.ancestors().skip(1).map(|folder| folder.join("afp.toml"));
    files.into_iter().find(|path| path.is_file())
}

fn read(path: PathBuf) -> Result<Vec<Target>, RunError> {
    let text =
        fs::read_to_string(&path).map_err(RunError::file("cannot read the project file", &path))?;
    targets(&text).map_err(|error| {
        let before = text.get(..error.span.start).unwrap_or(&text);
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().unwrap_or("").chars().count() + 1;
        let place = Some((line, column));
        RunError::Content { path, place, message: error.message, text: text.clone() }
    })
}
