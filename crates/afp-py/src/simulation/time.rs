//! Times from Python, in seconds.

use afp_core::{Duration, Instant};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// An instant from seconds.
pub fn instant(seconds: f64) -> PyResult<Instant> {
    Ok(Instant::ZERO + duration(seconds)?)
}

/// A positive duration from seconds.
pub fn some(what: &str, seconds: f64) -> PyResult<Duration> {
    match duration(seconds)? {
        Duration::ZERO => {
            let text = format!("{what} is {seconds} s, which takes no time; give more");
            Err(PyValueError::new_err(text))
        }
        time => Ok(time),
    }
}

/// A duration from seconds.
pub fn duration(seconds: f64) -> PyResult<Duration> {
    match seconds.is_finite() && seconds >= 0.0 {
        true => Ok(Duration::from_secs_f64(seconds)),
        false => {
            Err(PyValueError::new_err(format!("{seconds} is not a time from 0 on, in seconds")))
        }
    }
}
