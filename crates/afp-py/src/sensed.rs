//! A robot's sensor values, which own their data.

use afp_session::{Image, Pose2, Ranging, SampleRef};
use numpy::{IntoPyArray, PyArray2, PyArrayMethods, ToPyArray};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;

/// A sensor value.
#[derive(Debug, PartialEq)]
pub enum Sensed {
    /// No measurement.
    Nothing,
    Truth(bool),
    Integer(i64),
    Number(f64),
    Text(String),
    Pair(f64, f64),
    /// A position and a heading.
    Pose(f64, f64, f64),
    /// As an array.
    Numbers(Vec<f64>),
    /// As an array of n x 2.
    Corners(Vec<[f64; 2]>),
    Picture {
        rows: usize,
        columns: usize,
        rgb: Vec<u8>,
    },
}

impl Sensed {
    /// Converts a sample of a signal; a range sensor without an echo gives infinity.
    pub fn of(sample: SampleRef<'_>) -> Sensed {
        match sample {
            SampleRef::Bool(truth) => Sensed::Truth(truth),
            SampleRef::Int(integer) => Sensed::Integer(integer),
            SampleRef::Float(number) => Sensed::Number(number),
            SampleRef::Text(text) => Sensed::Text(text.to_owned()),
            SampleRef::Pose(frame) => {
                let Pose2 { x, y, heading } = frame.pose;
                Sensed::Pose(x, y, heading)
            }
            SampleRef::Range(Ranging { range, .. }) => {
                Sensed::Number(range.unwrap_or(f64::INFINITY))
            }
            SampleRef::Image(Image { width, height, rgb, .. }) => {
                let size = |pixels| usize::try_from(pixels).unwrap_or(usize::MAX);
                Sensed::Picture { rows: size(height), columns: size(width), rgb: rgb.to_vec() }
            }
            SampleRef::Outline(shape) => Sensed::Corners(shape.outline.clone()),
        }
    }

    /// Converts the value to Python.
    pub fn into_bound(self, py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
        match self {
            Sensed::Nothing => Ok(py.None().into_bound(py)),
            Sensed::Truth(value) => value.into_bound_py_any(py),
            Sensed::Integer(value) => value.into_bound_py_any(py),
            Sensed::Number(value) => value.into_bound_py_any(py),
            Sensed::Text(value) => value.into_bound_py_any(py),
            Sensed::Pair(first, second) => (first, second).into_bound_py_any(py),
            Sensed::Pose(x, y, heading) => (x, y, heading).into_bound_py_any(py),
            Sensed::Numbers(values) => Ok(values.into_pyarray(py).into_any()),
            Sensed::Corners(corners) => Ok(table(py, &corners)?.into_any()),
            Sensed::Picture { rows, columns, rgb } => {
                Ok(rgb.into_pyarray(py).reshape([rows, columns, 3])?.into_any())
            }
        }
    }
}

/// Rows of equal length as an array that owns its numbers.
pub fn table<'py, const N: usize>(
    py: Python<'py>,
    rows: &[[f64; N]],
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let flat: Vec<f64> = rows.iter().flatten().copied().collect();
    flat.to_pyarray(py).reshape([rows.len(), N])
}
