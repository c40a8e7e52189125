//! Why a run cannot begin or go on, and the exit code that says so.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use afp_excerpt::{Mistake, Report, Severity};
use afp_log::LogError;
use afp_project::{ProjectError, shown};
use afp_session::SessionError;

use crate::stderr::say;

/// The process did what was asked.
pub const EXIT_OK: u8 = 0;
/// The plan is wrong, or a file cannot be read or written.
pub const EXIT_FAILED: u8 = 1;
/// The command line makes no sense or asks for what is not there.
pub const EXIT_USAGE: u8 = 2;
/// The plan ended in `Error`.
pub const EXIT_PLAN_ERROR: u8 = 3;

/// Why a run cannot begin or go on.
#[derive(Debug)]
#[non_exhaustive]
pub enum RunError {
    /// The command line makes no sense or asks for what is not there.
    Usage {
        /// What is wrong.
        message: String,
        /// What to write instead.
        help: Option<String>,
    },
    /// Something that this machine should have is not there.
    Missing {
        /// What is missing.
        message: String,
        /// How to get it.
        help: String,
    },
    /// A file cannot be read or written.
    File {
        /// What was tried: `cannot read the world`.
        what: &'static str,
        path: PathBuf,
        /// Why not.
        error: io::Error,
    },
    /// A file says something wrong.
    Content { path: PathBuf, text: String, mistake: Mistake },
    /// A run did not come out as it did before.
    Differs {
        message: String,
        /// What may be the reason.
        help: String,
    },
    /// What the run needs panicked: the robot, or what drives it.
    Panicked {
        /// What was said, and where.
        said: String,
    },
    /// The project file is wrong.
    Project(ProjectError),
    /// The log cannot be written.
    Log(LogError),
}

impl RunError {
    /// A mistake on the command line.
    pub fn usage(message: impl Into<String>, help: impl Into<String>) -> Self {
        RunError::Usage { message: message.into(), help: Some(help.into()) }
    }

    /// For `map_err` around what reads the text of a file.
    pub fn content(
        path: impl Into<PathBuf>,
        text: impl Into<String>,
    ) -> impl FnOnce(Mistake) -> RunError {
        let (path, text) = (path.into(), text.into());
        |mistake| RunError::Content { path, text, mistake }
    }

    /// For `map_err` around file operations.
    pub fn file(what: &'static str, path: &Path) -> impl FnOnce(io::Error) -> RunError {
        let path = path.to_owned();
        move |error| RunError::File { what, path, error }
    }

    /// The exit code that tells of it.
    pub fn code(&self) -> u8 {
        match self {
            RunError::Usage { .. } => EXIT_USAGE,
            RunError::Panicked { .. } => EXIT_PLAN_ERROR,
            RunError::Missing { .. }
            | RunError::File { .. }
            | RunError::Content { .. }
            | RunError::Differs { .. }
            | RunError::Project(_)
            | RunError::Log(_) => EXIT_FAILED,
        }
    }

    /// Tells standard error and gives the exit code.
    pub fn report(&self) -> ExitCode {
        say(self.styled());
        ExitCode::from(self.code())
    }

    /// The text for a terminal.
    pub fn styled(&self) -> String {
        self.render(true)
    }

    /// The text for tools: an object on a line for each thing that is wrong, as diagnostics of plans are.
    pub fn json_lines(&self) -> String {
        self.reports(|report| format!("{}\n", report.json())).concat()
    }

    fn render(&self, colour: bool) -> String {
        self.reports(|report| report.render(colour)).join("\n\n")
    }

    /// What is made of each thing that is wrong.
    fn reports<T>(&self, make: impl Fn(&Report<'_>) -> T) -> Vec<T> {
        let report = |message: &str, help: &str| {
            let marks = Vec::new();
            vec![make(&Report { severity: Severity::Error, code: "", message, help, marks })]
        };
        match self {
            RunError::Usage { message, help } => {
                report(message, help.as_deref().unwrap_or_default())
            }
            RunError::Missing { message, help } | RunError::Differs { message, help } => {
                report(message, help)
            }
            RunError::File { what, path, error } => {
                let help = match error.kind() {
                    io::ErrorKind::NotFound => afp_output::ELSEWHERE,
                    _ => "",
                };
                report(&format!("{what} '{}': {error}", path.display()), help)
            }
            RunError::Content { path, text, mistake } => {
                vec![mistake.report(&shown(path).display().to_string(), text, make)]
            }
            RunError::Panicked { said } => {
                let message = format!("the run panicked, and no component of the plan did: {said}");
                report(&message, "mend the Rust at that place")
            }
            RunError::Project(error) => error.reports(make),
            RunError::Log(error) => report(&error.to_string(), &error.help()),
        }
    }
}

impl fmt::Display for RunError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for RunError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            RunError::File { error, .. } => Some(error),
            RunError::Project(error) => Some(error),
            RunError::Log(error) => Some(error),
            _ => None,
        }
    }
}

impl From<ProjectError> for RunError {
    fn from(error: ProjectError) -> Self {
        RunError::Project(error)
    }
}

impl From<LogError> for RunError {
    fn from(error: LogError) -> Self {
        RunError::Log(error)
    }
}

impl From<SessionError> for RunError {
    fn from(error: SessionError) -> Self {
        RunError::usage(error.to_string(), error.help())
    }
}
