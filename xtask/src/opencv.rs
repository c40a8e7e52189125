//! Optical flow by OpenCV, compared with the built-in method.

use crate::shell::{Failure, cargo, output, program, run as run_command};

/// OpenCV's development package in Debian and Ubuntu, and the compiler whose library parses its
/// headers.
const PACKAGES: [&str; 3] = ["libopencv-dev", "clang", "libclang-dev"];

/// Builds the feature `opencv` and compares both methods with the true flow. Installs a missing
/// OpenCV, which needs Debian and root.
///
/// # Errors
/// OpenCV is missing and cannot be installed, or a test fails.
pub fn run() -> Result<(), Failure> {
    if output(program("pkg-config").args(["--modversion", "opencv4"])).is_err() {
        run_command(program("apt-get").arg("update"))?;
        let install = ["install", "--yes", "--no-install-recommends"];
        run_command(program("apt-get").args(install).args(PACKAGES))?;
    }
    let test = ["test", "--package", "afp-navigation", "--features", "opencv", "--", "--nocapture"];
    run_command(cargo().args(test))
}
