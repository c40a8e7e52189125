//! Noise in streams: one for each sensor and seed.
//!
//! A stream is not shared, so adding a sensor or reading one more often does not shift the others.

use rand_pcg::Pcg32;
use rand_pcg::rand_core::Rng;

/// What a stream is for; the number is part of every recorded run and never changes.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Source {
    /// What differs from robot to robot: calibration.
    Build = 1,
    /// The wheels' counters.
    Odometry = 2,
    /// Range and dropouts of the ultrasonic sensor.
    Ultrasonic = 3,
    /// The bumper's bouncing contact.
    Bumper = 4,
    /// Bearing and strength of infrared light.
    Infrared = 5,
    /// The colour sensor.
    Color = 6,
    /// Rooms made up.
    Rooms = 8,
    /// The grain of pictures.
    Camera = 7,
}

/// A stream of random numbers.
#[derive(Clone, Debug)]
pub(crate) struct Noise(Pcg32);

impl Noise {
    pub(crate) fn new(seed: u64, source: Source) -> Self {
        // An odd multiplier spreads neighbouring seeds over the generator's state.
        Noise(Pcg32::new(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15), source as u64))
    }

    /// Uniform in 0 to 1, 1 excluded.
    pub(crate) fn uniform(&mut self) -> f64 {
        f64::from(self.0.next_u32()) / 4_294_967_296.0
    }

    /// Uniform among the whole numbers from 0 to before `bound`; 0 for a bound of 0.
    pub(crate) fn below(&mut self, bound: u32) -> u32 {
        ((u64::from(self.0.next_u32()) * u64::from(bound)) >> 32) as u32
    }

    /// Mean 0, standard deviation 1, nothing beyond 3.5: four uniform numbers added up.
    pub(crate) fn normal(&mut self) -> f64 {
        let (a, b) = (self.0.next_u32(), self.0.next_u32());
        let sum = (a >> 16) + (a & 0xffff) + (b >> 16) + (b & 0xffff);
        // Each has variance 65536^2 / 12, so the sum has the standard deviation 65536 / sqrt(3).
        (f64::from(sum) - 131_070.0) * (1.732_050_807_568_877_2 / 65_536.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_numbers_have_mean_zero_and_deviation_one() {
        let mut noise = Noise::new(7, Source::Ultrasonic);
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..20_000 {
            let x = noise.normal();
            (sum, squares) = (sum + x, squares + x * x);
        }
        assert!((sum / 20_000.0).abs() < 0.03, "{sum}");
        assert!((squares / 20_000.0 - 1.0).abs() < 0.05, "{squares}");
    }

    #[test]
    fn streams_differ_by_source_and_by_seed() {
        let first = |seed, source| Noise::new(seed, source).0.next_u32();
        let a = first(1, Source::Odometry);
        assert_ne!(a, first(1, Source::Ultrasonic));
        assert_ne!(a, first(2, Source::Odometry));
        assert_eq!(a, first(1, Source::Odometry));
    }
}
