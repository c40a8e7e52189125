//! Values as people write them.

use afp_number::Rounded;

use super::Datum;

impl Datum {
    /// The value as people write it; the number of a quantity is in that SI unit.
    pub fn in_unit(&self, unit: &str) -> String {
        match self {
            Datum::Number(number) => quantity(*number, unit),
            other => other.to_string(),
        }
    }
}

/// A number of an SI unit as people write it: angles in degrees; less than a metre in centimetres, less than a
/// second in milliseconds.
pub fn quantity(number: f64, unit: &str) -> String {
    match unit {
        "" => Rounded(number, 3).to_string(),
        "rad" => format!("{} deg", Rounded(number.to_degrees(), 3)),
        "rad/s" => format!("{} deg/s", Rounded(number.to_degrees(), 3)),
        "m" => whole_or_parts(number, "m", "cm", 2),
        "m/s" => whole_or_parts(number, "m/s", "cm/s", 2),
        "s" => whole_or_parts(number, "s", "ms", 3),
        unit => format!("{} {unit}", Rounded(number, 3)),
    }
}

/// A number from one on in its unit, below in parts of it that are so many powers of ten smaller; told
/// to the thousandth of a part.
fn whole_or_parts(number: f64, unit: &str, part: &str, power: u8) -> String {
    let parts = libm::pow(10.0, f64::from(power));
    let told = (number * parts * 1e3).round() / (parts * 1e3);
    if told.abs() < 1.0 {
        format!("{} {part}", Rounded(told * parts, 3))
    } else {
        format!("{} {unit}", Rounded(told, usize::from(power) + 3))
    }
}

#[cfg(test)]
mod tests {
    use super::quantity;

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
            (0.31, "m/s", "31 cm/s"),
            (-2.0, "m/s", "-2 m/s"),
            (0.02, "s", "20 ms"),
            (0.000_4, "s", "0.4 ms"),
            (90.0, "s", "90 s"),
            (1.5, "s", "1.5 s"),
            (std::f64::consts::FRAC_PI_2, "rad", "90 deg"),
            (-std::f64::consts::PI, "rad/s", "-180 deg/s"),
            (7.4, "V", "7.4 V"),
            (0.25, "", "0.25"),
        ] {
            assert_eq!(quantity(number, unit), text);
        }
    }
}
