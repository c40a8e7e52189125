//! Files are read with a size limit and written atomically, as everywhere in the project.

use std::path::PathBuf;

use pyo3::prelude::*;

use crate::errors::os_error;

/// Read a file with its own line ends; `what` describes the failed action in an error.
#[pyfunction]
pub fn read_text(py: Python<'_>, what: &str, path: PathBuf) -> PyResult<String> {
    let read = py.detach(|| afp_output::read_text(&path));
    read.map_err(|why| os_error(what, &path, &why))
}

/// Write a file atomically.
#[pyfunction]
pub fn write_text(py: Python<'_>, what: &str, path: PathBuf, text: &str) -> PyResult<()> {
    let written = py.detach(|| afp_output::write_whole(&path, text.as_bytes()));
    written.map_err(|why| os_error(what, &path, &why))
}
