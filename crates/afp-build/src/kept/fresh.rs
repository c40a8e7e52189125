//! Whether a runner is still up to date.
//!
//! Cargo writes a list of source files next to each program, and reports a build's packages on this
//! machine. A runner is up to date if its own crate, those files and the other influences on its
//! build have not changed since its build began. Then cargo is not needed at all.

use std::collections::BTreeSet;
use std::env;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use afp_run::RunError;

/// The file with the program's path; its time is the beginning of the build.
const STAMP: &str = "built";
/// The file with the result of [`watched`], one path per line.
const WATCHED: &str = "watched";
/// The manifest of a package, or of its workspace, which it may inherit from.
const MANIFEST: &str = "Cargo.toml";
/// Cargo's settings for everything below a folder.
const SETTINGS: [&str; 4] =
    [".cargo/config.toml", ".cargo/config", "rust-toolchain.toml", "rust-toolchain"];

/// Records the beginning of a build.
///
/// # Errors
/// The folder cannot be written.
pub fn begin(folder: &Path) -> Result<SystemTime, RunError> {
    let stamp = folder.join(STAMP);
    // The clock of the file system may be coarser than ours.
    let begin = || {
        fs::write(&stamp, "")?;
        fs::metadata(&stamp)?.modified()
    };
    begin().map_err(RunError::file("cannot write", &stamp))
}

/// Records a build's result.
///
/// # Errors
/// The folder cannot be written.
pub fn done(
    folder: &Path,
    program: &Path,
    watched: &BTreeSet<PathBuf>,
    begun: SystemTime,
) -> Result<(), RunError> {
    let (stamp, list) = (folder.join(STAMP), folder.join(WATCHED));
    let paths = watched.iter().map(|path| format!("{}\n", path.display()));
    fs::write(&list, paths.collect::<String>()).map_err(RunError::file("cannot write", &list))?;
    let keep = || {
        fs::write(&stamp, program.as_os_str().as_encoded_bytes())?;
        File::options().write(true).open(&stamp)?.set_modified(begun)
    };
    keep().map_err(RunError::file("cannot write", &stamp))
}

/// The influences on a build other than its packages' manifests.
pub struct Around<'a> {
    /// Cargo's working folder.
    pub caller: &'a Path,
    /// The tested versions, if there are any.
    pub lock: Option<PathBuf>,
}

/// The existing files that influence how packages are built: their manifests and those around them,
/// cargo's settings in its working folder, and the tested versions.
pub fn watched(manifests: &[PathBuf], around: &Around<'_>) -> BTreeSet<PathBuf> {
    let home = env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| Some(PathBuf::from(env::var_os("HOME")?).join(".cargo")));
    let of_home =
        home.iter().flat_map(|home| ["config.toml", "config"].map(|name| home.join(name)));
    let mut all: BTreeSet<_> = of_home.collect();
    all.extend(around.lock.clone());
    all.extend(around.caller.ancestors().flat_map(|folder| SETTINGS.map(|name| folder.join(name))));
    let packages: BTreeSet<_> =
        manifests.iter().flat_map(|path| path.ancestors().skip(1)).collect();
    all.extend(packages.into_iter().map(|folder| folder.join(MANIFEST)));
    all.into_iter().filter(|path| path.is_file()).collect()
}

/// The program in a folder, unless one of its sources has changed; `files` are those of its crate.
pub fn program(folder: &Path, around: &Around<'_>, files: &[(String, String)]) -> Option<PathBuf> {
    let stamp = folder.join(STAMP);
    let begun = fs::metadata(&stamp).ok()?.modified().ok()?;
    let program = PathBuf::from(fs::read_to_string(&stamp).ok()?);
    let list = fs::read_to_string(program.with_extension("d")).ok()?;
    let older = |path: &PathBuf| {
        let changed = fs::metadata(path).and_then(|about| about.modified());
        changed.is_ok_and(|changed| changed < begun)
    };
    let sources = sources(&list);
    let of_others = sources.iter().filter(|path| !path.starts_with(folder));
    let kept = fs::read_to_string(folder.join(WATCHED)).ok()?;
    let kept: BTreeSet<_> = kept.lines().map(PathBuf::from).collect();
    let manifests = kept.iter().filter(|path| path.ends_with(MANIFEST)).cloned();
    let is_written = |(name, text): &(String, String)| {
        fs::read_to_string(folder.join(name)).is_ok_and(|written| written == *text)
    };
    let fresh = program.is_file()
        && !sources.is_empty()
        && files.iter().all(is_written)
        && of_others.chain(&kept).all(older)
        && watched(&manifests.collect::<Vec<_>>(), around) == kept;
    fresh.then_some(program)
}

/// The files after the colon of a make rule, in which spaces in names are escaped.
fn sources(list: &str) -> Vec<PathBuf> {
    let rule = list.lines().next().and_then(|line| line.split_once(": "));
    let rule = rule.map_or("", |(_, sources)| sources);
    // File names in cargo's lists have no line break.
    let rule = rule.replace("\\ ", "\n");
    let paths = rule.split(' ').filter(|path| !path.is_empty());
    paths.map(|path| path.replace('\n', " ").into()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn spaces_in_names_are_kept() {
        let list = "/t/a\\ b: /x/my\\ crate/lib.rs /y.rs\n\n/t/other: /z.rs\n";
        assert_eq!(sources(list), ["/x/my crate/lib.rs", "/y.rs"].map(PathBuf::from));
        assert!(sources("").is_empty());
    }

    /// A cached runner in `runner`, made of `ws/box` for `project`, and the start of its build.
    struct Kept {
        folder: tempfile::TempDir,
        begun: SystemTime,
    }

    impl Kept {
        fn new() -> Kept {
            let kept = Kept { folder: tempfile::tempdir().unwrap(), begun: SystemTime::now() };
            let source = kept.write("ws/box/lib.rs", "");
            let program = kept.write("target/program", "");
            let list = format!("{}: {}", program.display(), source.display());
            kept.write("target/program.d", &list);
            kept.write("runner/src/main.rs", "fn main() {}");
            kept.write("project/.cargo/config.toml", "");
            kept.write("ws/Cargo.toml", "[workspace]");
            let manifest = kept.write("ws/box/Cargo.toml", "");
            assert_eq!(kept.found(), None, "nothing is built");
            let begun = begin(&kept.path("runner")).unwrap() + Duration::from_secs(1);
            assert_eq!(kept.found(), None, "the build has only begun");
            let project = kept.path("project");
            let lock = Some(kept.write("checkout/Cargo.lock", ""));
            let watched = watched(&[manifest], &Around { caller: &project, lock });
            done(&kept.path("runner"), &program, &watched, begun).unwrap();
            assert_eq!(kept.found(), Some(program));
            Kept { begun, ..kept }
        }

        fn path(&self, name: &str) -> PathBuf {
            self.folder.path().join(name)
        }

        fn write(&self, name: &str, text: &str) -> PathBuf {
            let path = self.path(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(&path, text).unwrap();
            path
        }

        fn found(&self) -> Option<PathBuf> {
            let files = [("src/main.rs".to_owned(), "fn main() {}".to_owned())];
            let (project, lock) = (self.path("project"), Some(self.path("checkout/Cargo.lock")));
            program(&self.path("runner"), &Around { caller: &project, lock }, &files)
        }
    }

    #[test]
    fn a_program_is_fresh_until_a_source_changes_or_disappears() {
        let kept = Kept::new();
        let all = [
            "ws/box/lib.rs",
            "ws/box/Cargo.toml",
            "ws/Cargo.toml",
            "project/.cargo/config.toml",
            "checkout/Cargo.lock",
        ];
        for name in all {
            let file = File::options().write(true).open(kept.path(name)).unwrap();
            file.set_modified(kept.begun + Duration::from_secs(1)).unwrap();
            assert_eq!(kept.found(), None, "{name} is newer");
            file.set_modified(kept.begun - Duration::from_secs(1)).unwrap();
            assert_eq!(kept.found(), Some(kept.path("target/program")));
        }
        for name in all {
            let kept = Kept::new();
            fs::remove_file(kept.path(name)).unwrap();
            assert_eq!(kept.found(), None, "{name} is gone");
        }
    }

    #[test]
    fn a_program_is_stale_when_its_crate_or_its_surroundings_change() {
        for (name, text) in [
            ("runner/src/main.rs", "fn main() { }"),
            ("target/program.d", ""),
            ("project/rust-toolchain.toml", ""),
            ("Cargo.toml", "[workspace]"),
        ] {
            let kept = Kept::new();
            let path = kept.write(name, text);
            let old = kept.begun - Duration::from_secs(9);
            File::options().write(true).open(path).unwrap().set_modified(old).unwrap();
            assert_eq!(kept.found(), None, "{name}");
        }
    }
}
