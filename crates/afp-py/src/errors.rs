//! The exceptions of the package.

use std::fmt::Display;
use std::io;
use std::path::Path;

use pyo3::create_exception;
use pyo3::exceptions::{PyException, PyOSError};
use pyo3::prelude::*;

use afp_dsl::Compiled;
use afp_log::LogError;
use afp_run::RunError;

use crate::plan::diagnostics;

create_exception!(afp, AfpError, PyException, "An error of a plan, world, log or run.");
create_exception!(afp, PlanError, AfpError, "A plan with errors; `diagnostics` has them.");

/// An [`AfpError`] with this message.
pub fn error(message: impl Display) -> PyErr {
    let text = message.to_string();
    AfpError::new_err(text.strip_prefix("error: ").unwrap_or(&text).to_owned())
}

/// The exception of a run: `OSError` for an unreadable file, [`AfpError`] otherwise.
pub fn run_error(why: &RunError) -> PyErr {
    match why {
        RunError::File { what, path, error } => os_error(what, path, error),
        RunError::Log(why) => log_error(why),
        other => error(other),
    }
}

/// The exception of a log that cannot be written or read, like [`run_error`].
pub fn log_error(why: &LogError) -> PyErr {
    match why {
        LogError::Create { path, error } => os_error("cannot write the log", path, error),
        LogError::Open { path, error } => os_error("cannot read the log", path, error),
        other => error(other),
    }
}

/// Python selects the subclass of `OSError` by the number.
pub fn os_error(what: &str, path: &Path, why: &io::Error) -> PyErr {
    let text = why.to_string();
    // Python adds the number itself.
    let text = text.split(" (os error").next().unwrap_or_default();
    match why.raw_os_error().or_else(|| number_of(why.kind())) {
        Some(number) => {
            PyOSError::new_err((number, format!("{what}: {text}"), path.display().to_string()))
        }
        None => PyOSError::new_err(format!("{what}: {text}: '{}'", path.display())),
    }
}

/// The error number for an error found without the system; it is the same on all systems.
fn number_of(kind: io::ErrorKind) -> Option<i32> {
    match kind {
        io::ErrorKind::NotFound => Some(2),
        io::ErrorKind::PermissionDenied => Some(13),
        io::ErrorKind::ResourceBusy => Some(16),
        io::ErrorKind::IsADirectory => Some(21),
        io::ErrorKind::InvalidInput => Some(22),
        io::ErrorKind::FileTooLarge => Some(27),
        _ => None,
    }
}

/// The exception for a plan without a graph.
pub fn plan_error(py: Python<'_>, compiled: &Compiled) -> PyErr {
    let text = compiled.render(false);
    let why = PlanError::new_err(text.trim_end().to_owned());
    match why.value(py).setattr("diagnostics", diagnostics(compiled)) {
        Ok(()) => why,
        Err(other) => other,
    }
}
