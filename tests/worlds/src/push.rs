//! The pushes of the robot against obstacles, with its estimated motion.

use std::fmt;

use afp_carbot::devices::Motion;
use afp_core::{Duration, Instant};
use afp_sim::Pose;

use crate::witness::Witness;

/// Pushes of one obstacle within this time count as one.
const APART: Duration = Duration::from_millis(300);

/// A time span in which the robot touched an obstacle and its drive was commanded to move into it.
#[derive(Clone, Debug)]
pub struct Push {
    /// The name of the obstacle.
    pub what: String,
    /// Its start and end, each with the robot's true pose and its odometry.
    ends: [(Instant, Pose, Option<Motion>); 2],
}

/// The pushes of a run, oldest first.
#[derive(Clone, Debug, Default)]
pub struct Pushes(Vec<Push>);

impl Pushes {
    /// Checks whether the robot pushes against an obstacle, and records it.
    pub(crate) fn look(&mut self, robot: &Witness, names: &[String]) -> bool {
        let truth = robot.sim.truth();
        let Some(obstacle) = truth.pushing().next() else { return false };
        let what = names.get(obstacle).cloned().unwrap_or_default();
        let end = (robot.sim.now(), truth.pose(), robot.counted.get());
        match self.0.last_mut() {
            Some(last) if last.what == what && end.0.since(last.ends[1].0) <= APART => {
                last.ends[1] = end;
            }
            _ => self.0.push(Push { what, ends: [end, end] }),
        }
        true
    }
}

impl fmt::Display for Pushes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|push| writeln!(f, "{push}"))
    }
}

impl fmt::Display for Push {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [(from, a, before), (to, b, after)] = &self.ends;
        write!(f, "pushes against '{}' from {from} to {to} at {:.2} {:.2}", self.what, a.x, a.y)?;
        let turned = |a: f64, b: f64| (b - a).to_degrees();
        let way = (b.x - a.x).hypot(b.y - a.y);
        write!(f, ", {:.0} deg", a.heading.to_degrees())?;
        write!(f, ": goes {way:.2} m and turns {:.0} deg", turned(a.heading, b.heading))?;
        let Some((before, after)) = before.zip(*after) else { return Ok(()) };
        let way = (after.x - before.x).si().hypot((after.y - before.y).si());
        let angle = turned(before.heading.si(), after.heading.si());
        write!(f, "; by odometry {way:.2} m and {angle:.0} deg")
    }
}
