//! Whether the robot has stopped when it should.

use afp_core::{Duration, Instant};
use afp_sim::{Pose, Simulation};

/// The speeds below which the robot counts as stopped, in metres and radians per second.
const STANDS: (f64, f64) = (0.006, 0.026);
/// The time without commands after which the controller stops by itself.
const DEAD_MAN: Duration = Duration::from_millis(200);
/// The time in which a pushed robot comes to rest on a gripping floor.
const PUSHED: Duration = Duration::from_millis(300);
/// The largest speed of the robot in metres per second, and the share of the weight that brakes:
/// the grip of the two driven wheels, and the castors.
const FASTEST: f64 = 0.31;
/// The additional speed for friction to brake per rad/s of a turn, in metres: the moment of inertia
/// about the turning centre divided by mass and half the track, doubled, since friction cannot
/// brake both motions at once.
const TURNING: f64 = 0.32;
const GRIP: f64 = 0.7 * 9.81 / 2.0;
const ROLLING: f64 = 0.02 * 9.81 / 2.0;

/// Watches the robot while the command is zero.
#[derive(Debug)]
pub(super) struct Stand {
    /// The time since which the command is zero; `None` while it is not.
    since: Option<Instant>,
    /// The time of the last command.
    commanded: Instant,
    /// The turn rate at the last command to move, in rad/s.
    turned: f64,
    /// The stop time of the templates.
    stop: Duration,
    /// The time and the pose of the last check.
    last: (Instant, Pose),
    /// The times of slippery floors, with their friction.
    slippery: Vec<(Instant, Instant, f64)>,
    /// The times in which the controller receives nothing.
    deaf: Vec<(Instant, Instant)>,
}

impl Stand {
    pub(super) fn new(pose: Pose, stop: Duration) -> Self {
        Stand {
            since: Some(Instant::ZERO),
            commanded: Instant::ZERO,
            turned: 0.0,
            stop,
            last: (Instant::ZERO, pose),
            slippery: Vec::new(),
            deaf: Vec::new(),
        }
    }

    pub(super) fn commanded(&mut self, zero: bool, now: Instant) {
        // Without commands the controller has stopped by itself.
        let expired = self.commanded + DEAD_MAN;
        let before = self.since.or((expired < now).then_some(expired));
        self.since = if zero { before.or(Some(now)) } else { None };
        self.commanded = now;
    }

    pub(super) fn slippery(&mut self, from: Instant, until: Instant, grip: f64) {
        self.slippery.push((from, until, grip));
    }

    pub(super) fn deaf(&mut self, from: Instant, until: Instant) {
        self.deaf.push((from, until));
    }

    /// Checks the robot, and returns an error if it moves but should not.
    pub(super) fn look(&mut self, sim: &Simulation) -> Option<String> {
        let (now, pose) = (sim.now(), sim.truth().pose());
        let (then, before) = std::mem::replace(&mut self.last, (now, pose));
        let seconds = now.since(then).as_secs_f64();
        if seconds == 0.0 {
            return None;
        }
        let speed = (pose.x - before.x).hypot(pose.y - before.y) / seconds;
        let turned = pose.heading - before.heading;
        let turned = turned - (turned / std::f64::consts::TAU).round() * std::f64::consts::TAU;
        let turn = (turned / seconds).abs();
        if self.since.is_none() {
            self.turned = turn;
        }
        let since = self.since.unwrap_or(self.commanded + DEAD_MAN);
        if then < since + self.allowed(since) || self.pushed(sim, then) {
            return None;
        }
        (speed > STANDS.0 || turn > STANDS.1).then(|| {
            let after = now.since(since);
            format!("it moves with {speed:.3} m/s and {turn:.3} rad/s, {after} after the command to stand")
        })
    }

    /// The time that the robot may take to stop after a command at an instant.
    fn allowed(&self, since: Instant) -> Duration {
        let deaf = self.deaf.iter().any(|(from, until)| *from <= since && since < *until);
        let heard = if deaf { DEAD_MAN } else { Duration::ZERO };
        let slide = self.slide(since, since + heard + self.stop);
        heard + self.stop + slide
    }

    /// The additional time after `due` that a robot may slide after a command to stop; zero on a
    /// gripping floor.
    fn slide(&self, since: Instant, due: Instant) -> Duration {
        let horizon = due + Duration::from_secs(3);
        let slips =
            self.slippery.iter().filter(|(from, until, _)| *from < horizon && since < *until);
        let grip = slips.map(|(_, _, grip)| *grip).fold(1.0, f64::min);
        match grip < 1.0 {
            true => {
                Duration::from_secs_f64((FASTEST + TURNING * self.turned) / (GRIP * grip + ROLLING))
            }
            false => Duration::ZERO,
        }
    }

    /// Whether an obstacle has touched the robot since then, or so shortly before that it may still
    /// be moving.
    fn pushed(&self, sim: &Simulation, then: Instant) -> bool {
        let mut touches = sim.truth().collisions().iter();
        touches.any(|touch| touch.end + PUSHED + self.slide(touch.end, touch.end + PUSHED) >= then)
    }
}
