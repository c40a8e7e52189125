//! Watch the lane ahead.

use crate::devices::{Echo, Navigator, Odometry, Rotator, Ultrasonic};
use crate::helpers::guard::{Arrival, Guard};
use crate::helpers::repeats::Repeats;
use crate::templates;
use crate::templates::check_driving_lane::{Event, Inputs, Live};
use afp_core::quantity::{Angle, Length};
use afp_core::{Events, Fault, Instant, Supervisor};

/// The rotator has arrived within this distance of its target, radians.
const ARRIVED: f64 = 3.0 / 180.0 * core::f64::consts::PI;

/// Swings the range sensor over the lane and reports an echo from inside.
///
/// An echo counts as on the beam's axis; `margin` covers the rest of the beam. So a wall square
/// ahead is reported up to 7 cm early if the sensor looks aside. The sensor looks ahead, left,
/// right and so on, with at least one ping at each, and listens while it moves. Aside it looks at
/// the lane's far corners. There the beam also hears walls at a small angle, which reflect nothing
/// farther ahead.
#[derive(Clone, Debug)]
pub struct CheckDrivingLane {
    clearance: f64,
    halfwidth: f64,
    /// Index in [`SWING`] of the rotator's target.
    step: usize,
    target: f64,
    last_ping: Instant,
    guard: Guard,
    arrival: Arrival,
    repeats: Repeats<Length>,
}

/// The bearings in turn, as shares of the largest bearing.
const SWING: [f64; 3] = [0.0, 1.0, -1.0];

impl<E> Supervisor<templates::CheckDrivingLane, E> for CheckDrivingLane
where
    E: Navigator + Odometry + Ultrasonic + Rotator + ?Sized,
{
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        let (clearance, halfwidth) =
            (inputs.clearance.si(), inputs.halfwidth.si() + inputs.margin.si());
        let step = first(env.echo().value.ok());
        let front = (env.body().front - env.beam().forward).si();
        let target = SWING[step] * libm::atan2(halfwidth, front + clearance);
        env.point(Angle::from_si(target), now);
        Ok(CheckDrivingLane {
            clearance,
            halfwidth,
            step,
            target,
            last_ping: now,
            guard: Guard::of_echoes(now),
            arrival: Arrival::new(now),
            repeats: Repeats::of_echoes(now),
        })
    }

    fn poll(
        &mut self,
        live: Live,
        wanted: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<Event>, Fault> {
        let reading = env.echo();
        self.repeats.check_echo(reading, env.motion())?;
        let Some(echo) = self.guard.next(reading, self.last_ping, now)? else {
            return Ok(None);
        };
        self.last_ping = reading.time;
        let beam = env.beam();
        // From the sensor to the end of the lane.
        let front = env.body().front.si() - beam.forward.si();
        let reach = front + live.distance.si() + self.clearance;
        if (echo.bearing.si() - self.target).abs() < ARRIVED {
            self.step = (self.step + 1) % SWING.len();
            self.target = SWING[self.step] * libm::atan2(self.halfwidth, reach);
            env.point(Angle::from_si(self.target), now);
            self.arrival = Arrival::new(now);
        } else {
            self.arrival.elsewhere(&echo, now)?;
        }
        Ok((wanted.contains(0) && self.blocks(&echo, reach)).then_some(Event::LaneNotFree))
    }
}

/// The side opposite to the sensor: the least recent, with the rest of the lane on the path to it.
fn first(echo: Option<Echo>) -> usize {
    let bearing = echo.map_or(0.0, |echo| echo.bearing.si());
    if bearing.abs() < ARRIVED {
        0
    } else if bearing < 0.0 {
        1
    } else {
        2
    }
}

impl CheckDrivingLane {
    fn blocks(&self, echo: &Echo, reach: f64) -> bool {
        let Some(distance) = echo.distance else { return false };
        let (sin, cos) = libm::sincos(echo.bearing.si());
        let (ahead, aside) = (distance.si() * cos, distance.si() * sin);
        ahead <= reach && aside.abs() <= self.halfwidth
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::{Fake, Plane, plane};
    use crate::helpers::guard::{FROZEN_RANGE, NO_RANGE, STUCK_ROTATOR};

    type Template = templates::CheckDrivingLane;

    /// Watches a lane of 30 + 10 cm length and 35 cm to either side for two seconds.
    fn watch(robot: &mut Fake, wanted: u64) -> Result<Option<Event>, Fault> {
        watch_width(robot, wanted, [0.1, 0.25])
    }

    /// As [`watch`] with another width: a margin and half the width.
    fn watch_width(robot: &mut Fake, wanted: u64, width: [f64; 2]) -> Result<Option<Event>, Fault> {
        let [margin, halfwidth] = width.map(Length::from_si);
        let inputs = Inputs { clearance: Length::from_si(0.1), margin, halfwidth };
        let (now, wanted) = (robot.now, Events::from_bits(wanted));
        let mut lane: CheckDrivingLane = Supervisor::<Template, Fake>::start(inputs, robot, now)?;
        for _ in 0..200 {
            robot.tick();
            let (now, live) = (robot.now, Live { distance: Length::from_si(0.3) });
            let event = Supervisor::<Template, Fake>::poll(&mut lane, live, wanted, robot, now)?;
            if event.is_some() {
                return Ok(event);
            }
        }
        Ok(None)
    }

    fn free(walls: &[Plane]) -> bool {
        watch(&mut Fake::new(walls), 1) == Ok(None)
    }

    #[test]
    fn the_lane_ends_forty_centimetres_before_the_front() {
        assert!(!free(&[plane(0.0, 0.59)]));
        assert!(free(&[plane(0.0, 0.69)]));
    }

    #[test]
    fn a_wall_parallel_to_the_lane_does_not_block_it() {
        assert!(free(&[plane(-90.0, 0.475)]));
        assert!(free(&[]));
    }

    #[test]
    fn an_obstacle_at_a_small_angle_to_the_lane_is_heard() {
        for side in [-1.0, 1.0] {
            assert!(!free(&[plane(side * 75.0, 0.4)]), "{side}");
        }
    }

    #[test]
    fn an_obstacle_next_to_the_beam_is_found_by_swinging() {
        let slanted = [plane(-50.0, 0.45)];
        assert!(!free(&slanted));
    }

    #[test]
    fn an_ignored_event_is_not_reported() {
        assert_eq!(watch(&mut Fake::new(&[plane(0.0, 0.4)]), 0), Ok(None));
    }

    #[test]
    fn a_dead_or_frozen_sensor_and_a_stuck_rotator_are_faults_and_not_free_space() {
        let mut robot = Fake::new(&[]);
        robot.range_dies = 0;
        assert_eq!(watch(&mut robot, 1), Err(NO_RANGE));
        let mut robot = Fake::new(&[plane(0.0, 2.0)]);
        robot.range_freezes = 0;
        assert_eq!(watch(&mut robot, 1), Err(FROZEN_RANGE));
        // In such a narrow lane the rotator hardly turns, so only the robot's motion changes the
        // readings.
        let mut robot = Fake::new(&[plane(0.0, 2.0)]);
        (robot.range_freezes, robot.drifts) = (500, 1.0);
        assert_eq!(watch_width(&mut robot, 1, [0.0, 0.01]), Err(FROZEN_RANGE));
        let mut robot = Fake::new(&[]);
        robot.rotator = 0.5;
        robot.stuck_rotator = true;
        assert_eq!(watch(&mut robot, 1), Err(STUCK_ROTATOR));
    }
}
