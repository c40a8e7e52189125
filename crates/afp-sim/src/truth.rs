//! The true state of the simulation, only for measures and logs.
//!
//! No device trait exposes it, so templates cannot read it.

use crate::chassis::Measures;
use crate::devices::camera::{self, Exposure};
use crate::stage::{Collision, Stage};
use afp_core::Instant;
pub use afp_session::Pose2 as Pose;
use rapier2d::math::Vector;
use rapier2d::parry::query;
use rapier2d::parry::shape::Segment;
use std::f64::consts::FRAC_PI_2;

/// The ground truth of a running simulation.
#[derive(Clone, Copy)]
pub struct Truth<'a> {
    pub(crate) now: Instant,
    pub(crate) stage: &'a Stage,
    pub(crate) measures: Measures,
    pub(crate) left_map: Option<Instant>,
    /// Metres and radians a second.
    pub(crate) motion: (f64, f64),
    /// The last command to the drive, in metres and radians a second.
    pub(crate) asked: (f64, f64),
    /// The two latest pictures of the camera.
    pub(crate) pictures: [Option<&'a Exposure>; 2],
}

/// A slower robot counts as stationary, in metres and radians a second: castors creep while they
/// come to rest.
const STANDING: (f64, f64) = (0.005, 0.02);

/// A slower motion into an obstacle counts as sliding along it, in metres a second.
const INTO: f64 = 0.01;

/// A wall is next to the robot if the distance square from its side is at most this multiple of the
/// nearest distance.
const BESIDE: f64 = 1.5;

impl<'a> Truth<'a> {
    /// The pose of the robot's centre.
    pub fn pose(&self) -> Pose {
        self.stage.pose()
    }

    /// Whether the robot is stationary: below 5 mm/s and 0.02 rad/s.
    pub fn is_standing(&self) -> bool {
        let (speed, turn) = self.motion;
        speed < STANDING.0 && turn.abs() < STANDING.1
    }

    /// Whether the last command to the drive was a stop, or there was no command.
    pub fn is_halted(&self) -> bool {
        self.asked == (0.0, 0.0)
    }

    /// The true motion of an object between the two latest pictures, from its column and row in the
    /// first one: to the right and down, in pixels. `None` for the sky, for an object that is
    /// hidden or outside of the second picture, and before there are two pictures.
    pub fn flow(&self, x: f64, y: f64) -> Option<[f64; 2]> {
        let [Some(before), Some(after)] = self.pictures else { return None };
        let [column, row] = camera::track(before, after, x, y)?;
        Some([column - x, row - y])
    }

    /// All collisions so far, in the order of their beginnings.
    pub fn collisions(&self) -> &'a [Collision] {
        self.stage.collisions()
    }

    /// The time when the robot's centre first left the map.
    pub fn left_map(&self) -> Option<Instant> {
        self.left_map
    }

    /// The current collisions, in the order of their beginnings.
    pub fn touching(&self) -> impl DoubleEndedIterator<Item = &'a Collision> {
        self.stage.touching(self.now)
    }

    /// The obstacles that the robot pushes against now, by their indices in
    /// [`crate::World::obstacles`]. It touches them, and the last command to its drive was a motion
    /// into them of at least a centimetre a second at the contact.
    pub fn pushing(&self) -> impl Iterator<Item = usize> + use<'a> {
        let (asked, touches) = (self.asked, self.stage.touches().iter());
        touches.filter(move |touch| touch.speed_into(asked) >= INTO).map(|touch| touch.obstacle)
    }

    /// Distance from the body's right side to the nearest obstacle that is high enough for the
    /// range sensor, in metres; `None` in an empty world.
    pub fn right_side_gap(&self) -> Option<f64> {
        let [x, y] = self.measures.half.map(|half| half as f32);
        let side = Segment::new(Vector::new(-x, -y), Vector::new(x, -y));
        let gaps = self.stage.obstacles.iter().zip(&self.stage.shapes).filter_map(
            |(obstacle, (at, shape))| {
                let high = self.stage.chassis.hears(obstacle.height);
                high.then(|| query::distance(self.stage.position(), &side, at, &**shape).ok())
                    .flatten()
            },
        );
        gaps.map(|gap| f64::from(gap.distance)).reduce(f64::min)
    }

    /// The same distance if a wall is next to the robot. A wall is next to it if the distance
    /// square from its side, at either end or the middle, is not much larger. `None` at the end of
    /// a wall, where the nearest place is the corner behind the robot.
    pub fn right_side_wall(&self) -> Option<f64> {
        let gap = self.right_side_gap()?;
        let [length, width] = self.measures.half;
        let most = width + BESIDE * gap;
        let is_near = |ahead: f64| self.stage.ray(ahead, -FRAC_PI_2, most).is_some();
        [-length, 0.0, length].into_iter().any(is_near).then_some(gap)
    }
}
