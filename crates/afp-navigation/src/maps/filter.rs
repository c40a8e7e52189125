//! The particle filter: possible places of the robot, moved with the odometry and weighted by
//! echoes.
//!
//! Each update takes constant work, except for the search of a lost robot. Only the constructor
//! allocates.

mod cloud;
mod memory;
mod search;
mod sonar;

use crate::maps::field::EchoField;
use afp_carbot::devices::{Beam, Belief};
use afp_carbot::history::Pose;
use afp_core::quantity::{Angle, Length};
use afp_platform::Noise;
use afp_session::Pose2;
use cloud::Cloud;
use memory::Memory;
use search::Rival;
use std::f64::consts::{PI, TAU};

/// An echo is used when the sensor has moved by this distance since the last one, in metres, or has
/// turned by this angle, in radians: two echoes from the same place have the same error.
const MOVED: f64 = 0.03;
const TURNED: f64 = 0.07;
/// A rival place must explain the latest echoes better than the belief by this margin, and this
/// number of them.
const BETTER: f64 = 0.08;
/// The minimum explanation by a rival: if much is missing on the map, no place explains the echoes
/// well.
const CONVINCING: f64 = 0.68;
const ENOUGH: usize = 32;
/// The minimum number of echoes that are not silence, which many places explain.
const HEARD: usize = 32;

/// A ping: the odometry's pose at its time, the sensor's bearing, and the echo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ping {
    /// The odometry's pose.
    pub robot: Pose,
    /// The bearing relative to the heading, in radians.
    pub bearing: f64,
    /// The distance in metres; `None` for silence.
    pub distance: Option<f64>,
}

/// The robot's place, estimated from all echoes.
#[derive(Clone, Debug)]
pub struct Filter {
    field: EchoField,
    /// The distance from the robot's centre to the sensor, in metres.
    forward: f64,
    noise: Noise,
    cloud: Cloud,
    memory: Memory,
    rival: Rival,
    /// The odometry of the particles' last motion.
    moved_to: Pose,
    /// The last used ping.
    weighed: Option<Ping>,
    belief: Pose2,
    /// How well the belief explains the remembered echoes.
    explained: f64,
}

impl Filter {
    /// A filter for a robot that knows its start to a decimetre and a few degrees, at the
    /// odometry's zero. `seed` determines the particles.
    pub fn new(field: EchoField, beam: &Beam, start: Pose2, seed: u64) -> Self {
        let mut noise = Noise::new(seed, "particles");
        let cloud = Cloud::around(start, &mut noise);
        Filter {
            field,
            forward: beam.forward.si(),
            noise,
            cloud,
            memory: Memory::default(),
            rival: Rival::default(),
            moved_to: Pose { x: 0.0, y: 0.0, heading: 0.0 },
            weighed: None,
            belief: start,
            explained: 1.0,
        }
    }

    /// Updates the filter with a ping.
    pub fn update(&mut self, ping: &Ping) {
        let moved = relative(self.moved_to, ping.robot);
        self.moved_to = ping.robot;
        self.cloud.drive(moved, &mut self.noise);
        self.belief = self.belief.beyond(moved);
        self.rival.drive(moved);
        if !self.is_news(ping) {
            return;
        }
        self.weighed = Some(*ping);
        self.memory.keep(ping);
        self.cloud.weigh(&self.field, self.forward, ping);
        let echoes = self.memory.seen_from(ping.robot, self.forward);
        self.explained = search::explained(&self.field, echoes, self.belief);
        if echoes.len() >= ENOUGH {
            let believed = (self.belief, self.explained);
            let excused = search::excused(&self.field, echoes, self.belief);
            let rival = self.rival.improve(&self.field, echoes, believed, &mut self.noise);
            let heard = echoes.iter().filter(|echo| echo.distance.is_some()).count();
            if let Some((place, explained)) = rival
                && heard >= HEARD
                && explained > CONVINCING.max(excused + BETTER)
            {
                self.cloud.add(place, &mut self.noise);
            }
        }
        self.cloud.resample(&mut self.noise);
        self.belief = self.cloud.densest(self.belief);
    }

    /// The robot's place, at the odometry of the last ping.
    pub fn belief(&self) -> Belief {
        let [spread, turn_spread] = self.cloud.spread(self.belief);
        Belief {
            x: Length::from_si(self.belief.x),
            y: Length::from_si(self.belief.y),
            heading: Angle::from_si(self.belief.heading),
            spread: Length::from_si(spread),
            heading_spread: Angle::from_si(turn_spread),
        }
    }

    /// How well the belief explains the latest echoes, from 0 to 1.
    pub fn explained(&self) -> f64 {
        self.explained
    }

    fn is_news(&self, ping: &Ping) -> bool {
        self.weighed.is_none_or(|last| {
            let moved = relative(last.robot, ping.robot);
            let turned = moved.heading + ping.bearing - last.bearing;
            libm::hypot(moved.x, moved.y) > MOVED || turned.abs() > TURNED
        })
    }
}

/// `to` in the frame of `from`; both are odometry poses.
pub(crate) fn relative(from: Pose, to: Pose) -> Pose2 {
    let [from, to] = [from, to].map(|Pose { x, y, heading }| Pose2 { x, y, heading });
    from.to(to)
}

/// The same direction within half a turn of zero.
pub(crate) fn wrap(angle: f64) -> f64 {
    // Most angles are already in range, and rounding takes time.
    if angle.abs() < PI { angle } else { angle - TAU * libm::round(angle / TAU) }
}
