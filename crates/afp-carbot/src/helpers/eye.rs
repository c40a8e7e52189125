//! Looks for an object in the camera's pictures, each picture once.

use crate::devices::{Camera, Invalid, Reading};
use crate::helpers::sighting::Sighting;
use crate::objects::Appearance;

/// Knows an object and what the latest picture shows of it.
#[derive(Clone, Debug)]
pub(crate) struct Eye {
    look: Appearance,
    /// The number of the latest picture.
    number: u64,
    latest: Reading<Option<Sighting>>,
}

impl Eye {
    /// For an object of this appearance. No picture has been looked at yet.
    pub(crate) fn new(look: Appearance, env: &(impl Camera + ?Sized)) -> Self {
        let before = env.frame();
        // What the camera shows now was taken before somebody asked.
        let number = before.value.map_or(0, |frame| frame.number);
        Eye { look, number, latest: Reading::invalid(Invalid::NotYet, before.time) }
    }

    /// What the latest picture shows; of the same picture the same reading, whenever the camera says it was taken.
    pub(crate) fn look(&mut self, env: &(impl Camera + ?Sized)) -> Reading<Option<Sighting>> {
        let Reading { time, value } = env.frame();
        match value {
            Ok(frame) if frame.number != self.number => {
                self.number = frame.number;
                self.latest = Reading::valid(self.look.find(&frame, &env.lens()), time);
                self.latest
            }
            Ok(_) => self.latest,
            Err(reason) => Reading::invalid(reason, time),
        }
    }
}
