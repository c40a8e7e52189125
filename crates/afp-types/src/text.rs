//! Display of numbers and times.

use core::fmt::{self, Write};

use heapless::String;

/// Length of the longest number with [`MOST_DECIMALS`]: a sign, 309 digits, a point.
const LONGEST: usize = 352;
const MOST_DECIMALS: usize = 32;

/// A duration in nanoseconds, exact, in a suitable unit: `20 s`, `1.5 ms`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Nanoseconds(pub u64);

/// A number with a maximum number of decimals, without trailing zeros: `0.3`, `2`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounded(pub f64, pub usize);

impl fmt::Display for Nanoseconds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (digits, unit) = match self.0 {
            0 => (9, "s"),
            1..1_000 => (0, "ns"),
            1_000..1_000_000 => (3, "us"),
            1_000_000..1_000_000_000 => (6, "ms"),
            _ => (9, "s"),
        };
        let size = 10_u64.pow(digits);
        write!(f, "{}", self.0 / size)?;
        let (mut rest, mut width) = (self.0 % size, digits as usize);
        if rest > 0 {
            while rest.is_multiple_of(10) {
                (rest, width) = (rest / 10, width - 1);
            }
            write!(f, ".{rest:0width$}")?;
        }
        write!(f, " {unit}")
    }
}

impl fmt::Display for Rounded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = String::<LONGEST>::new();
        let decimals = self.1.min(MOST_DECIMALS);
        write!(text, "{:.decimals$}", self.0)?;
        let short = match text.contains('.') {
            true => text.trim_end_matches('0').trim_end_matches('.'),
            false => &text,
        };
        f.write_str(if short == "-0" { "0" } else { short })
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::string::ToString;

    use super::*;

    #[test]
    fn times_are_exact_in_the_unit_of_their_size() {
        for (nanoseconds, text) in [
            (0, "0 s"),
            (7, "7 ns"),
            (20_000, "20 us"),
            (1_500_000, "1.5 ms"),
            (999_999_999, "999.999999 ms"),
            (2_000_000_000, "2 s"),
            (1_000_000_001, "1.000000001 s"),
            (u64::MAX, "18446744073.709551615 s"),
        ] {
            assert_eq!(Nanoseconds(nanoseconds).to_string(), text);
        }
    }

    #[test]
    fn numbers_have_no_trailing_zeros() {
        for (number, decimals, text) in [
            (0.30, 3, "0.3"),
            (2.0, 3, "2"),
            (100.0, 0, "100"),
            (2.0 / 3.0, 3, "0.667"),
            (-0.0001, 3, "0"),
            (-0.5, 0, "0"),
            (f64::INFINITY, 3, "inf"),
        ] {
            assert_eq!(Rounded(number, decimals).to_string(), text);
        }
        assert_eq!(Rounded(f64::MIN, 99).to_string().len(), 310);
    }
}
