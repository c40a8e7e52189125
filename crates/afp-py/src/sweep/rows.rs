//! Outcomes as Python rows, columns and groups.

use afp_sweep::{Cells, Ending, Outcome, Sweep, groups};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

/// Outcomes by column; each pair ends with the type.
///
/// # Errors
/// Python has no memory.
pub fn columns<'py>(
    py: Python<'py>,
    sweep: &Sweep,
    outcomes: &[Outcome],
) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for column in afp_sweep::columns(sweep, outcomes) {
        let (cells, kind) = match column.cells {
            Cells::Counts(all) => (all.into_bound_py_any(py)?, "count"),
            Cells::Numbers(all) => (all.into_bound_py_any(py)?, "number"),
            Cells::Texts(all) => (all.into_bound_py_any(py)?, "text"),
        };
        dict.set_item(column.name, (cells, kind))?;
    }
    Ok(dict)
}

/// An outcome as a row.
///
/// # Errors
/// Python has no memory.
pub fn row<'py>(py: Python<'py>, sweep: &Sweep, outcome: &Outcome) -> PyResult<Bound<'py, PyDict>> {
    let row = PyDict::new(py);
    for (name, column) in columns(py, sweep, std::slice::from_ref(outcome))? {
        let (cells, _): (Bound<'py, PyList>, String) = column.extract()?;
        row.set_item(name, cells.get_item(0)?)?;
    }
    Ok(row)
}

/// A group of runs: ending, place, reason, number of runs, first run.
type Alike = (&'static str, String, String, u64, u64);

/// Group runs, given as endings, places, reasons and numbers: returns each group with its number of
/// runs and the first of them; failures last.
#[pyfunction]
pub fn alike(runs: Vec<(String, String, String, u64)>) -> PyResult<Vec<Alike>> {
    let known = |name: &str| {
        let ending = Ending::ALL.into_iter().find(|ending| ending.name() == name);
        ending.ok_or_else(|| PyValueError::new_err(format!("no ending '{name}'")))
    };
    let runs = runs
        .iter()
        .map(|(ending, place, why, run)| Ok((known(ending)?, place.as_str(), why.as_str(), *run)));
    let groups = groups(runs.collect::<PyResult<Vec<_>>>()?.into_iter());
    Ok(groups
        .into_iter()
        .map(|it| (it.ending.name(), it.place, it.why, it.count, it.run))
        .collect())
}
