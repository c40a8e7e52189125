//! Drive along a wall on the right side.
//!
//! The range sensor mostly points square at the wall. It glances ahead in between, more often if an
//! obstacle is near. Between glances the distance driven is subtracted from the last glance.
//! Steering follows a line through the latest echoes of the wall, so that a glance or a dropout
//! does not disturb it.

mod glance;
mod track;

#[cfg(test)]
mod tests;

use crate::devices::{Echo, Motion, Navigator, Odometry, Rotator, Ultrasonic};
use crate::helpers::aside::Aside;
use crate::helpers::guard::{Arrival, Guard, LATE, NO_ODOMETRY};
use crate::helpers::motion::wrap;
use crate::helpers::tracking::Tracking;
use crate::templates;
use crate::templates::wall_forward::{Inputs, Live, State};
use afp_core::quantity::Angle;
use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};
use glance::Glance;
use track::Track;

/// Heading towards the wall per metre of deviation at gain 1, radians.
const APPROACH: f64 = 4.0;
/// The steepest heading against the wall, radians.
const STEEPEST: f64 = 35.0 / 180.0 * core::f64::consts::PI;
/// Turn rate per radian of heading error.
const STEERING: f64 = 4.0;
/// The fastest turn, radians a second.
const FASTEST_TURN: f64 = 1.4;
/// A heading error of this size halves the speed, radians.
const SLOWING: f64 = 20.0 / 180.0 * core::f64::consts::PI;
/// The wall has ended after this distance without an echo, metres.
const LOST: f64 = 0.35;
/// There is no wall after this many silent looks at its side, if the robot has driven far enough.
const LOOKS: u8 = 3;
/// An echo counts up to this angle between the beam and the wall's normal, radians.
const SQUARE: f64 = 25.0 / 180.0 * core::f64::consts::PI;
/// The step is complete when less than this is left, metres.
const CLOSE: f64 = 0.004;

/// Follows a wall on the right at a distance from the body's side.
#[derive(Clone, Debug)]
pub struct WallForward {
    inputs: Inputs,
    tracking: Tracking,
    odometry: Guard,
    range: Guard,
    arrival: Arrival,
    last_ping: Instant,
    course: Option<Course>,
    /// The final state, reported when the robot has stopped.
    ending: Option<State>,
    aside: Aside,
}

/// Progress since the first odometry.
#[derive(Clone, Debug)]
struct Course {
    last: Motion,
    /// Distance driven, metres.
    driven: f64,
    /// `driven` at the last echo of the wall that was near enough.
    heard: f64,
    /// Pings square to the expected wall, as far as they count.
    looks: u8,
    track: Track,
    glance: Glance,
}

impl<E> Actor<templates::WallForward, E> for WallForward
where
    E: Navigator + Odometry + Ultrasonic + Rotator + ?Sized,
{
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        env.point(Angle::from_si(0.0), now);
        Ok(WallForward {
            inputs,
            tracking: Tracking::new(now),
            odometry: Guard::new(NO_ODOMETRY, now),
            range: Guard::of_echoes(now),
            arrival: Arrival::new(now),
            last_ping: now,
            course: None,
            ending: None,
            aside: Aside::default(),
        })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        let Some(motion) = self.odometry.current(env.motion(), now)? else {
            self.tracking.halt(env, now);
            return Ok(Poll::Pending);
        };
        if let Some(ending) = self.ending {
            self.tracking.halt(env, now);
            return Ok(if motion.stands() { Poll::Ready(ending) } else { Poll::Pending });
        }
        let resumed = self.aside.check(&motion)?;
        let heard = (env.beam().max + env.beam().forward - env.body().front).si();
        let course = self.course.get_or_insert_with(|| Course::new(motion, &self.inputs, heard));
        match resumed {
            true => course.resume(motion, &self.inputs, heard),
            false => course.advance(motion),
        }
        let reading = env.echo();
        if let Some(echo) = self.range.next(reading, self.last_ping, now)? {
            self.last_ping = reading.time;
            course.on_echo(&echo, &self.inputs, env);
            if course.glance.looking() {
                self.arrival.elsewhere(&echo, now)?;
            }
        }
        self.ending = course.ending(&self.inputs);
        if self.ending.is_some() {
            self.tracking.halt(env, now);
            return Ok(Poll::Pending);
        }
        self.aim(env, now);
        self.steer(env, now)?;
        Ok(Poll::Pending)
    }

    halts_when_interrupted!();
}

/// The line of the wall stays in place. The robot looks ahead again before it drives on.
impl<E> Resumable<templates::WallForward, E> for WallForward
where
    E: Navigator + Odometry + Ultrasonic + Rotator + ?Sized,
{
    fn suspend(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        self.tracking.halt(env, now);
        self.aside = Aside::at(env, now);
        Ok(())
    }

    fn resume(&mut self, _: &mut E, now: Instant, _: Duration) -> Result<(), Fault> {
        self.tracking = Tracking::new(now);
        self.odometry.restart(now);
        self.range.restart(now);
        self.last_ping = now;
        self.arrival = Arrival::new(now);
        Ok(())
    }
}

impl WallForward {
    /// Points the sensor at the wall or ahead.
    fn aim<E: Rotator + ?Sized>(&mut self, env: &mut E, now: Instant) {
        let Some(course) = &mut self.course else { return };
        if course.glance.turns(course.driven) {
            self.arrival = Arrival::new(now);
        }
        env.point(Angle::from_si(course.bearing()), now);
    }

    /// Commands the speed and turn rate that lead to the wanted distance.
    ///
    /// # Errors
    /// As [`Tracking::drive`].
    fn steer<E: Navigator + ?Sized>(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        let Some(course) = &self.course else { return Ok(()) };
        // The robot waits for the first glance ahead, and stops without echoes long before the
        // guard's timeout.
        if course.glance.free(course.driven).is_none() || now.since(self.last_ping) > LATE {
            self.tracking.halt(env, now);
            return Ok(());
        }
        let side = env.body().half_width.si();
        let away = course.track.distance(&course.last);
        let away = away.map_or(0.0, |away| away - side - self.inputs.walldist.si());
        let wanted = (-self.inputs.gain * APPROACH * away).clamp(-STEEPEST, STEEPEST);
        let heading = wrap(course.last.heading.si() - course.track.heading());
        let off = wanted - heading;
        let turn = (STEERING * off).clamp(-FASTEST_TURN, FASTEST_TURN);
        let rest = self.inputs.step.si() - course.driven;
        let slowed = self.inputs.speed.si() / (1.0 + (off / SLOWING) * (off / SLOWING));
        let speed = self.tracking.speed(rest, slowed, now);
        self.tracking.drive(env, &course.last, (speed, turn), now)
    }
}

impl Course {
    /// `heard` is the sensor's range beyond the front, metres.
    fn new(motion: Motion, inputs: &Inputs, heard: f64) -> Self {
        Course {
            last: motion,
            driven: 0.0,
            heard: 0.0,
            looks: 0,
            track: Track::new(motion.heading.si()),
            glance: Glance::new(inputs.lanedist.si(), inputs.speed.si(), heard),
        }
    }

    fn advance(&mut self, motion: Motion) {
        let (dx, dy) = ((motion.x - self.last.x).si(), (motion.y - self.last.y).si());
        self.driven += libm::sqrt(dx * dx + dy * dy);
        self.last = motion;
    }

    /// Continues after a suspension. The distance along the wall counts, back and forth.
    fn resume(&mut self, motion: Motion, inputs: &Inputs, heard: f64) {
        let (sin, cos) = libm::sincos(self.track.heading());
        let (dx, dy) = ((motion.x - self.last.x).si(), (motion.y - self.last.y).si());
        self.driven += dx * cos + dy * sin;
        self.last = motion;
        self.glance = Glance::new(inputs.lanedist.si(), inputs.speed.si(), heard);
    }

    /// The sensor's target bearing: square at the wall, or ahead for a glance.
    fn bearing(&self) -> f64 {
        self.glance.bearing().unwrap_or_else(|| self.square())
    }

    /// The bearing of the wall's normal.
    fn square(&self) -> f64 {
        let heading = self.last.heading.si();
        wrap(self.track.heading() - core::f64::consts::FRAC_PI_2 - heading)
    }

    /// Uses an echo for the wall or for the lane ahead, by the sensor's bearing.
    fn on_echo<E: Navigator + Ultrasonic + ?Sized>(
        &mut self,
        echo: &Echo,
        inputs: &Inputs,
        env: &E,
    ) {
        let (beam, body) = (env.beam(), env.body());
        let bearing = echo.bearing.si();
        let distance = echo.distance.map(|distance| distance.si());
        let beyond_front = body.front.si() - beam.forward.si();
        self.glance.on_echo(bearing, distance.map(|d| d - beyond_front), self.driven);
        let slant = wrap(bearing - self.square()).abs();
        self.looks = self.looks.saturating_add(u8::from(slant < SQUARE));
        let Some(distance) = distance.filter(|_| slant < SQUARE) else { return };
        let forward = beam.forward.si();
        let square = distance * libm::cos((slant - beam.opening.si() / 2.0).max(0.0));
        let gap = self.track.of_centre(&self.last, forward, square) - body.half_width.si();
        if gap <= inputs.walldist.si() + inputs.tolerance.si() {
            self.heard = self.driven;
            self.track.add(&self.last, forward, square);
        }
    }

    /// The final state, if the drive ends now.
    fn ending(&self, inputs: &Inputs) -> Option<State> {
        if self.glance.blocked(self.driven, self.last.speed.si()) {
            return Some(State::LaneNotFree);
        }
        let absent = self.looks >= LOOKS && self.track.distance(&self.last).is_none();
        if self.driven - self.heard > if absent { inputs.absent.si().min(LOST) } else { LOST } {
            return Some(State::WallLost);
        }
        (inputs.step.si() - self.driven < CLOSE).then_some(State::ForwardSuccessful)
    }
}
