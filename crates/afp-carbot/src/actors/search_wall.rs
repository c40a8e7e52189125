//! Look around and find the wall.
//!
//! A wide sweep also shows obstacles along that wall. The robot then turns further, into the corner
//! or out of the nook, until the lane is free.
//!
//! The bumper feels obstacles below the range sensor's beam. A recent bump counts as a wall if the
//! robot would hit it again; otherwise the wall would lead the robot there repeatedly.

use crate::devices::{Bump, Motion, Navigator, Odometry, RotatingTelemetry, Rotator, Ultrasonic};
use crate::helpers::line_fit::{MOST, Return, fit};
use crate::helpers::motion::wrap;
use crate::helpers::sweep::Sweep;
use crate::templates;
use crate::templates::search_wall::{Inputs, Live, State};
use afp_core::quantity::Angle;
use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};
use heapless::Vec;

/// The turn from a wall's bearing that puts it on the right side.
const QUARTER: f64 = core::f64::consts::FRAC_PI_2;

/// Extra turn away from a bump, radians: the sensor does not hear the obstacle, so the robot must
/// leave it.
const AWAY: f64 = 30.0 / 180.0 * core::f64::consts::PI;
/// Echoes farther aside than this are not from a wall that the robot faces, radians.
const FACED: f64 = 62.0 / 180.0 * core::f64::consts::PI;
/// The lane along the wall is blocked by an echo nearer than `AHEAD` to the robot's front and
/// within `BESIDE` of its side, in metres. The robot then turns further by up to `STEPS` steps of
/// `STEP` radians, into a corner or out of a nook.
const AHEAD: f64 = 0.25;
const BESIDE: f64 = 0.03;
const STEP: f64 = 5.0 / 180.0 * core::f64::consts::PI;
const STEPS: u32 = 24;
/// An older bump is ignored: the obstacle may be gone and the odometry may have drifted.
const RECENT: Duration = Duration::from_secs(15);
/// The robot looks around again before it meets a bump farther away than this, metres.
const NEAR: f64 = 1.0;

/// Sweeps the range sensor from side to side and fits one wall to the echoes.
#[derive(Clone, Debug)]
pub struct SearchWall {
    sweep: Sweep,
    range: f64,
    returns: Vec<Return, MOST>,
}

impl<E> Actor<templates::SearchWall, E> for SearchWall
where
    E: Navigator + Odometry + Ultrasonic + Rotator + RotatingTelemetry + ?Sized,
{
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        let sweep = Sweep::new(inputs.sweep, env, now);
        Ok(SearchWall { sweep, range: inputs.range.si(), returns: Vec::new() })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        let Some(heard) = self.sweep.poll(env, now)? else { return Ok(Poll::Pending) };
        let heard_at = Return::of(&heard.echo);
        if heard_at.range <= self.range {
            // A sweep has fewer steps than `MOST`.
            let _ = self.returns.push(heard_at);
        }
        if !heard.last {
            return Ok(Poll::Pending);
        }
        let body = env.body();
        let bump = env.last_bump().filter(|bump| now.since(bump.time) <= RECENT);
        let felt = bump.zip(env.motion().value.ok()).map(|(bump, motion)| {
            Felt::new(&bump, &motion, [body.front.si(), body.half_width.si()])
        });
        let lane = Lane {
            sensor: env.beam().forward.si(),
            ahead: body.front.si() + AHEAD,
            aside: body.half_width.si() + BESIDE,
        };
        Ok(Poll::Ready(self.result(env.beam().opening.si() / 2.0, felt, lane)))
    }

    halts_when_interrupted!();
}

/// The distances that were heard before count on, because the robot stays in place.
impl<E> Resumable<templates::SearchWall, E> for SearchWall
where
    E: Navigator + Odometry + Ultrasonic + Rotator + RotatingTelemetry + ?Sized,
{
    fn suspend(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        self.sweep.suspend(env, now);
        Ok(())
    }

    fn resume(&mut self, _: &mut E, now: Instant, _: Duration) -> Result<(), Fault> {
        self.sweep.resume(now);
        Ok(())
    }
}

impl SearchWall {
    fn result(&self, half_beam: f64, felt: Option<Felt>, lane: Lane) -> State {
        let mut ahead = Vec::<Return, MOST>::new();
        for faced in self.returns.iter().filter(|it| it.bearing.abs() <= FACED) {
            // `ahead` holds as many as `returns`.
            let _ = ahead.push(*faced);
        }
        let Some(wall) = fit(&ahead, half_beam) else { return State::NoWallFound };
        let along = lane.free_from(wall.bearing + QUARTER, &self.returns);
        let felt = felt.filter(|felt| felt.is_met(along));
        let angle = felt.map_or(along, |felt| wrap(felt.facing) + QUARTER + AWAY);
        State::WallFound { angle: Angle::from_si(angle) }
    }
}

/// Space that the robot needs after it has turned along the wall, metres from its turning centre.
#[derive(Clone, Copy, Debug)]
struct Lane {
    /// Distance of the range sensor ahead of the turning centre.
    sensor: f64,
    ahead: f64,
    aside: f64,
}

impl Lane {
    /// Returns the first bearing from `along` to the left with a free lane; `along` if there is
    /// none.
    fn free_from(&self, along: f64, returns: &[Return]) -> f64 {
        let mut bearings = (0..=STEPS).map(|step| along + f64::from(step) * STEP);
        bearings.find(|bearing| !returns.iter().any(|it| self.holds(*bearing, it))).unwrap_or(along)
    }

    fn holds(&self, bearing: f64, heard: &Return) -> bool {
        let (sin, cos) = libm::sincos(heard.bearing);
        let (x, y) = (self.sensor + heard.range * cos, heard.range * sin);
        let (sin, cos) = libm::sincos(bearing);
        let (along, across) = (x * cos + y * sin, y * cos - x * sin);
        (0.0..self.ahead).contains(&along) && across.abs() < self.aside
    }
}

/// A bump, relative to the robot's current pose.
#[derive(Clone, Copy, Debug)]
struct Felt {
    /// Metres ahead and to the left.
    at: [f64; 2],
    /// The bumper's direction against the current heading.
    facing: f64,
    /// The robot passes the bump at a greater lateral distance than this, metres.
    aside: f64,
}

impl Felt {
    /// `front` and `side` are the extent of the body.
    fn new(bump: &Bump, now: &Motion, [front, side]: [f64; 2]) -> Self {
        let facing = (bump.at.heading - now.heading).si();
        let (ahead, left) = bump.at.seen_from(now);
        let (sin, cos) = libm::sincos(facing);
        // The obstacle may be as wide as the bumper.
        let at = [ahead.si() + front * cos, left.si() + front * sin];
        Felt { at, facing, aside: 2.0 * side }
    }

    /// Whether the robot hits it again if it turns to a bearing and drives on.
    fn is_met(&self, bearing: f64) -> bool {
        let (sin, cos) = libm::sincos(bearing);
        let [ahead, left] = self.at;
        let (along, across) = (ahead * cos + left * sin, left * cos - ahead * sin);
        (0.0..NEAR).contains(&along) && across.abs() < self.aside
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::{Fake, Plane, plane};
    use crate::helpers::guard::{NO_RANGE, STUCK_ROTATOR};
    use afp_core::Duration;
    use afp_core::quantity::{AngularSpeed, Length, Speed};

    fn search(robot: &mut Fake) -> Result<Option<State>, Fault> {
        search_to(60.0, robot)
    }

    fn search_to(degrees: f64, robot: &mut Fake) -> Result<Option<State>, Fault> {
        let inputs = Inputs { sweep: Angle::from_deg(degrees), range: Length::from_si(1.5) };
        robot.run::<templates::SearchWall, SearchWall>(inputs, || Live {}, 10)
    }

    fn found(walls: &[Plane]) -> f64 {
        let state = search(&mut Fake::new(walls));
        let Ok(Some(State::WallFound { angle })) = state else { panic!("{state:?}") };
        angle.si().to_degrees()
    }

    #[test]
    fn the_turn_puts_the_wall_on_the_right() {
        for normal in [-40.0, -30.0, 0.0, 25.0] {
            let turn = found(&[plane(normal, 0.7)]);
            assert!((turn - (normal + 90.0)).abs() < 3.0, "{normal}: {turn}");
        }
    }

    #[test]
    fn in_a_corner_the_wall_ahead_is_found_and_not_the_wall_at_the_side() {
        let turn = found(&[plane(0.0, 0.5), plane(-90.0, 0.475)]);
        assert!((turn - 90.0).abs() < 3.0, "{turn}");
    }

    #[test]
    fn in_a_nook_it_turns_as_far_as_it_has_looked() {
        let walls = [plane(0.0, 0.5), plane(90.0, 0.35)];
        let turn = |degrees| match search_to(degrees, &mut Fake::new(&walls)) {
            Ok(Some(State::WallFound { angle })) => angle.si().to_degrees(),
            state => panic!("{state:?}"),
        };
        assert!((turn(110.0) - 145.0).abs() < 25.0, "{}: back along the left wall", turn(110.0));
        assert!((turn(60.0) - 90.0).abs() < 3.0, "{}: it has not looked there", turn(60.0));
    }

    /// The turn for a wall on the right and a bump straight ahead, `seconds` after the bump.
    fn after_bump(x: f64, y: f64, seconds: u64) -> f64 {
        let mut robot = Fake::new(&[plane(-60.0, 0.7)]);
        robot.now = Instant::ZERO + Duration::from_secs(60);
        let at = Motion { x: Length::from_si(x), y: Length::from_si(y), ..robot.motion };
        robot.bump = Some(Bump { at, time: Instant::ZERO + Duration::from_secs(60 - seconds) });
        let state = search(&mut robot);
        let Ok(Some(State::WallFound { angle })) = state else { panic!("{state:?}") };
        angle.si().to_degrees()
    }

    #[test]
    fn contacts_along_the_wall_belong_to_the_wall() {
        let mut robot = Fake::new(&[plane(-60.0, 0.7)]);
        let state = search(&mut robot);
        let Ok(Some(State::WallFound { angle })) = state else { panic!("{state:?}") };
        let without = angle.si().to_degrees();
        assert!((without - 30.0).abs() < 3.0, "{without}: along the wall");
        assert!((after_bump(0.3, 0.0, 5) - 120.0).abs() < 1e-9, "it is met again");
        assert!((after_bump(-0.6, 0.0, 5) - without).abs() < 1e-9, "it lies behind");
        assert!((after_bump(0.3, -0.6, 5) - without).abs() < 1e-9, "it lies aside");
        assert!((after_bump(0.3, 0.0, 50) - without).abs() < 1e-9, "it was long ago");
    }

    #[test]
    fn silence_and_an_object_out_of_range_are_not_a_wall() {
        assert_eq!(search(&mut Fake::new(&[])), Ok(Some(State::NoWallFound)));
        assert_eq!(search(&mut Fake::new(&[plane(0.0, 1.7)])), Ok(Some(State::NoWallFound)));
    }

    #[test]
    fn the_sweep_waits_for_standstill() {
        let mut robot = Fake::new(&[plane(0.0, 0.7)]);
        robot.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.0), Instant::ZERO);
        robot.tick();
        let way = robot.motion.x.si();
        assert!(matches!(search(&mut robot), Ok(Some(State::WallFound { .. }))));
        assert!(robot.motion.x.si() - way < 0.01);
    }

    #[test]
    fn a_dead_sensor_and_a_stuck_rotator_are_faults() {
        let mut robot = Fake::new(&[plane(0.0, 0.7)]);
        robot.range_dies = 0;
        assert_eq!(search(&mut robot), Err(NO_RANGE));
        assert!(robot.now < Instant::ZERO + Duration::from_millis(600));
        let mut robot = Fake::new(&[plane(0.0, 0.7)]);
        robot.stuck_rotator = true;
        assert_eq!(search(&mut robot), Err(STUCK_ROTATOR));
    }
}
