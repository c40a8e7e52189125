//! Reads a log and a table of ours with public Python readers, none of our code in between.

use std::fs;
use std::path::PathBuf;

use crate::shell::{Failure, cargo, output, program, root, run as run_command, target};

/// What the readers need, as pip names it.
const PACKAGES: [&str; 3] = ["mcap==1.6.0", "mcap-protobuf-support==0.6.0", "pyarrow==26.0.1"];

/// Records a run and reads its log; runs a sweep and reads its table.
///
/// # Errors
/// No Python, no network for the packages, or something that does not read.
pub fn run() -> Result<(), Failure> {
    let python = environment()?;
    let folder = target().join("xtask");
    fs::create_dir_all(&folder)?;
    let log = folder.join("wall_following.mcap");
    let drive = ["run", "--quiet", "--package", "afpc", "--", "run", "plans/wall_following.afp"];
    let options = ["--until", "20s", "--svg", "none", "--json", "--log"];
    output(cargo().args(drive).args(options).arg(&log))?;
    run_command(program(&python).arg(root().join("tests/python/read_log.py")).arg(log))?;
    let table = folder.join("sweep");
    let sweep = ["run", "--quiet", "--package", "afpc", "--", "sweep", "plans/wall_following.afp"];
    let worlds = ["--world", "worlds/wall_following.toml", "--world", "random:0..3"];
    let grid = ["--vary", "walldist=30cm,40cm", "--until", "21s", "--restart", "-o"];
    // The '/' makes it a folder, with a table of each kind.
    let there = format!("{}/", table.display());
    output(cargo().args(sweep).args(worlds).args(grid).arg(there))?;
    run_command(program(&python).arg(root().join("tests/python/read_sweep.py")).arg(table))
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
