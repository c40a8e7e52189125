//! Contacts for the bumper and the judge, the robot's path, and the edge of a map, which no sensor
//! feels.

use super::Simulation;
use super::sensors::Raw;
use crate::world::is_beyond;
use afp_carbot::devices::{Bump, Navigator};
use afp_core::Instant;

/// The bumper covers the front and this length of the sides, in metres.
const WRAP: f64 = 0.02;

impl Simulation {
    pub(super) fn feel(&mut self, now: Instant) {
        let mut touched = false;
        let front = self.measures.half[0];
        self.stage.feel(now, |touch| touched |= touch.at[0] > front - WRAP);
        self.sensors.switch.step(touched);
    }

    /// Whether an obstacle or a hand presses the bumper.
    pub(super) fn is_touched(&self) -> bool {
        self.sensors.held || self.sensors.switch.says()
    }

    /// Records the robot's path and the place of the bumper's press, from the odometry.
    pub(super) fn note_motion(&mut self, now: Instant) {
        let Ok(at) = self.sensors.lines.odometry.read(Raw::odometry(self)).value else { return };
        self.trail.note(at, &self.body());
        if self.sensors.lines.touch.read(Raw::touch(self)).value == Ok(true) {
            self.bump = Some(Bump { at, time: now });
        }
    }

    /// Records when the robot leaves the map.
    pub(super) fn look_for_edge(&mut self, now: Instant) {
        let at = self.position().translation;
        if self.left_map.is_none() && is_beyond(&self.map, [at.x, at.y].map(f64::from)) {
            self.left_map = Some(now);
        }
    }
}
