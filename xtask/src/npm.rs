//! Programs in JavaScript under `tests/`, with the public packages that they are written against.

use std::fs;
use std::path::PathBuf;

use crate::shell::{Failure, program, root, run, target};

/// What says which packages those are.
const PROJECT: [&str; 3] = ["package.json", "package-lock.json", ".npmrc"];

/// The folder of a project of `tests/`, installed once under target/, with its program as it is now.
///
/// # Errors
/// No npm, no network for the packages.
pub fn installed(name: &str, file: &str) -> Result<PathBuf, Failure> {
    let (project, folder) = (root().join("tests").join(name), target().join("xtask").join(name));
    fs::create_dir_all(&folder)?;
    let done = folder.join("installed.json");
    let wanted = fs::read_to_string(project.join("package-lock.json"))?;
    if !fs::read_to_string(&done).is_ok_and(|installed| installed == wanted) {
        for file in PROJECT {
            fs::copy(project.join(file), folder.join(file))?;
        }
        let npm = if cfg!(windows) { "npm.cmd" } else { "npm" };
        run(program(npm).arg("ci").current_dir(&folder)).map_err(|why| {
            Failure(format!("{}\nhelp: install Node.js with npm (nodejs, npm)", why.0))
        })?;
        fs::write(done, wanted)?;
    }
    fs::copy(project.join(file), folder.join(file))?;
    Ok(folder)
}
