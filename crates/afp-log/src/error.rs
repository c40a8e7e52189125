//! Why a log cannot be written or read.

use std::borrow::Cow;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Why a log cannot be written or read.
#[derive(Debug)]
#[non_exhaustive]
pub enum LogError {
    /// The file cannot be created or given its name.
    Create {
        /// The log's final name.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
    /// The file cannot be read.
    Open {
        /// Its name.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
    /// The file is no MCAP file.
    NotALog {
        /// Its name.
        path: PathBuf,
    },
    /// The file is an MCAP file, but not the log of a run.
    NoRun {
        /// Its name.
        path: PathBuf,
    },
    /// What the file holds is compressed in a way that cannot be read, by its name.
    Compressed(String),
    /// Writing failed, or the contents are damaged.
    Mcap(mcap::McapError),
    /// The writing thread died.
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

/// Whether nothing can be written to a place.
fn is_forbidden(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem)
}

impl fmt::Display for LogError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LogError::Create { path, error } => {
                write!(f, "cannot write the log '{}': {error}", path.display())
            }
            LogError::Open { path, error } => {
                write!(f, "cannot read the log '{}': {error}", path.display())
            }
            LogError::NotALog { path } => {
                write!(f, "'{}' is not an MCAP log", path.display())
            }
            LogError::NoRun { path } => {
                write!(f, "'{}' is not the log of a run of AFP", path.display())
            }
            LogError::Compressed(how) => {
                write!(f, "the log is compressed with '{how}', which cannot be read")
            }
            // What it says of its own is 'I/O error', for a full disk too.
            LogError::Mcap(mcap::McapError::Io(error)) => write!(f, "the log failed: {error}"),
            LogError::Mcap(error) => write!(f, "the log failed: {error}"),
            LogError::Writer => f.write_str("the thread that writes the log died"),
        }
    }
}

impl std::error::Error for LogError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            LogError::Create { error, .. } | LogError::Open { error, .. } => Some(error),
            LogError::Mcap(error) => Some(error),
            _ => None,
        }
    }
}

impl From<mcap::McapError> for LogError {
    fn from(error: mcap::McapError) -> Self {
        match error {
            mcap::McapError::UnsupportedCompression(how) => LogError::Compressed(how),
            error => LogError::Mcap(error),
        }
    }
}
