//! Contacts: what the bumper feels, and what the judge counts; the way that the robot came; and the edge of a map, which nothing feels.

use super::Simulation;
use super::sensors::Raw;
use crate::chassis::HALF_LENGTH;
use crate::world::is_beyond;
use afp_carbot::devices::{Bump, Navigator};
use afp_core::Instant;

/// The bumper covers the front face and this much of the sides, metres.
const WRAP: f64 = 0.02;

impl Simulation {
    /// Looks at what the robot touches after a step.
    pub(super) fn feel(&mut self, now: Instant) {
        let mut touched = false;
        self.stage.feel(now, |touch| touched |= touch.at[0] > HALF_LENGTH - WRAP);
        self.sensors.switch.step(touched);
    }

    /// Whether something or somebody presses the bumper.
    pub(super) fn is_touched(&self) -> bool {
        self.sensors.held || self.sensors.switch.says()
    }

    /// Remembers by what way the robot came and where the bumper is pressed, as far as it can tell.
    pub(super) fn note_motion(&mut self, now: Instant) {
        let Ok(at) = self.sensors.lines.odometry.read(Raw::odometry(self)).value else { return };
        self.trail.note(at, &self.body());
        if self.sensors.lines.touch.read(Raw::touch(self)).value == Ok(true) {
            self.bump = Some(Bump { at, time: now });
        }
    }

    /// Notes when the robot leaves the map.
    pub(super) fn look_for_edge(&mut self, now: Instant) {
        let at = self.position().translation;
        if self.left_map.is_none() && is_beyond(&self.map, [at.x, at.y].map(f64::from)) {
            self.left_map = Some(now);
        }
    }
}
