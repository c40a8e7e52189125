//! Drive along an arc.

use crate::devices::{Motion, Navigator, Odometry};
use crate::helpers::aside::Aside;
use crate::helpers::motion::wrap;
use crate::helpers::tracking::{DRIVE_STALLED, Tracking};
use crate::helpers::turning::{CLOSE, Progress, Turning};
use crate::templates;
use crate::templates::curve::{Inputs, Live, State};
use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};

/// An arc is complete when the distance left is below this, metres, and the angle below that of a
/// turn in place.
const CLOSE_WAY: f64 = 0.004;
/// After a suspension: turn rate per radian of heading error, heading towards the arc per metre of
/// distance from it, and the largest of these.
const HOLD: f64 = 2.5;
const APPROACH: f64 = 4.0;
const STEEPEST: f64 = 0.5;
/// Tolerated difference from the arc's length: this share of it, plus this many metres while the
/// wheels are being steered.
const OFF_ARC: f64 = 0.25;
const STEERED: f64 = 0.1;

/// Drives an arc until the heading has turned by an angle, by odometry.
#[derive(Clone, Debug)]
pub struct Curve {
    turning: Turning,
    angle: f64,
    radius: f64,
    speed: f64,
    tracking: Tracking,
    /// Distance driven so far, metres, and the motion counted there.
    driven: f64,
    last: Option<Motion>,
    /// The centre of the arc, metres; `None` before the first poll.
    centre: Option<[f64; 2]>,
    aside: Aside,
    /// Whether it was suspended, and steers back to the arc.
    resumed: bool,
}

impl<E: Navigator + Odometry + ?Sized> Actor<templates::Curve, E> for Curve {
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        let close = CLOSE.min(CLOSE_WAY / inputs.radius.si());
        Ok(Curve {
            turning: Turning::new(inputs.angle, close, env, now)?,
            angle: inputs.angle.si(),
            radius: inputs.radius.si(),
            speed: inputs.speed.si(),
            tracking: Tracking::new(now),
            driven: 0.0,
            last: None,
            centre: None,
            aside: Aside::default(),
            resumed: false,
        })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        match self.turning.progress(env, now)? {
            Progress::Unknown => self.tracking.halt(env, now),
            Progress::Left(left, motion) => {
                self.resumed |= self.aside.check(&motion)?;
                self.check_arc(self.angle - left, motion)?;
                let speed = self.tracking.speed(left.abs() * self.radius, self.speed, now);
                let rate = speed.copysign(left) / self.radius + self.correction(&motion);
                self.tracking.drive(env, &motion, (speed, rate), now)?;
            }
            Progress::Turned { by, stands } => {
                self.tracking.halt(env, now);
                if stands {
                    return Ok(Poll::Ready(State::CurveSuccessful { turned: by }));
                }
            }
        }
        Ok(Poll::Pending)
    }

    halts_when_interrupted!();
}

/// The arc and its end stay in place.
impl<E: Navigator + Odometry + ?Sized> Resumable<templates::Curve, E> for Curve {
    fn suspend(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        self.tracking.halt(env, now);
        self.aside = Aside::at(env, now);
        Ok(())
    }

    fn resume(&mut self, _: &mut E, now: Instant, _: Duration) -> Result<(), Fault> {
        self.tracking = Tracking::new(now);
        self.turning.resume(now);
        self.last = None;
        Ok(())
    }
}

impl Curve {
    /// The additional turn rate towards the arc, radians a second. A stop on the way leads the
    /// robot off the arc, because the inner wheel stops earlier.
    fn correction(&mut self, motion: &Motion) -> f64 {
        let side = 1_f64.copysign(self.angle);
        let (x, y, heading) = (motion.x.si(), motion.y.si(), motion.heading.si());
        let (sin, cos) = libm::sincos(heading);
        let to_centre = side * self.radius;
        let [centre_x, centre_y] =
            *self.centre.get_or_insert([x - to_centre * sin, y + to_centre * cos]);
        if !self.resumed {
            return 0.0;
        }
        let (dx, dy) = (x - centre_x, y - centre_y);
        let outside = libm::hypot(dx, dy) - self.radius;
        let along = libm::atan2(dy, dx) + side * core::f64::consts::FRAC_PI_2;
        let wanted = along + side * (APPROACH * outside).clamp(-STEEPEST, STEEPEST);
        HOLD * wrap(wanted - heading)
    }

    /// Compares the distance driven with the angle turned. The distance of a suspension is not
    /// counted.
    ///
    /// A wheel that lags changes the arc, even if each part of the arc is close to the command.
    ///
    /// # Errors
    /// [`DRIVE_STALLED`] if the robot drives a different arc.
    fn check_arc(&mut self, turned: f64, motion: Motion) -> Result<(), Fault> {
        let arc = self.radius * turned.abs();
        match self.last.replace(motion) {
            Some(last) => {
                self.driven += libm::hypot((motion.x - last.x).si(), (motion.y - last.y).si());
            }
            None => self.driven = arc,
        }
        let off = (self.driven - arc).abs();
        if off > STEERED + OFF_ARC * arc { Err(DRIVE_STALLED) } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;
    use crate::helpers::guard::NO_ODOMETRY;
    use afp_core::quantity::{Angle, Length, Speed};

    fn curve(robot: &mut Fake, degrees: f64) -> Result<Option<State>, Fault> {
        let (radius, speed) = (Length::from_si(0.5), Speed::from_si(0.2));
        let inputs = Inputs { radius, angle: Angle::from_deg(degrees), speed };
        robot.run::<templates::Curve, Curve>(inputs, || Live {}, 40)
    }

    #[test]
    fn a_quarter_of_a_circle_ends_next_to_its_centre() {
        for degrees in [90.0_f64, -90.0] {
            let mut robot = Fake::new(&[]);
            let state = curve(&mut robot, degrees);
            let Ok(Some(State::CurveSuccessful { turned })) = state else { panic!("{state:?}") };
            assert!((turned.si().to_degrees() - degrees).abs() < 1.0, "{turned:?}");
            let (x, y) = (robot.motion.x.si(), robot.motion.y.si());
            assert!((x - 0.5).abs() < 0.01 && (y - 0.5 * degrees.signum()).abs() < 0.01, "{x} {y}");
        }
    }

    #[test]
    fn a_wide_arc_is_driven_to_its_end() {
        for (radius, degrees) in [(10.0, 20.0), (100.0, 2.0)] {
            let mut robot = Fake::new(&[]);
            let (angle, speed) = (Angle::from_deg(degrees), Speed::from_si(0.2));
            let inputs = Inputs { radius: Length::from_si(radius), angle, speed };
            let state = robot.run::<templates::Curve, Curve>(inputs, || Live {}, 40);
            assert!(matches!(state, Ok(Some(_))), "{state:?}");
            let end = radius * angle.si().sin();
            assert!((robot.motion.x.si() - end).abs() < 0.01, "{radius}: {:?}", robot.motion);
        }
    }

    #[test]
    fn a_whole_circle_leads_back() {
        let mut robot = Fake::new(&[]);
        assert!(matches!(curve(&mut robot, 360.0), Ok(Some(_))));
        assert!(robot.motion.x.si().abs() < 0.01 && robot.motion.y.si().abs() < 0.01);
    }

    #[test]
    fn a_wrong_arc_is_a_fault() {
        // Both commands are close enough at every instant, but neither gives a circle of 50 cm.
        for follows in [(0.6, 1.0), (1.0, 0.6)] {
            let mut robot = Fake::new(&[]);
            robot.follows = follows;
            assert_eq!(curve(&mut robot, 270.0), Err(DRIVE_STALLED), "{follows:?}");
        }
        let mut robot = Fake::new(&[]);
        robot.follows = (0.9, 1.0);
        assert!(matches!(curve(&mut robot, 270.0), Ok(Some(_))), "its circle is a little smaller");
    }

    #[test]
    fn faults_without_odometry() {
        let mut robot = Fake::new(&[]);
        robot.dead_odometry = true;
        assert_eq!(curve(&mut robot, 90.0), Err(NO_ODOMETRY));
    }
}
