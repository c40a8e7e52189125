use afp_types::RADIANS_PER_DEGREE;

use super::Literal;

fn value(text: &str) -> f64 {
    Literal::parse(text).unwrap().value().unwrap()
}

#[test]
fn centimetres_are_the_nearest_double_of_the_decimal() {
    assert_eq!(value("35 cm"), 0.35);
    for centimetres in 0..1000_u32 {
        let metres: f64 =
            format!("{}.{:02}", centimetres / 100, centimetres % 100).parse().unwrap();
        assert_eq!(value(&format!("{centimetres} cm")), metres);
    }
}

#[test]
fn degrees_are_the_double_product() {
    assert_eq!(value("90 deg"), 90.0 * RADIANS_PER_DEGREE);
    assert_eq!(value("-0.1 deg"), -(0.1 * RADIANS_PER_DEGREE));
    assert_eq!(value("45 deg/s"), 45.0 * RADIANS_PER_DEGREE);
}

#[test]
fn fractions_are_rounded_once() {
    assert_eq!(value("36 km/h"), 10.0);
    assert_eq!(value("1 km/h"), 0.277_777_777_777_777_8);
    assert_eq!(value("0.1 min"), 6.0);
    assert_eq!(value("1 m/h"), 1.0 / 3600.0);
}

#[test]
fn celsius_has_an_offset() {
    assert_eq!(value("20 degC"), 293.15);
    assert_eq!(value("-5 degC"), 268.15);
    assert_eq!(value("0.01 degC"), 273.16);
}

#[test]
fn exponents_work_and_overflow_is_reported() {
    assert_eq!(value("1e3"), 1000.0);
    assert_eq!(value("2.5E-1 m"), 0.25);
    assert_eq!(value("1e-99999999999"), 0.0);
    assert_eq!(Literal::parse("1e400").unwrap().value(), None);
}

#[test]
fn times_are_whole_nanoseconds() {
    let nanoseconds = |text: &str| Literal::parse(text).unwrap().nanoseconds();
    assert_eq!(nanoseconds("1 ms"), Some(1_000_000));
    assert_eq!(nanoseconds("2.5 us"), Some(2_500));
    assert_eq!(nanoseconds("1.5 min"), Some(90_000_000_000));
    assert_eq!(nanoseconds("0.5 ns"), None);
    assert_eq!(nanoseconds("1 m"), None);
    assert_eq!(nanoseconds("-1 s"), None);
    assert_eq!(nanoseconds("1e30 s"), None);
}
