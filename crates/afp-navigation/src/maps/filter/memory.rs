//! The latest pings, to be heard again from anywhere.

use super::{Ping, relative};
use afp_carbot::history::Pose;

/// So many are remembered: two to four metres of the way.
const KEPT: usize = 64;

/// A remembered ping, against where the robot is now: where the sensor was, metres, where it looked, radians, and what
/// it heard.
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

    /// All that is remembered, against where the odometry takes the robot to be now.
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
