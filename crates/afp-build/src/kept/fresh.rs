//! Whether a runner is still what its sources say.
//!
//! Cargo writes beside each program which files of this machine it was made from. A runner is fresh
//! while none of them has changed since its build began; then cargo need not even be there.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use afp_run::RunError;

/// Names the program; its time is the beginning of the build.
const STAMP: &str = "built";

/// Marks the beginning of a build.
///
/// # Errors
/// The folder cannot be written.
pub fn begin(folder: &Path) -> Result<SystemTime, RunError> {
    let stamp = folder.join(STAMP);
    // The clock of the file system, which may be coarser than ours.
    let begin = || {
        fs::write(&stamp, "")?;
        fs::metadata(&stamp)?.modified()
    };
    begin().map_err(RunError::file("cannot write", &stamp))
}

/// Keeps what a build has made.
///
/// # Errors
/// The folder cannot be written.
pub fn done(folder: &Path, program: &Path, begun: SystemTime) -> Result<(), RunError> {
    let stamp = folder.join(STAMP);
    let keep = || {
        fs::write(&stamp, program.as_os_str().as_encoded_bytes())?;
        File::options().write(true).open(&stamp)?.set_modified(begun)
    };
    keep().map_err(RunError::file("cannot write", &stamp))
}

/// The program kept in a folder, unless something that it was made from has changed; `others` are
/// files that cargo does not list.
pub fn program(folder: &Path, others: &[PathBuf]) -> Option<PathBuf> {
    let stamp = folder.join(STAMP);
    let begun = fs::metadata(&stamp).ok()?.modified().ok()?;
    let program = PathBuf::from(fs::read_to_string(&stamp).ok()?);
    let list = fs::read_to_string(program.with_extension("d")).ok()?;
    let older = |path: &PathBuf| {
        let changed = fs::metadata(path).and_then(|about| about.modified());
        changed.is_ok_and(|changed| changed < begun)
    };
    // The folder's own files are as its name says.
    let mut sources = sources(&list).into_iter().filter(|path| !path.starts_with(folder));
    let fresh = program.is_file() && sources.all(|path| older(&path)) && others.iter().all(older);
    fresh.then_some(program)
}

/// The files behind the colon of a rule as make writes it, in which blanks in names are escaped.
fn sources(list: &str) -> Vec<PathBuf> {
    let rule = list.lines().next().and_then(|line| line.split_once(": "));
    let rule = rule.map_or("", |(_, sources)| sources);
    // A line break stands in no name that cargo lists.
    let rule = rule.replace("\\ ", "\n");
    let paths = rule.split(' ').filter(|path| !path.is_empty());
    paths.map(|path| path.replace('\n', " ").into()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn blanks_in_names_are_kept() {
        let list = "/t/a\\ b: /x/my\\ crate/lib.rs /y.rs\n\n/t/other: /z.rs\n";
        assert_eq!(sources(list), ["/x/my crate/lib.rs", "/y.rs"].map(PathBuf::from));
        assert!(sources("").is_empty());
    }

    #[test]
    fn a_program_is_fresh_until_a_source_changes_or_goes() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        fs::create_dir(path("runner")).unwrap();
        for name in ["program", "a.rs", "Cargo.toml"] {
            fs::write(path(name), "").unwrap();
        }
        let list = format!("{}: {}", path("program").display(), path("a.rs").display());
        fs::write(path("program.d"), list).unwrap();
        let found = || program(&path("runner"), &[path("Cargo.toml")]);
        assert_eq!(found(), None);
        let begun = begin(&path("runner")).unwrap() + Duration::from_secs(1);
        assert_eq!(found(), None, "the build has only begun");
        done(&path("runner"), &path("program"), begun).unwrap();
        assert_eq!(found(), Some(path("program")));
        for source in ["a.rs", "Cargo.toml"] {
            let file = File::options().write(true).open(path(source)).unwrap();
            file.set_modified(begun + Duration::from_secs(1)).unwrap();
            assert_eq!(found(), None, "{source} is newer");
            file.set_modified(begun - Duration::from_secs(1)).unwrap();
            assert_eq!(found(), Some(path("program")));
        }
        fs::remove_file(path("a.rs")).unwrap();
        assert_eq!(found(), None);
    }
}
