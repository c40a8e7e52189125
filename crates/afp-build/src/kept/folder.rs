//! The folders for runners and their builds.
//!
//! Projects share the dependencies of their runners, so all projects use one place.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use afp_run::RunError;

/// A project's folder for runners if no other folder is writable.
const IN_PROJECT: &str = "target/afp";

#[derive(Debug, PartialEq)]
pub struct Folder {
    /// The folder for the crates of runners.
    pub kept: PathBuf,
    /// Cargo's build folder for them.
    pub build: PathBuf,
}

/// The first of these in which the folder `below` can be created: cargo's folder from
/// `CARGO_TARGET_DIR`, the user's cache, `target/afp` of the project.
///
/// # Errors
/// None of them is writable.
pub fn find(project: &Path, below: &Path) -> Result<Folder, RunError> {
    first(candidates(project, &variable), below)
}

/// AFP's folder in the user's cache; `None` if no variable defines it.
pub fn cache() -> Option<PathBuf> {
    cache_of(&variable)
}

fn cache_of(variable: &dyn Fn(&str) -> Option<PathBuf>) -> Option<PathBuf> {
    let cache = variable("XDG_CACHE_HOME").or_else(|| Some(variable("HOME")?.join(".cache")))?;
    Some(whole(cache).join("afp"))
}

fn variable(name: &str) -> Option<PathBuf> {
    env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from)
}

fn whole(path: PathBuf) -> PathBuf {
    std::path::absolute(&path).unwrap_or(path)
}

/// The first folder that can be created.
fn first(all: Vec<Folder>, below: &Path) -> Result<Folder, RunError> {
    let mut refused = RunError::usage("there is no folder for a runner", "set CARGO_TARGET_DIR");
    for folder in all {
        let path = folder.kept.join(below);
        match fs::create_dir_all(&path) {
            Ok(()) => return Ok(folder),
            Err(error) => refused = RunError::file("cannot make the folder", &path)(error),
        }
    }
    Err(refused)
}

/// The candidate folders, the best first.
fn candidates(project: &Path, variable: &dyn Fn(&str) -> Option<PathBuf>) -> Vec<Folder> {
    let with_build = |kept: PathBuf| Folder { build: kept.join("build"), kept };
    if let Some(target) = variable("CARGO_TARGET_DIR").map(whole) {
        return vec![Folder { kept: target.join("afp"), build: target }];
    }
    let cache = cache_of(variable).map(with_build);
    cache.into_iter().chain([with_build(whole(project.join(IN_PROJECT)))]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cargos_folder_counts_then_the_cache_then_the_project() {
        let found = |set: &[(&str, &str)]| {
            let variable = |name: &str| {
                let value = set.iter().find(|(known, _)| *known == name);
                value.map(|(_, value)| PathBuf::from(value))
            };
            let all = candidates(Path::new("/p"), &variable);
            all.into_iter().map(|folder| [folder.kept, folder.build]).collect::<Vec<_>>()
        };
        let paths = |kept: &str, build: &str| [kept, build].map(PathBuf::from);
        let project = paths("/p/target/afp", "/p/target/afp/build");
        let target = ("CARGO_TARGET_DIR", "/t");
        assert_eq!(found(&[target, ("HOME", "/h")]), [paths("/t/afp", "/t")]);
        let cache = paths("/h/.cache/afp", "/h/.cache/afp/build");
        assert_eq!(found(&[("HOME", "/h")]), [cache, project.clone()]);
        let cache = paths("/c/afp", "/c/afp/build");
        assert_eq!(found(&[("HOME", "/h"), ("XDG_CACHE_HOME", "/c")]), [cache, project.clone()]);
        assert_eq!(found(&[]), [project]);
    }

    #[test]
    fn an_unwritable_folder_is_skipped() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "").unwrap();
        let at = |kept: &Path| Folder { kept: kept.to_owned(), build: kept.join("build") };
        let below = Path::new("runner/x");
        let found = first(vec![at(&file), at(folder.path())], below).unwrap();
        assert_eq!(found, at(folder.path()));
        assert!(folder.path().join(below).is_dir());
        let refused = first(vec![at(&file)], below).unwrap_err().to_string();
        assert!(refused.starts_with("error: cannot make the folder"), "{refused}");
    }
}
