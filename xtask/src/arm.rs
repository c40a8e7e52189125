//! The recorded traces on a 64-bit ARM, under emulation: the same bits as on every other machine.

use std::path::Path;

use crate::shell::{Failure, cargo, program, run as run_command, target};

const TARGET: &str = "aarch64-unknown-linux-gnu";
const LINKER: &str = "aarch64-linux-gnu-gcc";
/// Where Debian's packages put the libraries of that machine.
const LIBRARIES: &str = "/usr/aarch64-linux-gnu";
/// Debian's packages: a linker with its libraries, and the emulator.
const PACKAGES: [&str; 3] = ["gcc-aarch64-linux-gnu", "libc6-dev-arm64-cross", "qemu-user"];

/// Builds the tests of the recorded traces for ARM and runs them under QEMU, without optimisation and with
/// it.
///
/// # Errors
/// No library, linker or emulator for the machine, or a trace that differs.
pub fn run() -> Result<(), Failure> {
    run_command(program("rustup").args(["target", "add", TARGET]))?;
    install()?;
    // A folder of its own: whoever builds for this machine need not wait.
    let folder = target().join("arm");
    for profile in [&[][..], &["--release"]] {
        let mut test = cargo();
        test.args(["test", "--target", TARGET, "--package", "afp-worlds", "--test", "golden"]);
        test.args(profile).env("CARGO_TARGET_DIR", &folder);
        test.env("CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER", LINKER);
        let runner = format!("qemu-aarch64 -L {LIBRARIES}");
        test.env("CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_RUNNER", runner);
        run_command(&mut test)?;
    }
    Ok(())
}

/// Installs what is missing, as root; everybody else is told what to install.
fn install() -> Result<(), Failure> {
    let there = |name: &str| program(name).arg("--version").output().is_ok();
    if there(LINKER) && there("qemu-aarch64") && Path::new(LIBRARIES).is_dir() {
        return Ok(());
    }
    let install = run_command(program("apt-get").arg("update")).and_then(|()| {
        let options = ["install", "-y", "--no-install-recommends"];
        run_command(program("apt-get").args(options).args(PACKAGES))
    });
    install.map_err(|why| Failure(format!("{}\nhelp: install {}", why.0, PACKAGES.join(" "))))
}
