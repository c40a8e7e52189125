//! The robot as the agent sees it.

use std::path::{Path, PathBuf};
use std::time::Duration;

use afp_deploy::agent::{Host, Service, Started};
use afp_deploy::manifest::Manifest;
use afp_deploy::sha256;
use afp_deploy::wire::{Calibration, Hello};
use afp_project::ProjectFile;
use afp_run::RunError;
use afp_session::Build;

use super::control::{Order, Reply, ask};
use super::program;

/// The model of a robot without a project file.
const CARBOT: &str = "carbot";
/// The service stops a run, starts another one, and perhaps the first one again.
const RESTART: Duration = Duration::from_secs(30);
const SOON: Duration = Duration::from_secs(10);

/// This machine.
pub(super) struct Robot {
    root: PathBuf,
    afpc: PathBuf,
    model: String,
    calibration: Calibration,
}

impl Robot {
    /// # Errors
    /// The robot's project file is invalid.
    pub(super) fn new(root: &Path) -> Result<Self, RunError> {
        let project = ProjectFile::find(root)?;
        let model = model_of(&project).to_owned();
        let calibration = match (project.project.profile(), &project.calibration) {
            (None, _) => Calibration::Unneeded,
            (Some(_), None) => Calibration::Missing,
            (Some(_), Some(text)) => Calibration::Of(sha256(text.as_bytes())),
        };
        Ok(Robot { root: root.to_owned(), afpc: program::afpc()?, model, calibration })
    }

    fn ask(&self, order: Order, patience: Duration) -> Result<Reply, String> {
        ask(&self.root, order, patience)
    }
}

/// The profile of a project's robot, or the toolbox with its devices.
pub fn model_of(project: &ProjectFile) -> &str {
    let project = &project.project;
    let toolbox = project.robot.as_ref().and_then(|robot| robot.toolbox.as_deref());
    project.profile().map_or(toolbox.unwrap_or(CARBOT), |robot| robot.name)
}

/// The reply to another order.
fn confused<T>() -> Result<T, String> {
    Err("the service 'afp' has another version: restart it".to_owned())
}

impl Host for Robot {
    fn hello(&self) -> Hello {
        let disk = rustix::fs::statvfs(&self.root).ok();
        Hello {
            version: Build::this().to_string(),
            architecture: std::env::consts::ARCH.to_owned(),
            model: self.model.clone(),
            calibration: self.calibration.clone(),
            space: disk.map(|disk| disk.f_bavail.saturating_mul(disk.f_frsize)),
        }
    }

    fn check(&mut self, files: &Path, manifest: &Manifest) -> Result<String, String> {
        program::check(&self.afpc, files, manifest)
    }

    fn service(&mut self) -> Result<Service, String> {
        match self.ask(Order::State, RESTART)? {
            Reply::State(state) => Ok(state),
            _ => confused(),
        }
    }

    fn restart(&mut self) -> Result<Started, String> {
        match self.ask(Order::Restart, RESTART)? {
            Reply::Started(started) => Ok(started),
            _ => confused(),
        }
    }

    fn arm(&mut self, arm: bool) -> Result<(), String> {
        match self.ask(Order::Arm(arm), SOON)? {
            Reply::Done => Ok(()),
            _ => confused(),
        }
    }
}
