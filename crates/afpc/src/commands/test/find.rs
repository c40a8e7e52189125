//! The selection of scenarios.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use afp_dsl::files::read_text_file;
use afp_project::{ProjectFile, Unread};
use afp_run::RunError;
use afp_syntax::may_have_scenario;
use afp_types::TextHash;

/// The folder for the logs of failed scenarios.
const LOGS: &str = "target/afp/tests";
/// The maximum length of file and scenario names in a log's name; file systems limit names.
const LONGEST_NAME: usize = 40;

/// Files to search, and words that names must contain.
pub(super) struct Wanted {
    pub files: Vec<PathBuf>,
    pub filters: Vec<String>,
}

pub(super) fn wanted(arguments: &[String]) -> Result<Wanted, RunError> {
    let mut wanted = Wanted { files: Vec::new(), filters: Vec::new() };
    for argument in arguments {
        let path = Path::new(argument);
        if path.is_dir() {
            wanted.files.extend(with_scenarios(afp_project::all_files(path).map_err(unread)?));
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
        let home = if home.as_os_str().is_empty() { Path::new(".") } else { &home };
        wanted.files.extend(with_scenarios(afp_project::scenario_files(home).map_err(unread)?));
    }
    let mut known = HashSet::new();
    wanted.files.retain(|file| known.insert(file.canonicalize().unwrap_or_else(|_| file.clone())));
    Ok(wanted)
}

/// The error for a folder that may contain scenarios.
fn unread((folder, error): Unread) -> RunError {
    let folder = folder.strip_prefix(".").unwrap_or(&folder);
    RunError::file("cannot read the folder", folder)(error)
}

fn with_scenarios(files: Vec<PathBuf>) -> impl Iterator<Item = PathBuf> {
    let plans = files.into_iter().filter(|path| path.extension().is_some_and(|it| it == "afp"));
    let having = plans.filter(|path| has_scenarios(path));
    having.map(|path| path.strip_prefix(".").map_or(path.clone(), Path::to_owned))
}

/// Whether a file may have a scenario; the compiler reports unreadable files.
fn has_scenarios(path: &Path) -> bool {
    read_text_file(path).map_or(true, |text| may_have_scenario(&text))
}

/// The error if there is nothing to run.
pub(super) fn nothing(filters: &[String], files: &[PathBuf]) -> RunError {
    match (filters, files) {
        ([], []) => RunError::usage(
            "no scenarios found",
            "write some into plans/, tests/ or scenarios/, or name a file",
        ),
        ([], [file, ..]) => RunError::usage(
            format!("'{}' has no scenarios", file.display()),
            "add one: 'scenario \"...\" for Plan { ... }'",
        ),
        (filters, _) => RunError::usage(
            format!("no scenario has '{}' in its name", filters.join("' or '")),
            "'afpc test' without a filter runs all scenarios",
        ),
    }
}

/// The log of a failed scenario; `None` if no log is possible.
pub(super) fn log_of(file: &Path, name: &str) -> Option<PathBuf> {
    fs::create_dir_all(LOGS).ok()?;
    Some(Path::new(LOGS).join(log_name(file, name)))
}

/// The name of a scenario's log: readable names, then a hash that makes the name unique.
fn log_name(file: &Path, name: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() || c == '-' { c } else { '_' };
    let shown = |name: &str| name.chars().map(plain).take(LONGEST_NAME).collect::<String>();
    let stem = shown(&file.file_stem().unwrap_or_default().to_string_lossy());
    let shown = shown(&name.to_lowercase());
    let mut hash = TextHash::of(&file.to_string_lossy());
    hash.add("\0");
    hash.add(name);
    // Half of the hash is enough for few scenarios.
    format!("{stem}.{shown}.{:08x}.mcap", hash.get() as u32)
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;
    use std::path::Path;

    use super::log_name;

    #[test]
    fn two_scenarios_have_different_logs() {
        let long = "a".repeat(300);
        let longer = format!("{long}b");
        let names = ["ä", "ö", "Ä", "a b", "a_b", "A b", "", "..", "a/b", "a\\b", &long, &longer];
        let files = ["p.afp", "tests/p.afp", "tests/q/p.afp"];
        let pairs = files.iter().flat_map(|file| names.iter().map(move |name| (file, name)));
        let logs = pairs.map(|(file, name)| log_name(Path::new(file), name).to_lowercase());
        let logs: HashSet<_> = logs.collect();
        assert_eq!(logs.len(), files.len() * names.len(), "{logs:?}");
        for log in logs {
            assert!(log.len() < 256 && !log.contains(['/', '\\']), "{log}");
        }
    }

    #[test]
    fn letters_of_all_languages_are_kept_in_the_name_of_a_log() {
        let log = log_name(Path::new("tests/room.afp"), "Übt, 3 mal");
        assert!(log.starts_with("room.übt__3_mal."), "{log}");
    }
}
