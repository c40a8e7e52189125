//! Which scenarios are meant.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use afp_dsl::files::read_text_file;
use afp_project::ProjectFile;
use afp_run::RunError;
use afp_syntax::has_scenario;

/// Where a project keeps scenarios.
const FOLDERS: &[&str] = &["plans", "tests", "scenarios"];
/// Where the logs of failed ones go.
const LOGS: &str = "target/afp/tests";

/// Files to look into and words that names contain.
pub(super) struct Wanted {
    pub files: Vec<PathBuf>,
    pub filters: Vec<String>,
}

/// Tells files from words.
pub(super) fn wanted(arguments: &[String]) -> Result<Wanted, RunError> {
    let mut wanted = Wanted { files: Vec::new(), filters: Vec::new() };
    for argument in arguments {
        let path = Path::new(argument);
        if path.is_dir() {
            below(path, true, &mut wanted.files)?;
        } else if path.exists() || argument.ends_with(".afp") {
            wanted.files.push(path.to_owned());
        } else {
            wanted.filters.push(argument.clone());
        }
    }
    let named = arguments.len() > wanted.filters.len();
    if !named {
        let project = ProjectFile::find(Path::new("."))?;
        let home = afp_project::shown(&project.folder);
        below(&home, false, &mut wanted.files)?;
        for folder in FOLDERS.iter().map(|name| home.join(name)).filter(|path| path.is_dir()) {
            below(&folder, true, &mut wanted.files)?;
        }
    }
    let mut known = HashSet::new();
    wanted.files.retain(|file| known.insert(file.canonicalize().unwrap_or_else(|_| file.clone())));
    Ok(wanted)
}

/// The files with scenarios in a folder, sorted.
fn below(folder: &Path, deep: bool, files: &mut Vec<PathBuf>) -> Result<(), RunError> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let read = fs::read_dir(folder).map_err(RunError::file("cannot read the folder", folder))?;
    let mut paths: Vec<_> = read.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.sort();
    for path in paths {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() && deep && !name.starts_with('.') && name != "target" {
            below(&path, true, files)?;
        } else if name.ends_with(".afp") && has_scenarios(&path) {
            files.push(path.strip_prefix(".").unwrap_or(&path).to_owned());
        }
    }
    Ok(())
}

/// Whether a file has a scenario; the compiler will know why one cannot be read.
fn has_scenarios(path: &Path) -> bool {
    read_text_file(path).map_or(true, |text| has_scenario(&text))
}

/// Why there is nothing to run.
pub(super) fn nothing(filters: &[String], files: &[PathBuf]) -> RunError {
    match (filters, files) {
        ([], []) => RunError::usage(
            "there are no scenarios here",
            "write some into plans/, tests/ or scenarios/, or name a file",
        ),
        ([], [file, ..]) => RunError::usage(
            format!("'{}' has no scenarios", file.display()),
            "add one: 'scenario \"...\" for Plan { ... }'",
        ),
        (filters, _) => RunError::usage(
            format!("no scenario has '{}' in its name", filters.join("' or '")),
            "'afpc test' without words runs all of them",
        ),
    }
}

/// Where the log of a failed scenario goes; `None` where there can be none.
pub(super) fn log_of(file: &Path, name: &str) -> Option<PathBuf> {
    fs::create_dir_all(LOGS).ok()?;
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
    let name: String = name.chars().map(plain).collect();
    Some(Path::new(LOGS).join(format!("{stem}.{name}.mcap")))
}
