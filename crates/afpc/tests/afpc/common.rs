//! Runs the real binary in a temporary folder.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

/// The plan of the paper.
pub const WALL_FOLLOWING: &str = include_str!("../../../../plans/wall_following.afp");

/// A temporary folder for the program.
pub struct Place {
    folder: TempDir,
}

/// The result of a call.
#[derive(Debug)]
pub struct Said {
    pub code: i32,
    pub out: String,
    pub err: String,
}

impl Place {
    pub fn new() -> Place {
        Place { folder: tempfile::tempdir().unwrap() }
    }

    /// A place with the plan of the paper in it.
    pub fn with_plan() -> Place {
        let place = Place::new();
        place.write("wall_following.afp", WALL_FOLLOWING);
        place
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn write(&self, name: &str, text: &str) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }

    /// Writes a program.
    #[cfg(unix)]
    pub fn program(&self, name: &str, text: &str) {
        self.write(name, text);
        let executable = std::os::unix::fs::PermissionsExt::from_mode(0o755);
        fs::set_permissions(self.path(name), executable).unwrap();
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    pub fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap()
    }

    pub fn exists(&self, name: &str) -> bool {
        self.path(name).exists()
    }

    /// The names of all files, in order.
    pub fn files(&self) -> Vec<String> {
        let mut names = Vec::new();
        collect(self.folder.path(), self.folder.path(), &mut names);
        names.sort();
        names
    }

    pub fn command(&self) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_afpc"));
        command.current_dir(self.folder.path());
        // Runners are kept in the folder's own cache.
        command.env_remove("CARGO_TARGET_DIR").env("XDG_CACHE_HOME", self.path("cache"));
        command
    }

    /// Calls `afpc` with arguments separated by spaces.
    pub fn afpc(&self, arguments: &str) -> Said {
        said(self.command().args(arguments.split_whitespace()).output().unwrap())
    }
}

pub fn said(output: Output) -> Said {
    let Output { status, stdout, stderr } = output;
    Said {
        code: status.code().unwrap_or(-1),
        out: String::from_utf8(stdout).unwrap(),
        err: String::from_utf8(stderr).unwrap(),
    }
}

fn collect(root: &Path, folder: &Path, names: &mut Vec<String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => collect(root, &path, names),
            false => names.push(path.strip_prefix(root).unwrap().display().to_string()),
        }
    }
}

impl Said {
    /// Asserts this exit code and these texts on standard error.
    #[track_caller]
    pub fn fails(&self, code: i32, texts: &[&str]) -> &Said {
        assert_eq!(self.code, code, "{self:#?}");
        for text in texts {
            assert!(self.err.contains(text), "no {text:?} in: {}", self.err);
        }
        assert!(!self.err.contains("panicked"), "{}", self.err);
        self
    }

    /// Asserts a successful call.
    #[track_caller]
    pub fn succeeds(&self) -> &Said {
        assert_eq!(self.code, 0, "{self:#?}");
        self
    }

    /// The last line of standard output as JSON.
    #[track_caller]
    pub fn last_json(&self) -> serde_json::Value {
        serde_json::from_str(self.out.lines().last().unwrap()).unwrap()
    }
}

/// Sets the build folder of all slow tests, with little optimisation.
pub fn quickly_built(command: &mut Command) -> &mut Command {
    let target = concat!(env!("CARGO_TARGET_TMPDIR"), "/built-plans");
    command
        .env("CARGO_TARGET_DIR", target)
        .env("CARGO_PROFILE_RELEASE_OPT_LEVEL", "0")
        .env("CARGO_PROFILE_RELEASE_LTO", "off")
        .env("CARGO_PROFILE_RELEASE_CODEGEN_UNITS", "16")
        .env("CARGO_PROFILE_RELEASE_DEBUG", "0")
        .env("CARGO_TERM_COLOR", "never")
}
