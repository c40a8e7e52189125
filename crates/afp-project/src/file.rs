//! The project file of a folder, and its toolbox files.

use std::path::{Path, PathBuf};
use std::{fmt, io};

use afp_excerpt::{Mistake, Report, Severity};
use afp_output::read_text_file;

use crate::krate::{self, CrateLink, HardwareLink, RobotLink};
use crate::path::{NAME, shown};
use crate::project::{Crate, Project, Robot, Toolbox};
use crate::read::{read, read_calibration};

/// The calibration of a robot with a profile, in the folder of the project file.
pub const CALIBRATION: &str = "calibration.toml";

/// A valid project file; empty if there is none.
#[derive(Clone, Debug)]
pub struct ProjectFile {
    /// Its folder, to which its paths are relative.
    pub folder: PathBuf,
    pub exists: bool,
    pub text: String,
    pub project: Project,
    /// The text of the robot's calibration, whose values are in `project`.
    pub calibration: Option<String>,
}

/// A toolbox of the project and its text.
#[derive(Clone, Debug)]
pub struct ToolboxFile {
    /// Its entry in the project file.
    pub toolbox: Toolbox,
    pub path: PathBuf,
    pub text: String,
    /// Its Rust crate, or the error.
    pub krate: Result<CrateLink, Mistake>,
}

/// Errors of a project.
#[derive(Debug)]
#[non_exhaustive]
pub enum ProjectError {
    /// The project file cannot be read.
    Unreadable {
        path: PathBuf,
        /// The reason.
        error: io::Error,
    },
    Wrong {
        path: PathBuf,
        text: String,
        /// The errors in source order, at least one.
        mistakes: Vec<Mistake>,
    },
}

impl ProjectFile {
    /// The nearest `afp.toml` in `folder` or above it.
    ///
    /// # Errors
    /// The file cannot be read, or has errors.
    pub fn find(folder: &Path) -> Result<ProjectFile, ProjectError> {
        let folder = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
        let Some(home) = folder.ancestors().find(|above| above.join(NAME).is_file()) else {
            let (text, project) = (String::new(), Project::default());
            let calibration = None;
            return Ok(ProjectFile { folder, exists: false, text, project, calibration });
        };
        let path = home.join(NAME);
        let text = match read_text_file(&path) {
            Ok(text) => text,
            Err(error) => return Err(ProjectError::Unreadable { path, error }),
        };
        let (mut project, mistakes) = read(&text);
        if !mistakes.is_empty() {
            return Err(ProjectError::Wrong { path, text, mistakes });
        }
        let calibration = calibrate(home, &mut project)?;
        Ok(ProjectFile { folder: home.to_owned(), exists: true, text, project, calibration })
    }

    /// The project file of a plan's folder.
    ///
    /// # Errors
    /// See [`ProjectFile::find`].
    pub fn of_plan(plan: &Path) -> Result<ProjectFile, ProjectError> {
        match plan.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => ProjectFile::find(folder),
            _ => ProjectFile::find(Path::new(".")),
        }
    }

    pub fn path(&self) -> PathBuf {
        self.folder.join(NAME)
    }

    /// Reads the project's toolboxes.
    ///
    /// # Errors
    /// Unreadable toolbox files, each at its name in the project file.
    pub fn toolboxes(&self) -> Result<Vec<ToolboxFile>, ProjectError> {
        let (mut files, mut mistakes) = (Vec::new(), Vec::new());
        for toolbox in &self.project.toolboxes {
            let path = self.folder.join(&toolbox.path);
            match read_text_file(&path) {
                Ok(text) => {
                    let krate = krate::link(&self.folder, toolbox, &path);
                    files.push(ToolboxFile { toolbox: toolbox.clone(), path, text, krate });
                }
                Err(error) => {
                    let written = &toolbox.path;
                    let (message, help) = match path.is_dir() {
                        true => (
                            format!("'{written}' is a folder"),
                            format!(
                                "'path' names the toolbox's file, such as '{}.afp'",
                                toolbox.name
                            ),
                        ),
                        false => (
                            format!("cannot read '{}': {error}", shown(&path).display()),
                            format!("'path' is relative to the folder of {NAME}"),
                        ),
                    };
                    let span = Some(toolbox.span.clone());
                    mistakes.push(Mistake { span, message, help });
                }
            }
        }
        if mistakes.is_empty() { Ok(files) } else { Err(self.wrong(mistakes)) }
    }

    /// The project's simulated robot with its crate; `None` for the Carbot and for profiles, which
    /// are built in.
    ///
    /// # Errors
    /// There is only the real robot. The crate is missing on this machine, or differs from the
    /// file's entry.
    pub fn robot(&self) -> Result<Option<RobotLink>, ProjectError> {
        let Some(robot) = self.own_robot() else { return Ok(None) };
        let (krate, file) = self.crate_of(robot);
        let linked = krate::link_robot(&self.folder, robot, &krate, &file);
        linked.map(Some).map_err(|mistake| self.wrong(vec![mistake]))
    }

    /// The robot for runs on hardware, as [`ProjectFile::robot`]; `None` too if there is no
    /// simulated robot.
    ///
    /// # Errors
    /// Those of [`ProjectFile::robot`] except the first.
    pub fn robot_for_hardware(&self) -> Result<Option<RobotLink>, ProjectError> {
        match self.own_robot() {
            Some(robot) if robot.sim.is_none() => Ok(None),
            _ => self.robot(),
        }
    }

    /// The robot that the project's Rust implements.
    fn own_robot(&self) -> Option<&Robot> {
        self.project.robot.as_ref().filter(|robot| robot.profile.is_none())
    }

    /// The default crate of a robot, and the file in whose surroundings it is.
    fn crate_of(&self, robot: &Robot) -> (Crate, PathBuf) {
        let toolboxes = &self.project.toolboxes;
        let is_of_robot = |toolbox: &&Toolbox| robot.toolbox.as_ref() == Some(&toolbox.name);
        let toolbox = toolboxes.iter().find(is_of_robot);
        let krate = robot.krate.as_ref().or_else(|| toolbox.map(|toolbox| &toolbox.krate));
        let file = toolbox.map_or_else(|| self.path(), |toolbox| self.folder.join(&toolbox.path));
        (krate.cloned().unwrap_or_default(), file)
    }

    /// The hardware robot with its crate; `None` if there is only a simulated one.
    ///
    /// # Errors
    /// The crate is missing on this machine, or differs from the file's entry.
    pub fn hardware(&self) -> Result<Option<HardwareLink>, ProjectError> {
        let Some(robot) = self.own_robot() else { return Ok(None) };
        let Some(hardware) = &robot.hardware else { return Ok(None) };
        let (krate, file) = self.crate_of(robot);
        let linked = krate::link_hardware(&self.folder, hardware, &krate, &file);
        let mut linked = linked.map_err(|mistake| self.wrong(vec![mistake]))?;
        linked.settings.extend(robot.of_control_loop());
        Ok(Some(linked))
    }

    /// Makes the error for mistakes that are not in the file's own text.
    pub fn wrong(&self, mistakes: Vec<Mistake>) -> ProjectError {
        ProjectError::Wrong { path: self.path(), text: self.text.clone(), mistakes }
    }
}

/// Reads the calibration of a project's robot, if there is one.
fn calibrate(home: &Path, project: &mut Project) -> Result<Option<String>, ProjectError> {
    let path = home.join(CALIBRATION);
    let robot = project.robot.as_mut().and_then(|robot| robot.profile.as_mut());
    let Some(robot) = robot.filter(|_| path.is_file()) else { return Ok(None) };
    let text = match read_text_file(&path) {
        Ok(text) => text,
        Err(error) => return Err(ProjectError::Unreadable { path, error }),
    };
    let mistakes = read_calibration(&text, robot);
    match mistakes.is_empty() {
        true => Ok(Some(text)),
        false => Err(ProjectError::Wrong { path, text, mistakes }),
    }
}

impl ProjectError {
    /// The errors as text, separated by blank lines, optionally with terminal colours.
    pub fn render(&self, colour: bool) -> String {
        self.reports(|report| report.render(colour)).join("\n\n")
    }

    /// Converts each error.
    pub fn reports<T>(&self, make: impl Fn(&Report<'_>) -> T) -> Vec<T> {
        match self {
            ProjectError::Unreadable { path, error } => {
                let path = shown(path);
                let message = format!("cannot read the project file '{}': {error}", path.display());
                let (message, marks) = (message.as_str(), Vec::new());
                let severity = Severity::Error;
                vec![make(&Report { severity, code: "", message, help: "", marks })]
            }
            ProjectError::Wrong { path, text, mistakes } => {
                let path = shown(path).display().to_string();
                mistakes.iter().map(|mistake| mistake.report(&path, text, &make)).collect()
            }
        }
    }
}

impl fmt::Display for ProjectError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for ProjectError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            ProjectError::Unreadable { error, .. } => Some(error),
            ProjectError::Wrong { .. } => None,
        }
    }
}

#[cfg(test)]
mod tests;
