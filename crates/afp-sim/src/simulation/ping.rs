//! The range sensor's rays in the engine's world, and the way of an echo.

use super::Simulation;
use super::build::{HIGH, ROBOT};
use crate::devices::sonar::{self, Hit};
use afp_carbot::devices::{Echo, Reading};
use afp_core::Instant;
use rapier2d::geometry::{InteractionGroups, InteractionTestMode};
use rapier2d::math::Vector;
use rapier2d::prelude::{QueryFilter, Ray};

impl Simulation {
    /// Sends a ping from where the sensor is now.
    pub(super) fn ping(&mut self, now: Instant) {
        let (at, turn) = (self.position().translation, self.position().rotation);
        let (sin, cos) = libm::sincos(self.rotator.position());
        let (re, im) = (f64::from(turn.re), f64::from(turn.im));
        let axis = (re * cos - im * sin, im * cos + re * sin);
        let origin = at + Vector::new(turn.re, turn.im) * sonar::FORWARD as f32;
        let heard = InteractionGroups::new(ROBOT, HIGH, InteractionTestMode::And);
        let queries = self.physics.query_pipeline_with_filter(QueryFilter::new().groups(heard));
        let range = self.sonar.ping(axis, |(x, y)| {
            let direction = Vector::new(x as f32, y as f32);
            let ray = Ray::new(origin, direction);
            let (of, hit) = queries.cast_ray_and_get_normal(&ray, sonar::MAX as f32, true)?;
            let cos = f64::from(-hit.normal.dot(direction));
            let of = self.physics.colliders[of].user_data as usize;
            let echo = self.obstacles.get(of).map_or(1.0, |obstacle| obstacle.echo);
            Some(Hit { range: f64::from(hit.time_of_impact), cos, echo })
        });
        let bearing = self.rotator.telemetry();
        let value = match range {
            Some(range) => sonar::beam().echo(range, bearing),
            None => Ok(Echo { distance: None, bearing }),
        };
        self.ping = Some((now + sonar::flight(range), Reading { time: now, value }));
    }

    /// Takes the echo that has arrived by now.
    pub(super) fn receive(&mut self) {
        if let Some((_, echo)) = self.ping.take_if(|(arrival, _)| *arrival <= self.now) {
            self.echo = echo;
        }
    }
}
