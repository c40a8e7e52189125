//! Quantities in the units of everyday use.

use core::fmt;

use crate::Rounded;

/// Formats a quantity: angles in degrees, less than a metre in centimetres, less than a second in
/// milliseconds. It shows thousandths of the smaller unit, or three significant digits if these
/// would be zero.
///
/// Equal numbers print the same.
///
/// ```
/// use afp_types::Measured;
///
/// assert_eq!(Measured::new(0.3, "m").to_string(), "30 cm");
/// assert_eq!(Measured::new(7.4, "V").to_string(), "7.4 V");
/// assert_eq!(Measured::new(0.000_001, "m").to_string(), "0.0001 cm");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured<'a> {
    value: f64,
    decimals: usize,
    unit: &'a str,
}

impl<'a> Measured<'a> {
    /// A number in an SI unit, `""` for a plain number.
    pub fn new(number: f64, unit: &'a str) -> Self {
        let (value, decimals, unit) = in_its_unit(number, unit);
        let (value, decimals) = match rounded(value, decimals) {
            0.0 if value.abs() >= NOTHING => three_digits(value),
            shown => (shown, decimals),
        };
        Measured { value, decimals, unit }
    }

    /// The same without rounding, except for arithmetic residue.
    pub fn exact(number: f64, unit: &'a str) -> Option<Self> {
        let shown = Self::new(number, unit);
        let (value, ..) = in_its_unit(number, unit);
        ((shown.value - value).abs() <= value.abs() * RESIDUE).then_some(shown)
    }

    /// Whether a number prints like a different number; then only [`crate::Quantity`] distinguishes
    /// them.
    pub fn misleads(number: f64, other: f64, unit: &str) -> bool {
        number != other && Measured::new(number, unit) == Measured::new(other, unit)
    }

    /// Zero in the unit of the other number; any other number unchanged.
    pub fn beside(self, other: Self) -> Self {
        match self.value == 0.0 {
            true => Measured { unit: other.unit, ..self },
            false => self,
        }
    }
}

/// Smaller numbers, in their unit, count as arithmetic residue of zero.
const NOTHING: f64 = 1e-9;
/// Relative arithmetic residue of a number.
const RESIDUE: f64 = 1e-14;

/// A number in its display unit, and the number of decimals.
fn in_its_unit(number: f64, unit: &str) -> (f64, usize, &str) {
    match unit {
        "rad" => (number.to_degrees(), 3, "deg"),
        "rad/s" => (number.to_degrees(), 3, "deg/s"),
        "m" => whole_or_parts(number, "m", "cm", 2),
        "m/s" => whole_or_parts(number, "m/s", "cm/s", 2),
        "s" => whole_or_parts(number, "s", "ms", 3),
        unit => (number, 3, unit),
    }
}

/// A number from one on in its unit, a smaller number in a unit that is smaller by a power of ten.
fn whole_or_parts<'a>(
    number: f64,
    unit: &'a str,
    part: &'a str,
    power: u8,
) -> (f64, usize, &'a str) {
    let decimals = usize::from(power) + 3;
    match rounded(number, decimals).abs() < 1.0 {
        true => (number * libm::pow(10.0, f64::from(power)), 3, part),
        false => (number, decimals, unit),
    }
}

/// Rounds to some decimals; unchanged without decimals.
fn rounded(number: f64, decimals: usize) -> f64 {
    let scale = libm::pow(10.0, decimals as f64);
    match (number * scale).abs() < EXACT {
        true => libm::round(number * scale) / scale,
        false => number,
    }
}

/// Rounds a number below a thousandth to three digits; returns the number of decimals.
fn three_digits(number: f64) -> (f64, usize) {
    let decimals = (2.0 - libm::floor(libm::log10(number.abs()))) as usize;
    (rounded(number, decimals), decimals)
}

/// Largest float up to which all integers are exact; larger floats are always integers.
pub const EXACT: f64 = 9_007_199_254_740_992.0;

/// Larger numbers are written with an exponent.
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
    fn values_are_shown_in_usual_units() {
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
            (1e20, "m", "1e20 m"),
            (0.000_001, "m", "0.0001 cm"),
            (1e-7, "s", "0.0001 ms"),
            (-0.000_001_234_5, "", "-0.00000123"),
            (0.000_4, "", "0.0004"),
            (1e-6, "m^2", "0.000001 m^2"),
            (1e-17, "m", "0 cm"),
        ] {
            assert_eq!(Measured::new(number, unit).to_string(), text);
        }
    }

    #[test]
    fn zero_has_the_unit_of_its_neighbour() {
        let beside = |number, other| {
            Measured::new(number, "s").beside(Measured::new(other, "s")).to_string()
        };
        assert_eq!(beside(0.0, -1.0), "0 s");
        assert_eq!(beside(0.0, -0.02), "0 ms");
        assert_eq!(beside(0.5, 2.0), "500 ms");
    }

    #[test]
    fn a_number_that_can_be_read_back_is_exact() {
        let exact = |number, unit| Measured::exact(number, unit).map(|shown| shown.to_string());
        assert_eq!(exact(-core::f64::consts::FRAC_PI_2, "rad").as_deref(), Some("-90 deg"));
        assert_eq!(exact(0.1 + 0.2, "m").as_deref(), Some("30 cm"));
        assert_eq!(exact(0.0, "m").as_deref(), Some("0 cm"));
        assert_eq!(exact(0.000_001, "m").as_deref(), Some("0.0001 cm"));
        assert_eq!(exact(0.300_000_1, "m"), None);
        assert_eq!(exact(1.0, "rad"), None);
        assert_eq!(exact(f64::NAN, ""), None);
    }

    #[test]
    fn equal_texts_have_equal_values() {
        assert_eq!(Measured::new(0.300_000_1, "m"), Measured::new(0.3, "m"));
        assert_ne!(Measured::new(0.300_1, "m"), Measured::new(0.3, "m"));
    }
}
