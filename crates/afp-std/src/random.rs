//! Draw a random number.
//!
//! The generator is SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014). Its whole
//! state is one integer, so an entry of the plan can hold it.

use afp_core::{Computation, Fault};

use crate::templates;
use crate::templates::random::{Inputs, State};

/// The increment of the state for each draw.
const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// Draws from SplitMix64.
#[derive(Clone, Copy, Debug)]
pub struct Random;

impl Computation<templates::Random> for Random {
    fn compute(inputs: Inputs) -> Result<State, Fault> {
        let next = inputs.state.cast_unsigned().wrapping_add(STEP);
        let mut bits = next;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^= bits >> 31;
        // A double holds 53 bits exactly.
        let value = (bits >> 11) as f64 / (1_u64 << 53) as f64;
        Ok(State::Done { next: next.cast_signed(), value })
    }
}

#[cfg(test)]
mod tests {
    use super::{Computation, Inputs, Random, State};

    fn draws(mut state: i64, count: usize) -> impl Iterator<Item = f64> {
        core::iter::repeat_with(move || {
            let Ok(State::Done { next, value }) = Random::compute(Inputs { state }) else {
                return f64::NAN;
            };
            state = next;
            value
        })
        .take(count)
    }

    #[test]
    fn the_first_number_equals_the_reference() {
        // The first output of SplitMix64 for the seed 0 is e220a8397b1dcdaf.
        let first = draws(0, 1).next().unwrap();
        assert_eq!(first, (0xe220_a839_7b1d_cdaf_u64 >> 11) as f64 / (1_u64 << 53) as f64);
    }

    #[test]
    fn the_numbers_are_spread_evenly() {
        let mut tenths = [0; 10];
        draws(42, 10_000).for_each(|value| tenths[(value * 10.0) as usize] += 1);
        assert!(tenths.iter().all(|count| (900..1100).contains(count)), "{tenths:?}");
    }
}
