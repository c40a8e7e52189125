//! The recorded traces on a 64-bit ARM, under emulation: the same bits as on every other machine.

use crate::emulated::PI;
use crate::shell::{Failure, cargo, run as run_command, target};

/// Builds the tests of the recorded traces for ARM and runs them under QEMU, without optimisation and with
/// it.
///
/// # Errors
/// No library, linker or emulator for the machine, or a trace that differs.
pub fn run() -> Result<(), Failure> {
    PI.install()?;
    // A folder of its own, so that builds for this machine need not wait.
    let folder = target().join("arm");
    for profile in [&[][..], &["--release"]] {
        let mut test = cargo();
        test.args(["test", "--target", PI.triple, "--package", "afp-worlds", "--test", "golden"]);
        test.args(profile).env("CARGO_TARGET_DIR", &folder);
        test.env(PI.variable("LINKER"), PI.linker);
        test.env(PI.variable("RUNNER"), PI.emulator().join(" "));
        run_command(&mut test)?;
    }
    Ok(())
}
