//! Errors of runs, with their exit codes.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use afp_excerpt::{Mistake, Report, Severity};
use afp_log::LogError;
use afp_project::{ProjectError, shown};
use afp_session::SessionError;

use crate::stderr::say;

/// Success.
pub const EXIT_OK: u8 = 0;
/// The plan is wrong, or a file cannot be read or written.
pub const EXIT_FAILED: u8 = 1;
/// The command line is wrong or names something that does not exist.
pub const EXIT_USAGE: u8 = 2;
pub const EXIT_PLAN_ERROR: u8 = 3;

/// The reason why a run cannot begin or continue.
#[derive(Debug)]
#[non_exhaustive]
pub enum RunError {
    /// The command line is wrong or names something that does not exist.
    Usage {
        /// The mistake.
        message: String,
        /// A hint.
        help: Option<String>,
    },
    /// The machine lacks something that the run needs.
    Missing {
        /// The missing part.
        message: String,
        /// How to get it.
        help: String,
    },
    /// A file cannot be read or written.
    File {
        /// The operation that failed: `cannot read the world`.
        what: &'static str,
        path: PathBuf,
        /// The cause.
        error: io::Error,
    },
    /// The content of a file is wrong.
    Content { path: PathBuf, text: String, mistake: Mistake },
    /// A repeated run differs from the original.
    Differs {
        message: String,
        /// Possible reasons.
        help: String,
    },
    /// The robot or its driver panicked.
    Panicked {
        /// The message of the panic and its place.
        said: String,
    },
    /// The project file is wrong.
    Project(ProjectError),
    /// The log cannot be written.
    Log(LogError),
}

impl RunError {
    pub fn usage(message: impl Into<String>, help: impl Into<String>) -> Self {
        RunError::Usage { message: message.into(), help: Some(help.into()) }
    }

    /// For `map_err` on functions that read the text of a file.
    pub fn content(
        path: impl Into<PathBuf>,
        text: impl Into<String>,
    ) -> impl FnOnce(Mistake) -> RunError {
        let (path, text) = (path.into(), text.into());
        |mistake| RunError::Content { path, text, mistake }
    }

    /// For `map_err` on file operations.
    pub fn file(what: &'static str, path: &Path) -> impl FnOnce(io::Error) -> RunError {
        let path = path.to_owned();
        move |error| RunError::File { what, path, error }
    }

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

    /// Prints the error to standard error and returns the exit code.
    pub fn report(&self) -> ExitCode {
        say(self.styled());
        ExitCode::from(self.code())
    }

    pub fn styled(&self) -> String {
        self.render(true)
    }

    /// The text for tools: one JSON object a line for each mistake, like diagnostics of plans.
    pub fn json_lines(&self) -> String {
        self.reports(|report| format!("{}\n", report.json())).concat()
    }

    fn render(&self, colour: bool) -> String {
        self.reports(|report| report.render(colour)).join("\n\n")
    }

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
                let message = format!("the run panicked outside of the plan's components: {said}");
                report(&message, "fix the Rust code at that place")
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
