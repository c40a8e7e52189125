//! The latest pings, for evaluation at any place.

use super::{Ping, relative};
use afp_carbot::history::Pose;

/// The number of remembered pings: two to four metres of the path.
const KEPT: usize = 64;

/// A remembered ping, relative to the robot's present place: the sensor's place in metres, its
/// direction in radians, and the echo.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Echo {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) direction: f64,
    pub(super) distance: Option<f64>,
}

#[derive(Clone, Debug)]
pub(super) struct Memory {
    pings: [Option<Ping>; KEPT],
    next: usize,
    echoes: [Echo; KEPT],
}

impl Default for Memory {
    fn default() -> Self {
        Memory { pings: [None; KEPT], next: 0, echoes: [Echo::default(); KEPT] }
    }
}

impl Memory {
    pub(super) fn keep(&mut self, ping: &Ping) {
        if let Some(oldest) = self.pings.get_mut(self.next) {
            *oldest = Some(*ping);
        }
        self.next = (self.next + 1) % KEPT;
    }

    /// All remembered pings, relative to the odometry's present pose.
    pub(super) fn seen_from(&mut self, now: Pose, forward: f64) -> &[Echo] {
        let mut count = 0;
        for (ping, echo) in self.pings.iter().flatten().zip(&mut self.echoes) {
            let then = relative(now, ping.robot);
            let (sin, cos) = libm::sincos(then.heading);
            *echo = Echo {
                x: then.x + forward * cos,
                y: then.y + forward * sin,
                direction: then.heading + ping.bearing,
                distance: ping.distance,
            };
            count += 1;
        }
        self.echoes.get(..count).unwrap_or_default()
    }
}
