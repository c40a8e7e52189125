//! The contacts of the robot: the obstacle, the place on the robot's outside, and the active actor.

use std::fmt;

use afp_core::trace::{ComponentKind, Names, Record};
use afp_core::{Duration, Instant};
use afp_sim::{Collision, HALF_LENGTH, HALF_WIDTH, Pose, World};

/// The number of tested places on each edge of an obstacle's outline.
const PLACES: u32 = 200;

#[derive(Clone, Debug)]
pub struct Contact {
    /// The obstacle, as an index into [`World::obstacles`].
    pub obstacle: usize,
    pub at: Instant,
    /// The path of the last actor; empty before the first start.
    pub actor: String,
    /// The place on the robot's outside: ahead and to the left of its middle, in metres.
    pub place: [f64; 2],
}

/// The records needed to describe contacts: actors in the order of their starts, and the robot's
/// poses.
#[derive(Clone, Debug, Default)]
pub(crate) struct Diary {
    pub(crate) actors: Vec<(Instant, String)>,
    /// The poses at a fixed interval, from the beginning on.
    pub(crate) poses: Vec<Pose>,
}

impl Diary {
    /// Records an actor's start.
    pub(crate) fn on_record(&mut self, at: Instant, record: &Record<'_>, names: &impl Names) {
        if let Record::Started { component } = record {
            let component = names.component(*component);
            if component.kind == ComponentKind::Actor {
                self.actors.push((at, component.path.to_owned()));
            }
        }
    }

    /// The contacts of a run with its poses at the interval `every`; obstacles are at their initial
    /// places.
    pub(crate) fn contacts(
        &self,
        world: &World,
        collisions: &[Collision],
        every: Duration,
    ) -> Vec<Contact> {
        let contact = |it: &Collision| {
            let before = self.actors.partition_point(|(at, _)| *at < it.begin);
            let actor = self.actors[..before].last().map(|(_, path)| path.clone());
            let look = (it.begin.as_nanos() / every.as_nanos()) as usize;
            let pose = self.poses.get(look).or(self.poses.last()).copied();
            let corners = world.obstacles.get(it.obstacle).map(|it| it.outline.corners());
            let place = pose.zip(corners).map(|(pose, corners)| nearest(pose, &corners));
            let (actor, place) = (actor.unwrap_or_default(), place.unwrap_or_default());
            Contact { obstacle: it.obstacle, at: it.begin, actor, place }
        };
        collisions.iter().map(contact).collect()
    }
}

/// The point of a convex outline that is nearest to the robot's outside, relative to the robot.
fn nearest(pose: Pose, corners: &[[f64; 2]]) -> [f64; 2] {
    let (sin, cos) = pose.heading.sin_cos();
    let seen = |[x, y]: [f64; 2]| {
        let (x, y) = (x - pose.x, y - pose.y);
        [x * cos + y * sin, y * cos - x * sin]
    };
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let places = edges.flat_map(|(a, b)| {
        let share = |n| f64::from(n) / f64::from(PLACES);
        (0..PLACES).map(move |n| [0, 1].map(|i| a[i] + (b[i] - a[i]) * share(n)))
    });
    let off = |[x, y]: &[f64; 2]| (x.abs() - HALF_LENGTH).max(y.abs() - HALF_WIDTH);
    places.map(seen).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or_default()
}

impl fmt::Display for Contact {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [ahead, left] = self.place;
        let end = if ahead > HALF_LENGTH / 2.0 {
            "front"
        } else if ahead < -HALF_LENGTH / 2.0 {
            "rear"
        } else {
            "middle"
        };
        let side = if left > HALF_WIDTH / 2.0 {
            "left"
        } else if left < -HALF_WIDTH / 2.0 {
            "right"
        } else {
            "middle"
        };
        write!(f, "{} at {} ({end} {side})", self.actor, self.at)
    }
}
