//! Whether the robot stands when it should.

use afp_core::{Duration, Instant};
use afp_sim::{Pose, Simulation};

/// A robot that goes no faster stands: metres and radians a second.
const STANDS: (f64, f64) = (0.006, 0.026);
/// The controller stops by itself when it has heard nothing for so long.
const DEAD_MAN: Duration = Duration::from_millis(200);
/// What was pushed comes to rest within this, on a floor that grips.
const PUSHED: Duration = Duration::from_millis(300);
/// The fastest that the robot goes, metres a second, and what of the weight brakes: the grip of the
/// two wheels that drive, and the castors.
const FASTEST: f64 = 0.31;
/// What friction has to brake of a turn, too, as a speed for each rad/s: the moment of inertia about the turning centre by
/// mass and half the track, and as much again, since it cannot brake both at once; metres.
const TURNING: f64 = 0.32;
const GRIP: f64 = 0.7 * 9.81 / 2.0;
const ROLLING: f64 = 0.02 * 9.81 / 2.0;

/// Watches the robot while the command is zero.
#[derive(Debug)]
pub(super) struct Stand {
    /// Since when the command is zero; none while it is not.
    since: Option<Instant>,
    /// When a command last came.
    commanded: Instant,
    /// How fast it turned when it was last commanded to move, rad/s.
    turned: f64,
    /// The time that the templates declare.
    stop: Duration,
    /// When and where it was last looked at.
    last: (Instant, Pose),
    /// From when to when the floor is how slippery.
    slippery: Vec<(Instant, Instant, f64)>,
    /// From when to when the controller hears nothing.
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

    /// Looks at the robot; says so if it moves but should not.
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

    /// How long the robot may take that was told to stand at an instant.
    fn allowed(&self, since: Instant) -> Duration {
        let deaf = self.deaf.iter().any(|(from, until)| *from <= since && since < *until);
        let heard = if deaf { DEAD_MAN } else { Duration::ZERO };
        let slide = self.slide(since, since + heard + self.stop);
        heard + self.stop + slide
    }

    /// For how much longer than until `due` the robot may slide that should stand since an instant; not at all on a floor
    /// that grips.
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

    /// Whether something has touched the robot since, or so short a time before that it may not have come to rest.
    fn pushed(&self, sim: &Simulation, then: Instant) -> bool {
        let mut touches = sim.truth().collisions().iter();
        touches.any(|touch| touch.end + PUSHED + self.slide(touch.end, touch.end + PUSHED) >= then)
    }
}
