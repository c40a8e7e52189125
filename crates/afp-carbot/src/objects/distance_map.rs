//! How far it is in every direction, as a sweep of the range sensor has heard it.

use crate::helpers::line_fit::{MOST, Return};
use heapless::Vec;

/// One echo for each bearing of a sweep, in the order of the bearings; against the heading at which it was made.
#[derive(Clone, Debug, Default)]
pub struct DistanceMap {
    returns: Vec<Return, MOST>,
}

impl DistanceMap {
    /// Adds the next bearing. A sweep has fewer steps than there is room for; what is too much does not count.
    pub(crate) fn add(&mut self, heard: Return) {
        let _ = self.returns.push(heard);
    }

    /// What was heard at each bearing, from one side to the other; infinitely far away where nothing was.
    pub(crate) fn returns(&self) -> &[Return] {
        &self.returns
    }
}
