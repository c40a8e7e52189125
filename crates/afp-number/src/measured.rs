//! Numbers of quantities as people write them.

use core::fmt;

use crate::Rounded;

/// A number of an SI unit as people write it: angles in degrees; less than a metre in centimetres, less than a
/// second in milliseconds; shown to the thousandth of its part.
///
/// Two that are equal read the same.
///
/// ```
/// use afp_number::Measured;
///
/// assert_eq!(Measured::new(0.3, "m").to_string(), "30 cm");
/// assert_eq!(Measured::new(7.4, "V").to_string(), "7.4 V");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured<'a> {
    value: f64,
    decimals: usize,
    unit: &'a str,
}

impl<'a> Measured<'a> {
    /// A number in that SI unit, `""` for a plain one.
    pub fn new(number: f64, unit: &'a str) -> Self {
        match unit {
            "rad" => Self::whole(number.to_degrees(), "deg"),
            "rad/s" => Self::whole(number.to_degrees(), "deg/s"),
            "m" => Self::whole_or_parts(number, "m", "cm", 2),
            "m/s" => Self::whole_or_parts(number, "m/s", "cm/s", 2),
            "s" => Self::whole_or_parts(number, "s", "ms", 3),
            unit => Self::whole(number, unit),
        }
    }

    /// The unit that it is written with, `""` for a plain number.
    pub fn unit(&self) -> &'a str {
        self.unit
    }

    fn whole(number: f64, unit: &'a str) -> Self {
        Self::rounded(number, 3, unit)
    }

    /// A number from one on in its unit, below in parts of it that are so many powers of ten smaller.
    fn whole_or_parts(number: f64, unit: &'a str, part: &'a str, power: u8) -> Self {
        let decimals = usize::from(power) + 3;
        let shown = Self::rounded(number, decimals, unit);
        if shown.value.abs() < 1.0 {
            Self::rounded(shown.value * libm::pow(10.0, f64::from(power)), 3, part)
        } else {
            shown
        }
    }

    fn rounded(number: f64, decimals: usize, unit: &'a str) -> Self {
        let scale = libm::pow(10.0, decimals as f64);
        let shown = libm::round(number * scale) / scale;
        Measured { value: if shown.is_finite() { shown } else { number }, decimals, unit }
    }
}

/// From here on a number is written with an exponent.
const LARGE: f64 = 1e12;

impl fmt::Display for Measured<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.value.is_finite() && self.value.abs() >= LARGE {
            true => write!(f, "{:e}", self.value)?,
            false => write!(f, "{}", Rounded(self.value, self.decimals))?,
        }
        match self.unit {
            "" => Ok(()),
            unit => write!(f, " {unit}"),
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::string::ToString;

    use super::*;

    #[test]
    fn values_read_as_people_write_them() {
        for (number, unit, text) in [
            (0.3, "m", "30 cm"),
            (0.123_456, "m", "12.346 cm"),
            (0.999_999_9, "m", "1 m"),
            (1.0, "m", "1 m"),
            (-2.5, "m", "-2.5 m"),
            (1.234_56, "m", "1.23456 m"),
            (100.0, "m", "100 m"),
            (0.0, "m", "0 cm"),
            (f64::INFINITY, "m", "inf m"),
            (0.31, "m/s", "31 cm/s"),
            (-2.0, "m/s", "-2 m/s"),
            (0.02, "s", "20 ms"),
            (0.000_4, "s", "0.4 ms"),
            (90.0, "s", "90 s"),
            (1.5, "s", "1.5 s"),
            (core::f64::consts::FRAC_PI_2, "rad", "90 deg"),
            (-core::f64::consts::PI, "rad/s", "-180 deg/s"),
            (7.4, "V", "7.4 V"),
            (0.25, "", "0.25"),
            (1e308, "", "1e308"),
            (-2.5e20, "m", "-2.5e20 m"),
            (123_456_789_012.5, "", "123456789012.5"),
        ] {
            assert_eq!(Measured::new(number, unit).to_string(), text);
        }
    }

    #[test]
    fn what_reads_the_same_is_equal() {
        assert_eq!(Measured::new(0.300_000_1, "m"), Measured::new(0.3, "m"));
        assert_ne!(Measured::new(0.300_1, "m"), Measured::new(0.3, "m"));
    }
}
