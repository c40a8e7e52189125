//! JavaScript programs and their public packages.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::shell::{Failure, program, root, run, target};

/// The files that name those packages.
const PROJECT: [&str; 3] = ["package.json", "package-lock.json", ".npmrc"];

pub fn npm() -> Command {
    program(if cfg!(windows) { "npm.cmd" } else { "npm" })
}

/// Installs the packages of a folder's lock file, once; their scripts do not run.
///
/// # Errors
/// No npm, or no network for the packages.
pub fn ci(folder: &Path) -> Result<(), Failure> {
    let wanted = fs::read_to_string(folder.join("package-lock.json"))?;
    let done = folder.join("node_modules/.installed");
    if fs::read_to_string(&done).is_ok_and(|installed| installed == wanted) {
        return Ok(());
    }
    let install = ["ci", "--ignore-scripts", "--no-audit", "--no-fund"];
    run(npm().args(install).current_dir(folder)).map_err(|why| {
        Failure(format!("{}\nhelp: install Node.js 20 or later with npm (nodejs, npm)", why.0))
    })?;
    fs::write(done, wanted)?;
    Ok(())
}

/// The folder of a project of `tests/`, installed once under target/, with the current version of
/// its program.
///
/// # Errors
/// As [`ci`].
pub fn installed(name: &str, file: &str) -> Result<PathBuf, Failure> {
    let (project, folder) = (root().join("tests").join(name), target().join("xtask").join(name));
    fs::create_dir_all(&folder)?;
    for file in PROJECT {
        fs::copy(project.join(file), folder.join(file))?;
    }
    ci(&folder)?;
    fs::copy(project.join(file), folder.join(file))?;
    Ok(folder)
}
