//! A robot that drives around by echoes and contacts, and looks to all sides.

use afp_carbot::devices::{
    Localisation, Navigator, RotatingTelemetry, Rotator, TouchSensor, Ultrasonic,
};
use afp_core::quantity::{Angle, AngularSpeed, Speed};
use afp_core::{Duration, Instant};
use afp_sim::parts::Chassis;
use afp_sim::{Pose, Simulation, World};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::Rng;

pub(crate) struct Wanderer {
    pub(crate) robot: Simulation,
    random: Pcg32,
    /// End and values of the current motion, in metres and radians a second.
    doing: (Instant, f64, f64),
    looks_left: bool,
}

impl Wanderer {
    pub(crate) fn new(world: &World, seed: u64) -> Self {
        let robot = Simulation::new(world, seed).unwrap();
        let (random, doing) = (Pcg32::new(seed, 1), (Instant::ZERO, 0.2, 0.0));
        Wanderer { robot, random, doing, looks_left: true }
    }

    /// 10 ms.
    pub(crate) fn tick(&mut self) {
        let now = self.robot.now() + Duration::from_millis(10);
        self.robot.advance_to(now);
        self.robot.belief(now).unwrap();
        self.look_about(now);
        let until = |seconds: f64| now + Duration::from_secs_f64(seconds);
        if self.robot.touched().value == Ok(true) {
            self.doing = (until(1.0), -0.15, 0.0);
        } else if now >= self.doing.0 {
            let turn = if self.random.next_u32() & 1 == 0 { 0.8 } else { -0.8 };
            let long = 0.5 + f64::from(self.random.next_u32() % 200) / 100.0;
            let blocked = self.is_near() || self.doing.1 < 0.0;
            self.doing = if blocked { (until(long), 0.0, turn) } else { (now, 0.2, 0.0) };
        }
        let (_, speed, turn) = self.doing;
        self.robot.drive(Speed::from_si(speed), AngularSpeed::from_si(turn), now);
    }

    fn look_about(&mut self, now: Instant) {
        let bearing = self.robot.bearing().value.unwrap().si();
        if bearing.abs() > 1.7 {
            self.looks_left = bearing < 0.0;
        }
        let ahead = if self.looks_left { 0.4 } else { -0.4 };
        self.robot.point(Angle::from_si(bearing + ahead), now);
    }

    fn is_near(&self) -> bool {
        self.robot.echo().value.is_ok_and(|echo| {
            let distance = echo.distance.map_or(f64::INFINITY, |distance| distance.si());
            distance < 0.45 && echo.bearing.si().abs() < 0.7
        })
    }

    /// A random place in the room with space for the robot.
    pub(crate) fn free_place(&mut self, world: &World) -> Pose {
        let [low, high] = world.audible_map(&Chassis::CARBOT).bounds();
        let mut unit = || f64::from(self.random.next_u32()) / f64::from(u32::MAX);
        loop {
            let [x, y] = [0, 1].map(|i| low[i] + 0.3 + (high[i] - low[i] - 0.6) * unit());
            let place = Pose { x, y, heading: 6.0 * unit() };
            if world.obstacle_at(place).is_none() {
                return place;
            }
        }
    }
}
