//! Numbers with units, compared with exact arithmetic.

use afp_types::{Error, RADIANS_PER_DEGREE, Scale, Unit, parse_quantity};

const UNITS: [Unit<'static>; 8] = [
    Unit { name: "s", scale: Scale::Decimal(0) },
    Unit { name: "ms", scale: Scale::Decimal(-3) },
    Unit { name: "min", scale: Scale::fraction(60, 1, 0, 0) },
    Unit { name: "km/h", scale: Scale::fraction(1, 3600, 3, 0) },
    Unit { name: "third", scale: Scale::fraction(3, 3, 0, 0) },
    Unit { name: "deg", scale: Scale::fraction(1, 1, 0, 1) },
    Unit { name: "1/deg", scale: Scale::fraction(1, 1, 0, -1) },
    Unit { name: "degC", scale: Scale::Celsius },
];

fn read(text: &str) -> Result<f64, Error> {
    parse_quantity(text, UNITS)
}

#[test]
fn every_two_decimal_minute_is_the_double_nearest_to_its_seconds() {
    for hundredths in 0..10_000_u32 {
        let text = format!("{}.{:02}min", hundredths / 100, hundredths % 100);
        let tenths = hundredths * 6;
        let seconds = format!("{}.{}", tenths / 10, tenths % 10);
        assert_eq!(read(&text), Ok(seconds.parse().unwrap()), "{text}");
    }
    assert_eq!(read("0.03 min"), Ok(1.8));
}

#[test]
fn a_fraction_is_rounded_once() {
    for speed in 0..20_000_u32 {
        // Both are exact doubles, so the quotient is rounded once.
        let exact = f64::from(speed * 10) / 36.0;
        assert_eq!(read(&format!("{speed} km/h")), Ok(exact), "{speed}");
        assert_eq!(read(&format!("-{speed}e3 km/h")), Ok(-(f64::from(speed) * 1e4 / 36.0)));
    }
}

#[test]
fn a_digit_far_after_a_midpoint_decides() {
    // 1 + 2^-53, halfway between 1 and the next double.
    let midpoint = "1.00000000000000011102230246251565404236316680908203125";
    let above = format!("{midpoint}{}1", "0".repeat(680));
    let below =
        format!("1.000000000000000111022302462515654042363166809082031249{}", "9".repeat(700));
    for unit in ["s", "third"] {
        assert_eq!(read(&format!("{midpoint} {unit}")), Ok(1.0));
        assert_eq!(read(&format!("{above} {unit}")), Ok(1.0 + f64::EPSILON));
        assert_eq!(read(&format!("{below} {unit}")), Ok(1.0));
    }
}

#[test]
fn degrees_are_the_double_product() {
    for tenths in 0..3600_u32 {
        let text = format!("{}.{}", tenths / 10, tenths % 10);
        let number: f64 = text.parse().unwrap();
        assert_eq!(read(&format!("{text} deg")), Ok(number * RADIANS_PER_DEGREE));
        assert_eq!(read(&format!("{text} 1/deg")), Ok(number / RADIANS_PER_DEGREE));
    }
}

#[test]
fn celsius_is_a_decimal_sum() {
    for hundredths in -30_000..30_000_i32 {
        let sign = if hundredths < 0 { "-" } else { "" };
        let size = hundredths.unsigned_abs();
        let text = format!("{sign}{}.{:02} degC", size / 100, size % 100);
        let kelvin = hundredths + 27_315;
        let sign = if kelvin < 0 { "-" } else { "" };
        let size = kelvin.unsigned_abs();
        let exact = format!("{sign}{}.{:02}", size / 100, size % 100);
        assert_eq!(read(&text), Ok(exact.parse().unwrap()), "{text}");
    }
    assert_eq!(read("1e3 degC"), Ok(1273.15));
}

#[test]
fn too_large_a_number_is_not_a_value_and_too_small_a_number_is_zero() {
    for text in ["1e999 s", "1e99999999999 s", "1e308 min", "1e999 degC", "1e400 deg"] {
        assert_eq!(read(text), Err(Error::NotAValue), "{text}");
    }
    assert_eq!(read("1e-99999999999 min"), Ok(0.0));
    assert_eq!(read("0e99999 km/h"), Ok(0.0));
    assert_eq!(read(&format!("{}1{} ms", "0".repeat(900), "0".repeat(900))), Err(Error::NotAValue));
    assert_eq!(read(&format!("1{}e-2000 s", "0".repeat(2000))), Ok(1.0));
    let zero = parse_quantity("1 u", [Unit { name: "u", scale: Scale::fraction(1, 0, 0, 0) }]);
    assert_eq!(zero, Err(Error::NotAValue));
}
