//! Errors in writing or reading a log.

use std::borrow::Cow;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// An error in writing or reading a log.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LogError {
    /// The file cannot be created or given its name.
    #[error("cannot write the log '{}': {error}", .path.display())]
    Create {
        /// The log's final name.
        path: PathBuf,
        /// The cause.
        #[source]
        error: io::Error,
    },
    /// The file cannot be read.
    #[error("cannot read the log '{}': {error}", .path.display())]
    Open {
        /// The path.
        path: PathBuf,
        /// The cause.
        #[source]
        error: io::Error,
    },
    /// The file is not an MCAP file.
    #[error("'{}' is not an MCAP log", .path.display())]
    NotALog {
        /// The path.
        path: PathBuf,
    },
    /// The file is an MCAP file, but not the log of a run.
    #[error("'{}' is not the log of an AFP run", .path.display())]
    NoRun {
        /// The path.
        path: PathBuf,
    },
    /// The name of the file's unsupported compression.
    #[error("the log is compressed with '{0}', which cannot be read")]
    Compressed(String),
    /// Writing failed, or the contents are damaged.
    #[error("the log failed: {}", reason(.0))]
    Mcap(#[source] mcap::McapError),
    /// The writing thread died.
    #[error("the thread that writes the log has ended")]
    Writer,
}

impl LogError {
    /// The error of a log during writing; a disk error gets the file's path.
    pub(crate) fn writing(self, path: &Path) -> LogError {
        match self {
            LogError::Mcap(mcap::McapError::Io(error)) => {
                LogError::Create { path: path.to_owned(), error }
            }
            other => other,
        }
    }

    /// The help; empty if no general advice exists.
    pub fn help(&self) -> Cow<'static, str> {
        let help = match self {
            LogError::Open { error, path } if error.kind() == io::ErrorKind::NotFound => {
                let part = afp_output::part_of(path);
                if part.is_file() {
                    let part = part.display();
                    return format!(
                        "its run continues or was killed: use the unfinished log '{part}'"
                    )
                    .into();
                }
                afp_output::ELSEWHERE
            }
            LogError::NotALog { .. } | LogError::NoRun { .. } => {
                "name a file that a run wrote: 'afpc run PLAN --log FILE.mcap'"
            }
            LogError::Compressed(_) => {
                "'mcap decompress FILE -o OTHER.mcap', a tool of https://mcap.dev, makes a readable log"
            }
            LogError::Mcap(mcap::McapError::Io(_)) => "",
            LogError::Mcap(_) => "'afpc log FILE recover' saves what is intact into a new file",
            LogError::Create { error, .. } if error.kind() == io::ErrorKind::NotFound => {
                afp_output::ELSEWHERE
            }
            LogError::Create { error, .. } if is_forbidden(error) => {
                "name other files with '--log' and '--svg', or write no files: '--log none --svg none'"
            }
            LogError::Create { .. } | LogError::Open { .. } | LogError::Writer => "",
        };
        help.into()
    }
}

/// A disk error's own message.
fn reason(error: &mcap::McapError) -> &dyn fmt::Display {
    match error {
        mcap::McapError::Io(error) => error,
        error => error,
    }
}

fn is_forbidden(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem)
}

impl From<mcap::McapError> for LogError {
    fn from(error: mcap::McapError) -> Self {
        match error {
            mcap::McapError::UnsupportedCompression(how) => LogError::Compressed(how),
            error => LogError::Mcap(error),
        }
    }
}
