//! The published packages: a wheel for each machine with the command line, and the source
//! distribution.
//!
//! Zig links against the C library of Linux systems of 2014 and later, for this machine and for
//! others. The wheels are tested without Rust and without a checkout, and their runs must be
//! bit-identical.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::emulated::PI;
use crate::python::{at_package, emptied, environment, only, sdist};
use crate::shell::{Failure, cargo, output, program, root, run as run_command, target};
use crate::studio;

/// The packages for building and checking, as pip names them.
const PACKAGES: [&str; 5] = [
    "auditwheel==6.8.2",
    "cargo-zigbuild==0.24.0",
    "maturin==1.16.0",
    "wheel==0.46.3",
    "ziglang==0.17.1",
];

/// The version of the linked C library, and Python's name of systems that have it.
const GLIBC: &str = "2.17";
const SYSTEMS: &str = "manylinux_2_17";

const PROFILE: &str = "wheel";

struct Machine {
    /// The name in Python.
    name: &'static str,
    /// The name in Rust.
    triple: &'static str,
}

const MACHINES: [Machine; 2] = [
    Machine { name: "x86_64", triple: "x86_64-unknown-linux-gnu" },
    Machine { name: "aarch64", triple: PI.triple },
];

/// Builds wheels and source distribution into `target/wheels`, and tests each installed wheel.
///
/// # Errors
/// No Python, npm, library for a machine or emulator; a wheel needs a newer system, or does not
/// run.
pub fn run(names: &[String]) -> Result<(), Failure> {
    let unknown = names.iter().find(|name| MACHINES.iter().all(|machine| machine.name != **name));
    if let Some(name) = unknown {
        let known = MACHINES.map(|machine| machine.name).join(", ");
        return Err(format!("no wheels for '{name}'; there are: {known}").into());
    }
    let python = environment("wheels-python", &PACKAGES)?;
    studio::page()?;
    let folder = emptied(&target().join("wheels"))?;
    sdist(&python, &folder)?;
    let mut said: Option<String> = None;
    for machine in &MACHINES {
        if !names.is_empty() && !names.iter().any(|name| name == machine.name) {
            continue;
        }
        let wheel = machine.wheel(&python, &folder)?;
        let says = machine.try_out(&python, &wheel)?;
        if said.as_ref().is_some_and(|said| *said != says) {
            let text = format!(
                "the wheel for '{}' gives other results than the other wheels:\n{says}",
                machine.name
            );
            return Err(text.into());
        }
        println!("{}", wheel.display());
        said = Some(says);
    }
    Ok(())
}

impl Machine {
    fn wheel(&self, python: &Path, folder: &Path) -> Result<PathBuf, Failure> {
        let installed =
            output(program("rustc").args(["--print", "target-libdir", "--target", self.triple]));
        if !installed.is_ok_and(|folder| Path::new(folder.trim()).is_dir()) {
            run_command(program("rustup").args(["target", "add", self.triple]))?;
        }
        let bare = emptied(&target().join("xtask/wheels").join(self.name))?;
        let build =
            ["-m", "maturin", "build", "--locked", "--quiet", "--zig", "--profile", PROFILE];
        let mut build = with_zig(at_package(python, &build), python);
        build.args(["--compatibility", SYSTEMS, "--target", self.triple, "--out"]);
        run_command(build.arg(&bare))?;
        let afpc = self.command_line(python)?;
        let wheel = with_program(python, &only(&bare, "whl")?, &afpc, folder)?;
        let shown = output(program(python).args(["-m", "auditwheel", "show"]).arg(&wheel))?;
        let tag = format!("{SYSTEMS}_{}", self.name);
        if !shown.contains(&format!("\"{tag}\"")) {
            return Err(format!("'{}' does not run on '{tag}':\n{shown}", wheel.display()).into());
        }
        Ok(wheel)
    }

    /// Builds the command line, with all features.
    fn command_line(&self, python: &Path) -> Result<PathBuf, Failure> {
        let zigbuild = python.with_file_name("cargo-zigbuild");
        let mut build = with_zig(program(zigbuild), python);
        build.args(["zigbuild", "--locked", "--quiet", "--profile", PROFILE, "--package", "afpc"]);
        build.args(["--features", "full,studio", "--target", &format!("{}.{GLIBC}", self.triple)]);
        run_command(build.env("CARGO", cargo().get_program()))?;
        Ok(target().join(self.triple).join(PROFILE).join("afpc"))
    }

    /// Installs the wheel in an empty folder and runs it; returns the output of some runs.
    fn try_out(&self, python: &Path, wheel: &Path) -> Result<String, Failure> {
        let there = Place::of(self, python)?;
        let folder = emptied(&target().join("xtask/tried").join(self.name))?;
        let mut install = program(python);
        install.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]);
        install.arg("--only-binary=:all:");
        // The systems that numpy's wheels need, too.
        for system in [SYSTEMS, "manylinux_2_27", "manylinux_2_28"] {
            install.args(["--platform", &format!("{system}_{}", self.name)]);
        }
        install.args(["--python-version", &there.version()?, "--target"]).arg(&folder);
        run_command(install.arg(wheel))?;
        let plan = folder.join("afp/plans/wall_following.afp");
        let tried = root().join("tests/python/installed.py");
        let by_python = output(there.python().arg(tried).arg(&plan).env("PYTHONPATH", &folder))?;
        let options = ["--until", "20s", "--json", "--log", "none", "--svg", "none"];
        let mut afpc = there.program(&folder.join("bin/afpc"));
        let by_afpc = output(afpc.arg("run").arg(&plan).args(options).current_dir(&folder))?;
        Ok(format!("{by_python}{by_afpc}"))
    }
}

/// Where a machine's programs run: here, or emulated.
struct Place {
    python: PathBuf,
    words: Vec<String>,
}

impl Place {
    fn of(machine: &Machine, python: &Path) -> Result<Place, Failure> {
        if machine.name == std::env::consts::ARCH {
            return Ok(Place { python: python.to_owned(), words: Vec::new() });
        }
        PI.install()?;
        let root = PI.python(&target().join("xtask/arm-python"))?;
        Ok(Place { python: root.join("usr/bin/python3"), words: PI.emulator_in(&root).to_vec() })
    }

    fn program(&self, path: &Path) -> Command {
        match self.words.split_first() {
            Some((emulator, words)) => {
                let mut command = program(emulator);
                command.args(words).arg(path);
                command
            }
            None => program(path),
        }
    }

    fn python(&self) -> Command {
        self.program(&self.python)
    }

    /// The version of its Python, such as `3.11`.
    fn version(&self) -> Result<String, Failure> {
        let say = "import sys; print('%d.%d' % sys.version_info[:2])";
        Ok(output(self.python().args(["-c", say]))?.trim().to_owned())
    }
}

/// Adds a program to a wheel, in the folder for Python's scripts.
fn with_program(python: &Path, wheel: &Path, afpc: &Path, to: &Path) -> Result<PathBuf, Failure> {
    let unpacked = emptied(&target().join("xtask/unpacked"))?;
    let unpack = ["-m", "wheel", "unpack", "--dest"];
    run_command(program(python).args(unpack).arg(&unpacked).arg(wheel))?;
    let named = fs::read_dir(&unpacked)?.next().ok_or("the wheel is empty")??.path();
    let name = named.file_name().unwrap_or_default().to_string_lossy();
    let scripts = named.join(format!("{name}.data/scripts"));
    fs::create_dir_all(&scripts)?;
    fs::copy(afpc, scripts.join("afpc"))?;
    let pack = ["-m", "wheel", "pack", "--dest-dir"];
    run_command(program(python).args(pack).arg(to).arg(&named))?;
    Ok(to.join(wheel.file_name().unwrap_or_default()))
}

/// A command that finds the Zig that pip has installed.
fn with_zig(mut command: Command, python: &Path) -> Command {
    let mut folders = vec![python.parent().unwrap_or(python).to_owned()];
    folders.extend(std::env::var_os("PATH").iter().flat_map(std::env::split_paths));
    if let Ok(path) = std::env::join_paths(folders) {
        command.env("PATH", path);
    }
    command
}
