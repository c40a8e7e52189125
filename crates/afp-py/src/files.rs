//! Texts of files as everything of the project reads and writes them: with a bound, and whole.

use std::path::PathBuf;

use pyo3::prelude::*;

use crate::errors::os_error;

/// The text of a file with its own line ends; `what` says what cannot be done where it cannot be read.
#[pyfunction]
pub fn read_text(py: Python<'_>, what: &str, path: PathBuf) -> PyResult<String> {
    let read = py.detach(|| afp_output::read_text(&path));
    read.map_err(|why| os_error(what, &path, &why))
}

/// Writes a text to a file that appears under its name only when it is whole.
#[pyfunction]
pub fn write_text(py: Python<'_>, what: &str, path: PathBuf, text: &str) -> PyResult<()> {
    let written = py.detach(|| afp_output::write_whole(&path, text.as_bytes()));
    written.map_err(|why| os_error(what, &path, &why))
}
