//! From a ping to the plan's reading of its echo.

use super::Simulation;
use crate::devices::sonar;
use afp_carbot::devices::{Echo, Reading, Ultrasonic};
use afp_core::Instant;

impl Simulation {
    pub(super) fn ping(&mut self, now: Instant) {
        let rays = self.stage.rays(self.measures.sonar);
        let range =
            self.sensors.sonar.ping_along(rays.along(self.sensors.rotator.position()), &rays);
        let bearing = self.sensors.rotator.telemetry();
        let value = match range {
            Some(range) => self.beam().echo(range, bearing),
            None => Ok(Echo { distance: None, bearing }),
        };
        self.sensors.ping = Some((now + sonar::flight(range), Reading { time: now, value }));
    }

    pub(super) fn receive(&mut self) {
        if let Some((_, echo)) = self.sensors.ping.take_if(|(arrival, _)| *arrival <= self.now) {
            self.sensors.echo = echo;
        }
    }
}
