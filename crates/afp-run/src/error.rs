//! Why a run cannot begin or go on, and the exit code that says so.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use afp_log::LogError;
use afp_project::{ProjectError, excerpt};

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
        /// The file.
        path: PathBuf,
        /// Why not.
        error: io::Error,
    },
    /// A file says something wrong.
    Content {
        /// The file.
        path: PathBuf,
        /// Line and column from 1, where known.
        place: Option<(usize, usize)>,
        /// The file's text.
        text: String,
        /// What is wrong.
        message: String,
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

    /// For `map_err` around file operations.
    pub fn file(what: &'static str, path: &Path) -> impl FnOnce(io::Error) -> RunError {
        let path = path.to_owned();
        move |error| RunError::File { what, path, error }
    }

    /// The exit code that tells of it.
    pub fn code(&self) -> u8 {
        match self {
            RunError::Usage { .. } => EXIT_USAGE,
            RunError::Missing { .. }
            | RunError::File { .. }
            | RunError::Content { .. }
            | RunError::Project(_)
            | RunError::Log(_) => EXIT_FAILED,
        }
    }

    /// Tells standard error and gives the exit code.
    pub fn report(&self) -> ExitCode {
        anstream::eprintln!("{}", self.styled());
        ExitCode::from(self.code())
    }

    /// The text for a terminal.
    pub fn styled(&self) -> String {
        let red = anstyle::AnsiColor::BrightRed.on_default().bold();
        let text = self.to_string();
        let lines = text.lines().map(|line| match line.strip_prefix("error") {
            Some(rest) => format!("{red}error{red:#}{rest}"),
            None => line.to_owned(),
        });
        lines.collect::<Vec<_>>().join("\n")
    }
}

/// The byte at a line and column from 1.
fn byte(text: &str, (line, column): (usize, usize)) -> usize {
    let lines = text.split_inclusive('\n');
    let before: usize = lines.clone().take(line.saturating_sub(1)).map(str::len).sum();
    let line = lines.clone().nth(line.saturating_sub(1)).unwrap_or("");
    before + line.chars().take(column.saturating_sub(1)).map(char::len_utf8).sum::<usize>()
}

impl fmt::Display for RunError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RunError::Usage { message, help } => {
                write!(f, "error: {message}")?;
                match help {
                    Some(help) => write!(f, "\n  help: {help}"),
                    None => Ok(()),
                }
            }
            RunError::Missing { message, help } => {
                write!(f, "error: {message}\n  help: {help}")
            }
            RunError::File { what, path, error } => {
                write!(f, "error: {what} '{}': {error}", path.display())
            }
            RunError::Content { path, place, text, message } => {
                writeln!(f, "error: {message}")?;
                match *place {
                    Some(place) => {
                        let at = byte(text, place);
                        excerpt(f, path, text, at..at, "")
                    }
                    None => write!(f, "  --> {}", path.display()),
                }
            }
            RunError::Project(error) => error.fmt(f),
            RunError::Log(error) => write!(f, "error: {error}"),
        }
    }
}

impl std::error::Error for RunError {}

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
