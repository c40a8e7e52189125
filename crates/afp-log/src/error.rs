//! Why a log cannot be written or read.

use std::borrow::Cow;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Why a log cannot be written or read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LogError {
    /// The file cannot be created or given its name.
    #[error("cannot write the log '{}': {error}", .path.display())]
    Create {
        /// The log's final name.
        path: PathBuf,
        /// Why.
        #[source]
        error: io::Error,
    },
    /// The file cannot be read.
    #[error("cannot read the log '{}': {error}", .path.display())]
    Open {
        /// Its name.
        path: PathBuf,
        /// Why.
        #[source]
        error: io::Error,
    },
    /// The file is no MCAP file.
    #[error("'{}' is not an MCAP log", .path.display())]
    NotALog {
        /// Its name.
        path: PathBuf,
    },
    /// The file is an MCAP file, but not the log of a run.
    #[error("'{}' is not the log of a run of AFP", .path.display())]
    NoRun {
        /// Its name.
        path: PathBuf,
    },
    /// What the file holds is compressed in a way that cannot be read, by its name.
    #[error("the log is compressed with '{0}', which cannot be read")]
    Compressed(String),
    /// Writing failed, or the contents are damaged.
    #[error("the log failed: {}", reason(.0))]
    Mcap(#[source] mcap::McapError),
    /// The writing thread died.
    #[error("the thread that writes the log died")]
    Writer,
}

impl LogError {
    /// The same of a log that is being written: a failure of the disk names the file.
    pub(crate) fn writing(self, path: &Path) -> LogError {
        match self {
            LogError::Mcap(mcap::McapError::Io(error)) => {
                LogError::Create { path: path.to_owned(), error }
            }
            other => other,
        }
    }

    /// What to do about it; empty where nothing in general helps.
    pub fn help(&self) -> Cow<'static, str> {
        let help = match self {
            LogError::Open { error, path } if error.kind() == io::ErrorKind::NotFound => {
                let part = afp_output::part_of(path);
                if part.is_file() {
                    let part = part.display();
                    return format!(
                        "its run goes on or was killed: name what there is of it, '{part}'"
                    )
                    .into();
                }
                afp_output::ELSEWHERE
            }
            LogError::NotALog { .. } | LogError::NoRun { .. } => {
                "name a file that a run wrote: 'afpc run PLAN --log FILE.mcap'"
            }
            LogError::Compressed(_) => {
                "'mcap decompress FILE -o OTHER.mcap', a tool of https://mcap.dev, makes one that can be read"
            }
            LogError::Mcap(mcap::McapError::Io(_)) => "",
            LogError::Mcap(_) => "'afpc log FILE recover' saves what is intact into a new file",
            LogError::Create { error, .. } if error.kind() == io::ErrorKind::NotFound => {
                afp_output::ELSEWHERE
            }
            LogError::Create { error, .. } if is_forbidden(error) => {
                "name another place with '--log' and '--svg', or write none: '--log none --svg none'"
            }
            LogError::Create { .. } | LogError::Open { .. } | LogError::Writer => "",
        };
        help.into()
    }
}

/// Of a disk its own words.
fn reason(error: &mcap::McapError) -> &dyn fmt::Display {
    match error {
        mcap::McapError::Io(error) => error,
        error => error,
    }
}

/// Whether nothing can be written to a place.
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
