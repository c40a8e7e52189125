//! Reads a log of ours with the public Python reader, none of our code in between.

use std::fs;
use std::path::PathBuf;

use crate::shell::{Failure, cargo, output, program, root, run as run_command, target};

/// What the readers need, as pip names it.
const PACKAGES: [&str; 2] = ["mcap==1.6.0", "mcap-protobuf-support==0.6.0"];

/// Records a run and reads its log.
///
/// # Errors
/// No Python, no network for the packages, or a log that does not read.
pub fn run() -> Result<(), Failure> {
    let python = environment()?;
    let folder = target().join("xtask");
    fs::create_dir_all(&folder)?;
    let log = folder.join("wall_following.mcap");
    let drive = ["run", "--quiet", "--package", "afpc", "--", "run", "plans/wall_following.afp"];
    let options = ["--until", "20s", "--svg", "none", "--json", "--log"];
    output(cargo().args(drive).args(options).arg(&log))?;
    run_command(program(python).arg(root().join("tests/python/read_log.py")).arg(log))
}

/// A Python with the packages, made once under target/.
fn environment() -> Result<PathBuf, Failure> {
    let folder = target().join("xtask/python");
    let python = folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let done = folder.join("packages.txt");
    let wanted = PACKAGES.join("\n");
    if fs::read_to_string(&done).is_ok_and(|installed| installed == wanted) {
        return Ok(python);
    }
    let system = if cfg!(windows) { "python" } else { "python3" };
    run_command(program(system).args(["-m", "venv", "--clear"]).arg(&folder)).map_err(|why| {
        Failure(format!("{}\nhelp: install Python 3 with its venv module (python3-venv)", why.0))
    })?;
    let pip = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"];
    run_command(program(&python).args(pip).args(PACKAGES))?;
    fs::write(done, wanted)?;
    Ok(python)
}
