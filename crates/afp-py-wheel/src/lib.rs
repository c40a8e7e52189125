//! The native half of the Python package in wheels: the Carbot, and access to the extensions of
//! projects.

use std::path::{Path, PathBuf};

use afp_build::{NotBuilt, Parts, Product};
use afp_project::ProjectFile;
use afp_py::pyo3;
use afp_py::pyo3::prelude::*;
use afp_toolboxes::project::OwnToolboxes;

/// The native half of the package `afp`.
#[pymodule]
#[pyo3(crate = "afp_py::pyo3")]
fn _afp(module: &Bound<'_, PyModule>) -> PyResult<()> {
    afp_py::fill(module, afp_py::carbot(&[], |_| {}))?;
    module.add_function(pyo3::wrap_pyfunction!(extension, module)?)
}

/// The extension with the robot and the toolboxes of the project in a folder, built on demand;
/// `None` if the project has neither.
#[pyfunction]
#[pyo3(crate = "afp_py::pyo3")]
fn extension(py: Python<'_>, folder: PathBuf) -> PyResult<Option<PathBuf>> {
    py.detach(|| build(&folder)).map_err(|why| match why {
        NotBuilt::Why(why) => afp_py::run_error(&why),
        NotBuilt::Told { first } => {
            let first = first.map(|first| format!(": {first}")).unwrap_or_default();
            let more = "standard error has the compiler's messages";
            afp_py::error(format!("the project's Rust does not compile{first}; {more}"))
        }
    })
}

fn build(folder: &Path) -> Result<Option<PathBuf>, NotBuilt> {
    let own = OwnToolboxes::read(ProjectFile::find(folder)?)?;
    let parts = Parts::of_project(&own)?;
    if parts.is_empty() { Ok(None) } else { parts.product(Product::Extension).map(Some) }
}
