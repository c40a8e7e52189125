//! Noise streams: one for each sensor and seed.
//!
//! Streams are independent, so adding a sensor or reading it more often does not shift the others.

use afp_types::TextHash;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::Rng;

/// A stream of random numbers.
#[derive(Clone, Debug)]
pub struct Noise(Pcg32);

impl Noise {
    /// The stream with this name. Its numbers depend only on seed and name, on every machine.
    pub fn new(seed: u64, name: &str) -> Self {
        Noise::numbered(seed, TextHash::of(name).get())
    }

    /// The stream with this number.
    pub fn numbered(seed: u64, stream: u64) -> Self {
        // An odd multiplier spreads neighbouring seeds over the generator's state.
        Noise(Pcg32::new(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15), stream))
    }

    /// Uniform in 0 to 1, excluding 1.
    pub fn uniform(&mut self) -> f64 {
        f64::from(self.0.next_u32()) / 4_294_967_296.0
    }

    /// Uniform among the integers from 0 to before `bound`; 0 for a bound of 0.
    pub fn below(&mut self, bound: u32) -> u32 {
        ((u64::from(self.0.next_u32()) * u64::from(bound)) >> 32) as u32
    }

    /// Mean 0, standard deviation 1, at most 3.5: the sum of four uniform numbers.
    pub fn normal(&mut self) -> f64 {
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
        let mut noise = Noise::numbered(7, 3);
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..20_000 {
            let x = noise.normal();
            (sum, squares) = (sum + x, squares + x * x);
        }
        assert!((sum / 20_000.0).abs() < 0.03, "{sum}");
        assert!((squares / 20_000.0 - 1.0).abs() < 0.05, "{squares}");
    }

    #[test]
    fn streams_differ_by_name_and_by_seed() {
        let first = |seed, name| Noise::new(seed, name).below(u32::MAX);
        let a = first(1, "odometry");
        assert_ne!(a, first(1, "ultrasonic"));
        assert_ne!(a, first(2, "odometry"));
        assert_eq!(a, first(1, "odometry"));
    }
}
