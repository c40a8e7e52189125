//! Commands the drive and detects that the robot does not follow.

use crate::devices::{Motion, Navigator};
use crate::helpers::motion::{ACCELERATION, Ramp, TURN_ACCELERATION};
use afp_core::quantity::{AngularSpeed, Speed};
use afp_core::{Duration, Fault, Instant, faults};

faults! {
    /// The wheels are stationary despite a command.
    pub DRIVE_BLOCKED = "drive-blocked",
        "the wheels did not turn for 300 ms although commanded; check for an obstacle or an empty battery";
    /// The robot's motion differs from the command.
    pub DRIVE_STALLED = "drive-stalled",
        "the robot did not move as commanded for 300 ms: a wheel does not follow, or the battery is low";
    /// The odometry counts no distance.
    pub NO_PROGRESS = "no-progress",
        "the robot was commanded to drive 10 cm, but the odometry counted less than a quarter of it";
    /// The drive cannot turn in place.
    pub NO_TURN_IN_PLACE = "no-turn-in-place",
        "the robot was commanded to turn in place, which its drive cannot do";
}

/// How long the motion may differ from the command: motors lag and wheels need steering.
pub const TOLERATED: Duration = Duration::from_millis(300);

/// Assumed time constant of the drive, seconds.
const LAG: f64 = 0.15;
/// Slower commands are not judged: metres a second at the body's side.
const SLOWEST: f64 = 0.008;
/// Relative errors above `ERROR` count fully and below `SLACK` reduce the count; values between
/// count in part.
const ERROR: f64 = 0.4;
const SLACK: f64 = 0.2;
/// The robot is stationary below this share of the expected speed.
const STANDSTILL: f64 = 0.25;
/// Commanded distance after which the odometry must have counted, metres at the body's side.
const JUDGED: f64 = 0.1;
/// A longer gap between polls resets the comparison.
const LONGEST_GAP: Duration = Duration::from_millis(100);

/// Commands a drive and compares the odometry with the commands.
///
/// The speed profiles are included, so that driving after a halt starts from standstill.
#[derive(Clone, Debug)]
pub(crate) struct Tracking {
    speed: Ramp,
    turn: Ramp,
    last: Option<(Instant, Motion)>,
    command: (f64, f64),
    /// Expected motion by now: metres and radians a second.
    expected: (f64, f64),
    /// Time of unexpected motion, seconds. Expected motion reduces it gradually, so that wheels
    /// that slip through now and then do not hide a blockage.
    astray: f64,
    /// Expected and counted distance since the last comparison, metres at the body's side.
    distances: (f64, f64),
}

impl Tracking {
    /// Starts from standstill.
    pub(crate) fn new(now: Instant) -> Self {
        Tracking {
            speed: Ramp::new(ACCELERATION, now),
            turn: Ramp::new(TURN_ACCELERATION, now),
            last: None,
            command: (0.0, 0.0),
            expected: (0.0, 0.0),
            astray: 0.0,
            distances: (0.0, 0.0),
        }
    }

    /// The speed for now with `rest` metres to go, at most `cruise`.
    pub(crate) fn speed(&mut self, rest: f64, cruise: f64, now: Instant) -> f64 {
        self.speed.rate(rest, cruise, now)
    }

    /// The turn rate for now with `rest` radians to go (negative: right), at most `cruise` to
    /// either side.
    pub(crate) fn turn(&mut self, rest: f64, cruise: f64, now: Instant) -> f64 {
        self.turn.rate(rest.abs(), cruise, now).copysign(rest)
    }

    /// Commands a motion: metres a second ahead, radians a second to the left; `motion` is the
    /// latest odometry.
    ///
    /// # Errors
    /// [`DRIVE_BLOCKED`], [`DRIVE_STALLED`] or [`NO_PROGRESS`] if the robot did not follow earlier
    /// commands. The motion is then not commanded, and the platform learns of a blocked forward
    /// drive. [`NO_TURN_IN_PLACE`] if the robot cannot follow the command at all.
    pub(crate) fn drive<E: Navigator + ?Sized>(
        &mut self,
        env: &mut E,
        motion: &Motion,
        (speed, turn): (f64, f64),
        now: Instant,
    ) -> Result<(), Fault> {
        if let Err(fault) = self.compare(motion, env.body().lever().si(), now) {
            if self.command.0 > 0.0 {
                env.note_blocked(now);
            }
            return Err(fault);
        }
        let (speed, turn) = (Speed::from_si(speed), AngularSpeed::from_si(turn));
        let (able, ably) = env.reduced(speed, turn);
        let in_place = speed.si() == 0.0 && turn.si() != 0.0;
        if in_place && ably.si() == 0.0 {
            return Err(NO_TURN_IN_PLACE);
        }
        self.command = (able.si(), ably.si());
        env.drive(speed, turn, now);
        Ok(())
    }

    /// Commands a standstill, which is not judged.
    pub(crate) fn halt<E: Navigator + ?Sized>(&mut self, env: &mut E, now: Instant) {
        *self = Tracking::new(now);
        env.halt(now);
    }

    fn compare(&mut self, motion: &Motion, lever: f64, now: Instant) -> Result<(), Fault> {
        let before = self.last.replace((now, *motion));
        let Some((last, before)) = before.filter(|(at, _)| now.since(*at) <= LONGEST_GAP) else {
            (self.astray, self.distances) = (0.0, (0.0, 0.0));
            self.expected = (motion.speed.si(), motion.turn.si());
            return Ok(());
        };
        let gap = now.since(last).as_secs_f64();
        let share = (gap / LAG).min(1.0);
        self.expected.0 += share * (self.command.0 - self.expected.0);
        self.expected.1 += share * (self.command.1 - self.expected.1);
        self.check_speed(motion, gap, lever)?;
        self.check_distance([&before, motion], gap, lever)
    }

    fn check_speed(&mut self, motion: &Motion, gap: f64, lever: f64) -> Result<(), Fault> {
        let (speed, turn) = (motion.speed.si(), motion.turn.si());
        let expected = rim(self.expected, lever);
        let error = self.error((speed, turn), lever);
        let share = if expected < SLOWEST { 0.0 } else { error / expected };
        let counts = ((share - SLACK) / (ERROR - SLACK)).clamp(-1.0, 1.0);
        self.astray = (self.astray + gap * counts).max(0.0);
        if self.astray <= TOLERATED.as_secs_f64() {
            return Ok(());
        }
        let stands = rim((speed, turn), lever) < STANDSTILL * expected;
        Err(if stands { DRIVE_BLOCKED } else { DRIVE_STALLED })
    }

    /// Distance of a motion from the range between a slow drive's response and the command, metres
    /// a second at the body's side. A drive without lag is not an error.
    fn error(&self, (speed, turn): (f64, f64), lever: f64) -> f64 {
        let (slow, command) = (self.expected, self.command);
        let (along, across) = (command.0 - slow.0, (command.1 - slow.1) * lever);
        let length = along * along + across * across;
        let (ahead, aside) = (speed - slow.0, (turn - slow.1) * lever);
        let share = if length > 0.0 { (ahead * along + aside * across) / length } else { 0.0 };
        let share = share.clamp(0.0, 1.0);
        libm::hypot(ahead - share * along, aside - share * across)
    }

    fn check_distance(
        &mut self,
        [before, motion]: [&Motion; 2],
        gap: f64,
        lever: f64,
    ) -> Result<(), Fault> {
        let length = libm::hypot((motion.x - before.x).si(), (motion.y - before.y).si());
        let (expected, counted) = &mut self.distances;
        *expected += gap * rim(self.expected, lever);
        *counted += rim((length, (motion.heading - before.heading).si()), lever);
        if *expected < JUDGED {
            return Ok(());
        }
        let enough = *counted >= STANDSTILL * *expected;
        self.distances = (0.0, 0.0);
        if enough { Ok(()) } else { Err(NO_PROGRESS) }
    }
}

/// Speed, or distance, of a body's side, by its [`Body::lever`](crate::devices::Body::lever).
fn rim((ahead, turn): (f64, f64), lever: f64) -> f64 {
    libm::hypot(ahead, turn * lever)
}

#[cfg(test)]
mod tests;
