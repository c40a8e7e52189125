//! The recorded traces on emulated 64-bit ARM: they must be bit-identical to those of every other
//! machine.

use crate::emulated::PI;
use crate::shell::{Failure, cargo, run as run_command, target};

/// Builds the tests of the recorded traces for ARM and runs them under QEMU, without and with
/// optimisation.
///
/// # Errors
/// No library, linker or emulator for the machine, or a different trace.
pub fn run() -> Result<(), Failure> {
    PI.install()?;
    // A separate folder, so that builds for this machine do not wait.
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
