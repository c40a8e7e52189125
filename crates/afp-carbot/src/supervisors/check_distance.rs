//! Watch the distance in one direction.

use crate::devices::{Body, Echo, Navigator, Odometry, Rotator, Ultrasonic};
use crate::helpers::guard::{Arrival, Guard};
use crate::helpers::repeats::Repeats;
use crate::templates;
use crate::templates::check_distance::{Event, Inputs, Live};
use afp_core::quantity::{Angle, Length};
use afp_core::{Events, Fault, Instant, Supervisor};

/// The rotator has arrived within this distance of its target, radians.
const ARRIVED: f64 = 3.0 / 180.0 * core::f64::consts::PI;
/// Pings in a row that confirm a greater distance: one may be lost.
const FARTHER: u32 = 4;

/// The range sensor, pointed in one direction.
#[derive(Clone, Debug)]
pub(super) struct Pointed {
    bearing: Angle,
    last_ping: Instant,
    guard: Guard,
    arrival: Arrival,
    repeats: Repeats<Length>,
}

impl Pointed {
    pub(super) fn new<E: Rotator + ?Sized>(bearing: Angle, env: &mut E, now: Instant) -> Pointed {
        env.point(bearing, now);
        Pointed {
            bearing,
            last_ping: now,
            guard: Guard::of_echoes(now),
            arrival: Arrival::new(now),
            repeats: Repeats::of_echoes(now),
        }
    }

    /// The distance of a new echo from the robot's outline; infinite without a reflection.
    pub(super) fn echo<E>(&mut self, env: &mut E, now: Instant) -> Result<Option<Length>, Fault>
    where
        E: Navigator + Odometry + Ultrasonic + ?Sized,
    {
        let reading = env.echo();
        self.repeats.check_echo(reading, env.motion())?;
        let Some(echo) = self.guard.next(reading, self.last_ping, now)? else { return Ok(None) };
        self.last_ping = reading.time;
        if (echo.bearing.si() - self.bearing.si()).abs() > ARRIVED {
            self.arrival.elsewhere(&echo, now)?;
            return Ok(None);
        }
        self.arrival = Arrival::new(now);
        let clear = clear(&echo, env.body(), env.beam().forward);
        Ok(Some(clear.unwrap_or(Length::from_si(f64::INFINITY))))
    }
}

/// Compares the distance in one direction with a limit.
#[derive(Clone, Debug)]
pub struct CheckDistance {
    sensor: Pointed,
    /// Pings in a row without a nearer echo.
    farther: u32,
}

impl<E> Supervisor<templates::CheckDistance, E> for CheckDistance
where
    E: Navigator + Odometry + Ultrasonic + Rotator + ?Sized,
{
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(CheckDistance { sensor: Pointed::new(inputs.bearing, env, now), farther: 0 })
    }

    fn poll(
        &mut self,
        live: Live,
        wanted: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<Event>, Fault> {
        let Some(clear) = self.sensor.echo(env, now)? else { return Ok(None) };
        if clear < live.distance {
            self.farther = 0;
            return Ok(wanted.contains(0).then_some(Event::Nearer { seen: clear }));
        }
        self.farther = (self.farther + 1).min(FARTHER);
        let farther = self.farther == FARTHER && wanted.contains(1);
        Ok(farther.then_some(Event::Farther))
    }
}

/// Distance from the robot's outline along the bearing; `None` without a reflection.
fn clear(echo: &Echo, body: Body, forward: Length) -> Option<Length> {
    let (sin, cos) = libm::sincos(echo.bearing.si());
    let ahead = (if cos > 0.0 { body.front - forward } else { body.rear + forward }).si();
    // Parallel to a side, the distance to the other side is infinite.
    let inside = (ahead / cos.abs()).min(body.half_width.si() / sin.abs());
    Some(Length::from_si((echo.distance?.si() - inside).max(0.0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::{Fake, Plane, plane};
    use crate::helpers::guard::{FROZEN_RANGE, NO_RANGE, STUCK_ROTATOR};

    fn watch(robot: &mut Fake, bearing: f64, wanted: u64) -> Result<Option<Event>, Fault> {
        let inputs = Inputs { bearing: Angle::from_deg(bearing) };
        let live = || Live { distance: Length::from_si(0.5) };
        robot.watch::<templates::CheckDistance, CheckDistance>(inputs, live, wanted, 2000)
    }

    /// Watches both events; returns the distance of `Nearer` in centimetres.
    fn reports(walls: &[Plane], bearing: f64) -> Option<i64> {
        match watch(&mut Fake::new(walls), bearing, 0b11) {
            Ok(Some(Event::Nearer { seen })) => Some((seen.si() * 100.0).round() as i64),
            Ok(Some(Event::Farther)) => None,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn distances_are_measured_from_the_robots_edge() {
        assert_eq!(reports(&[plane(0.0, 0.6)], 0.0), Some(40));
        assert_eq!(reports(&[plane(0.0, 0.75)], 0.0), None);
        assert_eq!(reports(&[plane(90.0, 0.6)], 90.0), Some(43));
        assert_eq!(reports(&[plane(-90.0, 0.6)], 90.0), None);
    }

    #[test]
    fn farther_needs_several_consecutive_pings() {
        let mut robot = Fake::new(&[plane(0.0, 0.6)]);
        robot.lost_pings = (200, 3);
        assert_eq!(watch(&mut robot, 0.0, 0b10), Ok(None));
        let mut robot = Fake::new(&[plane(0.0, 0.6)]);
        robot.lost_pings = (200, 4);
        assert_eq!(watch(&mut robot, 0.0, 0b10), Ok(Some(Event::Farther)));
    }

    #[test]
    fn an_ignored_event_is_not_reported() {
        assert_eq!(watch(&mut Fake::new(&[plane(0.0, 0.6)]), 0.0, 0), Ok(None));
        assert_eq!(watch(&mut Fake::new(&[]), 0.0, 0b01), Ok(None));
    }

    #[test]
    fn a_dead_or_frozen_sensor_and_a_stuck_rotator_are_faults() {
        let mut robot = Fake::new(&[]);
        robot.range_dies = 500;
        assert_eq!(watch(&mut robot, 0.0, 0b01), Err(NO_RANGE));
        let mut robot = Fake::new(&[plane(0.0, 2.0)]);
        robot.range_freezes = 0;
        assert_eq!(watch(&mut robot, 60.0, 0b11), Err(FROZEN_RANGE));
        let mut robot = Fake::new(&[plane(0.0, 2.0)]);
        (robot.range_freezes, robot.drifts) = (500, 1.0);
        assert_eq!(watch(&mut robot, 0.0, 0b01), Err(FROZEN_RANGE), "it looks where it should");
        let mut robot = Fake::new(&[]);
        robot.stuck_rotator = true;
        assert_eq!(watch(&mut robot, 60.0, 0b11), Err(STUCK_ROTATOR));
    }
}
