//! Formulas, conversions, strings and times for which plain operators would panic, wrap or round.

use afp_core::quantity::{Force, Frequency, Quantity, Speed};
use afp_core::rt::{
    Scale, Unit, bool_to_int, float_to_int, int_add, int_mul, int_neg, int_rem, int_sub, join,
    parse_bool, parse_choice, parse_float, parse_int, parse_quantity, print_quantity, rem,
};
use afp_core::{Duration, Instant, Text};
use afp_types::Error;

const LENGTHS: [Unit<'static>; 3] = [
    Unit { name: "m", scale: Scale::Decimal(0) },
    Unit { name: "cm", scale: Scale::Decimal(-2) },
    Unit { name: "km", scale: Scale::Decimal(3) },
];

#[test]
fn integers_fault_on_overflow() {
    assert_eq!(int_add(i64::MAX, 1), Err(Error::Overflow));
    assert_eq!(int_sub(i64::MIN, 1), Err(Error::Overflow));
    assert_eq!(int_mul(i64::MAX, 2), Err(Error::Overflow));
    assert_eq!(int_neg(i64::MIN), Err(Error::Overflow));
    assert_eq!(int_rem(5, 0), Err(Error::DivisionByZero));
    assert_eq!(int_rem(i64::MIN, -1), Ok(0));
    assert_eq!((int_rem(-7, 3), int_rem(7, -3)), (Ok(-1), Ok(1)));
}

#[test]
fn remainder_of_floats_has_the_sign_of_the_dividend() {
    assert_eq!((rem(-7.5, 2.0), rem(7.5, -2.0)), (Ok(-1.5), Ok(1.5)));
    assert_eq!(rem(1.0, 0.0), Err(Error::DivisionByZero));
    assert_eq!(rem(1.0, f64::INFINITY), Err(Error::NotFinite));
}

#[test]
fn floats_become_ints_toward_zero_or_fault() {
    assert_eq!((float_to_int(-2.9), float_to_int(2.9)), (Ok(-2), Ok(2)));
    assert_eq!(float_to_int(-9_223_372_036_854_775_808.0), Ok(i64::MIN));
    for value in [9_223_372_036_854_775_808.0, f64::NAN, f64::INFINITY] {
        assert_eq!(float_to_int(value), Err(Error::Overflow), "{value}");
    }
    assert_eq!((bool_to_int(false), bool_to_int(true)), (0, 1));
}

#[test]
fn a_centimetre_literal_is_the_double_nearest_to_its_decimal_value() {
    for centimetres in 1..1000 {
        let (text, exact) = (
            format!("{centimetres} cm"),
            format!("{}.{:02}", centimetres / 100, centimetres % 100),
        );
        assert_eq!(parse_quantity(&text, LENGTHS), Ok(exact.parse().unwrap()), "{text}");
    }
}

#[test]
fn strings_convert_to_numbers_by_the_grammar_of_literals() {
    assert_eq!(parse_quantity(" -1.5e2 cm ", LENGTHS), Ok(-1.5));
    assert_eq!(parse_quantity("2km", LENGTHS), Ok(2000.0));
    for text in
        ["", "30", "30 mm", "30 cm x", "cm", ".5 m", "5. m", "+5 m", "0x10 m", "inf m", "1e999 m"]
    {
        assert_eq!(parse_quantity(text, LENGTHS), Err(Error::NotAValue), "{text}");
    }
    assert_eq!(parse_float("0.5"), Ok(0.5));
    assert_eq!(parse_float("0.5 m"), Err(Error::NotAValue));
    assert_eq!(parse_int("-9223372036854775808"), Ok(i64::MIN));
    for text in ["", "1.0", "9223372036854775808", "--1", "1 m"] {
        assert_eq!(parse_int(text), Err(Error::NotAValue), "{text}");
    }
    assert_eq!((parse_bool(" true"), parse_bool("yes")), (Ok(true), Err(Error::NotAValue)));
    assert_eq!(parse_choice("right", ["left", "right"]), Ok(1));
    assert_eq!(parse_choice("up", ["left", "right"]), Err(Error::NotAValue));
}

#[test]
fn a_quantity_prints_its_si_value_and_unit() {
    assert_eq!(print_quantity(0.3, "m").unwrap().as_str(), "0.3 m");
    assert_eq!(print_quantity(2.0, "").unwrap().as_str(), "2");
    assert_eq!(print_quantity(f64::NAN, "m").err(), Some(Error::NotFinite));
}

#[test]
fn a_string_holds_64_bytes_and_is_never_cut() {
    let half = "ä".repeat(16);
    assert_eq!(join(&half, &half).unwrap().as_str().len(), 64);
    assert_eq!(join(&half, &format!("{half}x")).err(), Some(Error::TooLong));
    let mut text = Text::try_from(half.as_str()).unwrap();
    assert_eq!(text.push(&"x".repeat(33)), Err(Error::TooLong));
    assert_eq!(text.as_str(), half);
}

#[test]
fn times_saturate() {
    assert_eq!(Instant::MAX + Duration::from_secs(1), Instant::MAX);
    assert_eq!(Instant::from_nanos(5) - Instant::from_nanos(9), Duration::ZERO);
    assert_eq!(Duration::from_secs(u64::MAX), Duration::MAX);
    for millis in 0_u32..20_000 {
        let secs = Duration::from_secs_f64(f64::from(millis) / 1000.0);
        assert_eq!(secs, Duration::from_millis(u64::from(millis)));
    }
    assert_eq!(Duration::from_secs_f64(1.4e-9).as_nanos(), 1);
    assert_eq!(Duration::from_secs_f64(1.6e-9).as_nanos(), 2);
    assert_eq!(Duration::from_secs_f64(f64::INFINITY), Duration::MAX);
    assert_eq!(Duration::from_secs_f64(-1.0), Duration::ZERO);
    assert_eq!(Duration::from_secs_f64(f64::NAN), Duration::ZERO);
    assert_eq!(Duration::from_secs_f64(1e300), Duration::MAX);
}

#[test]
fn times_print_as_seconds_with_the_digits_that_matter() {
    assert_eq!(Instant::from_nanos(1_250_000_000).to_string(), "1.250000");
    assert_eq!(Instant::from_nanos(125).to_string(), "0.000000125");
}

#[test]
fn milliseconds_convert_to_seconds_without_loss() {
    for millis in 0..20_000 {
        let span = Duration::from_millis(millis);
        assert_eq!(Duration::from_secs_f64(span.as_secs_f64()), span);
    }
    for (secs, nanos) in
        [(-1.0, 0), (f64::NAN, 0), (f64::INFINITY, u64::MAX), (1e-9, 1), (4e-10, 0)]
    {
        assert_eq!(Duration::from_secs_f64(secs).as_nanos(), nanos, "{secs}");
    }
}

#[test]
fn quantities_print_with_their_si_units() {
    assert_eq!(Speed::from_si(0.3).to_string(), "0.3 m/s");
    assert_eq!(Force::from_si(2.0).to_string(), "2 N");
    assert_eq!(Frequency::from_si(50.0).to_string(), "50 Hz");
    assert_eq!(Quantity::<0, 0, -2, -1, 0, 0>::from_si(1.5).to_string(), "1.5 s^-2/rad");
    assert_eq!(Quantity::<0, 0, 0, 0, 0, 0>::from_si(1.5).to_string(), "1.5");
}
