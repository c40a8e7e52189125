//! Distance in every direction, from a sweep of the range sensor.

use crate::helpers::line_fit::{MOST, Return};
use heapless::Vec;

/// One echo for each bearing of a sweep, in order, against the heading of the sweep.
#[derive(Clone, Debug, Default)]
pub struct DistanceMap {
    returns: Vec<Return, MOST>,
}

impl DistanceMap {
    /// Adds the next bearing. A sweep has fewer steps than the capacity; further bearings are
    /// dropped.
    pub(crate) fn add(&mut self, heard: Return) {
        let _ = self.returns.push(heard);
    }

    /// The echoes from one side to the other; infinitely far away if nothing was heard.
    pub(crate) fn returns(&self) -> &[Return] {
        &self.returns
    }
}
