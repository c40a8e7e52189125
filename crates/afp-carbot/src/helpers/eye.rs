//! Looks for an object in the camera's pictures, each picture once.

use crate::devices::{Camera, Invalid, Reading};
use crate::helpers::sighting::Sighting;
use crate::objects::Appearance;

/// An object's appearance and its latest sighting.
#[derive(Clone, Debug)]
pub(crate) struct Eye {
    look: Appearance,
    /// Number of the latest picture.
    number: u64,
    latest: Reading<Option<Sighting>>,
}

impl Eye {
    /// Ignores the current picture.
    pub(crate) fn new(look: Appearance, env: &(impl Camera + ?Sized)) -> Self {
        let before = env.frame();
        // The current picture is older than this call.
        let number = before.value.map_or(0, |frame| frame.number);
        Eye { look, number, latest: Reading::invalid(Invalid::NotYet, before.time) }
    }

    /// The sighting in the latest picture. The reading stays the same for the same picture, even if
    /// the camera changes its time.
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
