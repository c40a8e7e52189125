//! Whether a release is for a robot.

use super::{Refusal, refusal};
use crate::manifest::{Kind, Manifest, SIMULATED};
use crate::wire::{Calibration, Hello};

/// Refuses a release for another robot or processor.
pub(super) fn fits(hello: &Hello, manifest: &Manifest) -> Result<(), Refusal> {
    let (theirs, ours) = (&manifest.model, &hello.model);
    if theirs != ours {
        let message = format!("the plan is for the robot '{theirs}', and this robot is '{ours}'");
        return Err(refusal(message, "name another robot with '--to', or run the plan's project"));
    }
    is_calibrated(hello, manifest)?;
    match &manifest.kind {
        Kind::Built { architecture } if *architecture != hello.architecture => {
            let message = format!(
                "the program is for {architecture}, and the robot has {}",
                hello.architecture
            );
            Err(refusal(message, "build it for the robot with '--target'"))
        }
        _ => Ok(()),
    }
}

/// Refuses a plan that was tried with other measures than those of the robot.
fn is_calibrated(hello: &Hello, manifest: &Manifest) -> Result<(), Refusal> {
    if manifest.robot == SIMULATED {
        return Ok(());
    }
    match &hello.calibration {
        Calibration::Unneeded => Ok(()),
        Calibration::Of(theirs) if manifest.calibration.as_ref() == Some(theirs) => Ok(()),
        Calibration::Of(_) => Err(refusal(
            "the robot has another calibration than this project",
            "copy the file '/var/lib/afp/calibration.toml' of the robot into the project, or \
             set the robot up again: 'afpc robot setup'",
        )),
        Calibration::Missing => Err(refusal(
            "the robot has no calibration",
            "measure it with 'afpc calibrate', then run 'afpc robot setup' again",
        )),
    }
}
