//! The optical sensors: infrared, colour and camera, each at its own rate.

use super::Simulation;
use crate::devices::camera::{self, Exposure};
use crate::devices::{color, infrared};
use crate::stage::STEP;
use crate::vehicle::Place;
use afp_carbot::devices::Reading;
use afp_core::{Duration, Instant};
use std::mem;
use std::sync::Arc;

impl Simulation {
    /// Updates the sensors whose time has come.
    pub(super) fn see(&mut self, now: Instant) {
        let robot = Place::new(self.position());
        let nth = |period: Duration| {
            let (step, every) = (self.steps, period.as_nanos() / STEP.as_nanos());
            step.is_multiple_of(every).then_some(step / every)
        };
        if nth(color::PERIOD).is_some() {
            let color = self.sensors.color_sensor.look(&self.scene, robot);
            self.sensors.color = Reading::valid(color, now);
        }
        if nth(infrared::PERIOD).is_some() {
            let glow = self.sensors.infrared.look(&self.lights, &self.scene, robot);
            self.sensors.glow = Reading::valid(glow, now);
        }
        if let Some(number) = nth(camera::PERIOD) {
            let exposure = Exposure::new(self.scene.clone(), robot, self.seed, number);
            let latest = Reading { time: now, value: Ok(Arc::new(exposure)) };
            self.sensors.exposed_before =
                mem::replace(&mut self.sensors.exposure, latest).value.ok();
        }
    }
}
