//! A driven wheel: its encoder, and the power of its motor.
//!
//! The wheel follows a position instead of a speed. An encoder with few counts a turn has no useful
//! speed over 10 ms, but its counts never get lost, so that the robot stays on its course.

use crate::messages::Setup;

/// The largest distance by which a wheel may lag behind, in metres. Beyond it, the course is given
/// up, so that a blocked wheel does not spin later.
const LAG: f32 = 0.02;
/// The additional speed for each metre of lag, per second.
const GAIN: f32 = 8.0;

#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Wheel {
    /// The encoder's last count; `None` before the first.
    count: Option<i32>,
    /// The distance between the course and the rim, in metres.
    lag: f32,
}

impl Wheel {
    /// Takes the encoder's count; returns the rim's way since the last one, in metres.
    pub(crate) fn count(&mut self, count: i32, metres_per_tick: f32) -> f32 {
        // A counter that overflows continues.
        let ticks = self.count.map_or(0, |before| count.wrapping_sub(before));
        self.count = Some(count);
        let way = ticks as f32 * metres_per_tick;
        self.lag -= way;
        way
    }

    /// The power for a speed of the rim in m/s over `dt` seconds, from -1 to 1.
    pub(crate) fn power(&mut self, rim: f32, setup: &Setup, dt: f32) -> f32 {
        if rim == 0.0 {
            self.lag = 0.0;
            return 0.0;
        }
        self.lag = (self.lag + rim * dt).clamp(-LAG, LAG);
        ((rim + GAIN * self.lag) / setup.at_full_power()).clamp(-1.0, 1.0)
    }

    /// Gives up its course.
    pub(crate) fn release(&mut self) {
        self.lag = 0.0;
    }
}
