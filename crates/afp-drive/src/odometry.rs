//! Dead reckoning from the two encoders.

use crate::messages::Setup;

/// The number of steps over which the speed is measured: 80 ms.
const WINDOW: usize = 8;

#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Odometry {
    /// Position in metres and heading in radians.
    pose: [f64; 3],
    /// The distances of the last steps, left and right, in metres.
    ways: [[f32; 2]; WINDOW],
    next: usize,
}

impl Odometry {
    /// Adds the distances of the left and the right rim in one step.
    pub(crate) fn add(&mut self, ways: [f32; 2], setup: &Setup) {
        let [left, right] = ways.map(f64::from);
        let (driven, turned) = ((left + right) / 2.0, (right - left) / f64::from(setup.track));
        let [x, y, heading] = &mut self.pose;
        let (sin, cos) = libm::sincos(*heading + turned / 2.0);
        *x += driven * cos;
        *y += driven * sin;
        *heading += turned;
        if let Some(oldest) = self.ways.get_mut(self.next) {
            *oldest = ways;
        }
        self.next = (self.next + 1) % WINDOW;
    }

    pub(crate) fn pose(&self) -> [f64; 3] {
        self.pose
    }

    /// Speed in m/s and turn rate in rad/s, with steps of `dt` seconds.
    pub(crate) fn rates(&self, setup: &Setup, dt: f32) -> (f32, f32) {
        let sum = |side: usize| {
            self.ways.iter().filter_map(|ways| ways.get(side)).sum::<f32>() / (WINDOW as f32 * dt)
        };
        let (left, right) = (sum(0), sum(1));
        ((left + right) / 2.0, (right - left) / setup.track)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_ends_where_it_began() {
        let setup = Setup::default();
        let mut odometry = Odometry::default();
        let (inner, outer) = (0.3_f32 - setup.track / 2.0, 0.3 + setup.track / 2.0);
        let step = core::f32::consts::TAU / 2000.0;
        for _ in 0..2000 {
            odometry.add([inner * step, outer * step], &setup);
        }
        let [x, y, heading] = odometry.pose();
        assert!(x.abs() < 1e-5 && y.abs() < 1e-5, "{x} {y}");
        assert!((heading - core::f64::consts::TAU).abs() < 1e-4, "{heading}");
        let (speed, turn) = odometry.rates(&setup, 0.01);
        assert!((speed / turn - 0.3).abs() < 1e-3);
    }
}
