//! `Moment`: saved episodes.

use std::sync::PoisonError;

use pyo3::prelude::*;

use super::batch::{Batch, Place};
use super::course::{Course, Outcome};
use crate::errors::error;
use crate::value::no_pickle;

/// Episodes at a moment, from which they can continue any number of times.
#[pyclass(module = "afp", frozen)]
pub struct Moment {
    places: Vec<Saved>,
}

struct Saved {
    course: Option<Course>,
    seen: Vec<f32>,
    outcome: Outcome,
}

#[pymethods]
impl Moment {
    fn __reduce__(&self) -> PyResult<()> {
        Err(no_pickle("saved episode", "save it again"))
    }
}

impl Moment {
    /// Copies all episodes of a batch.
    ///
    /// # Errors
    /// An episode cannot be copied.
    pub fn of(batch: &Batch) -> PyResult<Moment> {
        let saved = batch.places().map(|place| {
            let place = place.unwrap_or_else(PoisonError::into_inner);
            Ok(Saved {
                course: copied(place.course.as_ref())?,
                seen: place.seen.clone(),
                outcome: place.outcome,
            })
        });
        Ok(Moment { places: saved.collect::<PyResult<_>>()? })
    }

    /// Puts copies into a batch with the same task.
    ///
    /// # Errors
    /// The batch has another number of episodes or other observations.
    pub fn restore(&self, batch: &Batch) -> PyResult<()> {
        let fits = |saved: &Saved| saved.seen.len() == batch.bounds.len();
        if self.places.len() != batch.len() || !self.places.iter().all(fits) {
            return Err(error("the moment is of other episodes"));
        }
        for (saved, place) in self.places.iter().zip(batch.places()) {
            let mut place = place.unwrap_or_else(PoisonError::into_inner);
            let course = copied(saved.course.as_ref())?;
            let (seen, outcome) = (saved.seen.clone(), saved.outcome);
            *place = Place { course, seen, outcome, ..Place::default() };
        }
        Ok(())
    }
}

fn copied(course: Option<&Course>) -> PyResult<Option<Course>> {
    let none = || error("the robot of this episode cannot be copied");
    course.map(|course| course.keyframe().ok_or_else(none)).transpose()
}
