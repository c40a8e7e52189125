//! Watch the lane ahead.

use crate::devices::{Echo, Navigator, Rotator, Ultrasonic};
use crate::guard::{Arrival, Guard, NO_RANGE};
use crate::templates;
use crate::templates::check_driving_lane::{Event, Inputs, Live};
use afp_core::quantity::Angle;
use afp_core::{Events, Fault, Instant, Supervisor};

/// The rotator has arrived when it is nearer than this to where it should be, radians.
const ARRIVED: f64 = 3.0 / 180.0 * core::f64::consts::PI;

/// Swings the range sensor over the lane and reports an echo from inside of it.
///
/// An echo is taken to come from the beam's axis; `margin` covers the rest of the beam. The
/// sensor looks left, ahead, right, ahead and so on, one ping at least at each.
#[derive(Debug)]
pub struct CheckDrivingLane {
    wanted: bool,
    clearance: f64,
    halfwidth: f64,
    /// Which of [`SWING`] the rotator goes to.
    place: usize,
    target: f64,
    last_ping: Instant,
    guard: Guard,
    arrival: Arrival,
}

/// The places that are looked at in turn, as shares of the largest bearing.
const SWING: [f64; 4] = [0.0, 1.0, 0.0, -1.0];

impl<E: Navigator + Ultrasonic + Rotator + ?Sized> Supervisor<templates::CheckDrivingLane, E>
    for CheckDrivingLane
{
    fn start(inputs: Inputs, wanted: Events, env: &mut E, now: Instant) -> Result<Self, Fault> {
        env.point(Angle::from_si(0.0), now);
        Ok(CheckDrivingLane {
            wanted: wanted.contains(0),
            clearance: inputs.clearance.si(),
            halfwidth: inputs.halfwidth.si() + inputs.margin.si(),
            place: 0,
            target: 0.0,
            last_ping: now,
            guard: Guard::new(NO_RANGE, now),
            arrival: Arrival::new(now),
        })
    }

    fn poll(&mut self, live: Live, env: &mut E, now: Instant) -> Result<Option<Event>, Fault> {
        let reading = env.echo();
        let Some(echo) = self.guard.next(reading, self.last_ping, now)? else {
            return Ok(None);
        };
        self.last_ping = reading.time;
        let beam = env.beam();
        // From the sensor to the end of the stretch that must be free.
        let front = env.body().front.si() - beam.forward.si();
        let reach = front + live.distance.si() + self.clearance;
        if (echo.bearing.si() - self.target).abs() < ARRIVED {
            self.place = (self.place + 1) % SWING.len();
            let widest = libm::atan2(self.halfwidth, reach) - beam.opening.si() / 2.0;
            self.target = SWING[self.place] * widest.max(0.0);
            env.point(Angle::from_si(self.target), now);
            self.arrival = Arrival::new(now);
        } else {
            self.arrival.check(now)?;
        }
        Ok((self.wanted && self.blocks(&echo, reach)).then_some(Event::LaneNotFree))
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
