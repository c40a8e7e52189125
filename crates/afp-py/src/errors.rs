//! The exceptions of the package.

use std::fmt::Display;

use pyo3::create_exception;
use pyo3::exceptions::{PyException, PyOSError};
use pyo3::prelude::*;

use afp_dsl::Compiled;
use afp_run::RunError;

use crate::plan::diagnostics;

create_exception!(afp, AfpError, PyException, "What goes wrong with plans, worlds, logs and runs.");
create_exception!(afp, PlanError, AfpError, "A plan with errors; `diagnostics` has them.");

/// An [`AfpError`] that says this.
pub fn error(message: impl Display) -> PyErr {
    let text = message.to_string();
    AfpError::new_err(text.strip_prefix("error: ").unwrap_or(&text).to_owned())
}

/// The exception that tells of a file that cannot be read is `OSError`, of anything else [`AfpError`].
pub fn run_error(why: &RunError) -> PyErr {
    match why {
        RunError::File { what, path, error } => {
            let text = format!("{what} '{}'", path.display());
            match error.raw_os_error() {
                Some(number) => PyOSError::new_err((number, text, path.display().to_string())),
                None => PyOSError::new_err(format!("{text}: {error}")),
            }
        }
        other => error(other),
    }
}

/// The exception for a plan that has no graph.
pub fn plan_error(py: Python<'_>, compiled: &Compiled) -> PyErr {
    let text = compiled.render(false);
    let why = PlanError::new_err(text.trim_end().to_owned());
    match why.value(py).setattr("diagnostics", diagnostics(compiled)) {
        Ok(()) => why,
        Err(other) => other,
    }
}
