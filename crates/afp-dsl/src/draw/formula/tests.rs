//! Tests of formulas as text.

use super::{duration, quantity, text};
use crate::draw::sample::{binary, entry, float, int, neg, plan_with_entries, quantity_of};
use crate::graph::{Formula, FormulaKind, Operator};
use crate::source::{Source, Sources, Span};
use crate::types::{Conversion, Dimension, Type};

fn shown(formula: &Formula) -> String {
    text(formula, &plan_with_entries(&["walldist", "wallangle"]), None)
}

#[test]
fn quantities_get_a_unit_that_suits_their_size() {
    for (name, value, expected) in [
        ("length", 0.3, "30 cm"),
        ("length", 0.35, "35 cm"),
        ("length", -100.0, "-100 m"),
        ("length", 0.002, "2 mm"),
        ("angle", -60.0 * core::f64::consts::PI / 180.0, "-60 deg"),
        ("speed", 0.2, "20 cm/s"),
        ("duration", 0.001, "1 ms"),
        ("duration", 2.5, "2.5 s"),
        ("force", 3.0, "3 N"),
        ("float", 1.5, "1.5"),
    ] {
        let dimension = Dimension::named(name).unwrap_or(Dimension::NONE);
        assert_eq!(quantity(value, dimension), expected);
    }
}

#[test]
fn a_value_without_a_short_decimal_keeps_all_its_digits() {
    let length = Dimension::named("length").unwrap();
    let shown = quantity(1.0 / 3.0, length);
    assert!(shown.starts_with("0.333333333333333") || shown.starts_with("33.3333333333333"), "{shown}");
}

#[test]
fn brackets_stand_where_they_are_needed() {
    let [dist, angle] = [entry(0), entry(1)];
    let sum = binary(Operator::Add, dist.clone(), quantity_of("length", 0.05));
    assert_eq!(shown(&sum), "walldist + 5 cm");
    let product = binary(Operator::Mul, int(2), sum.clone());
    assert_eq!(shown(&product), "2 * (walldist + 5 cm)");
    let left = binary(Operator::Sub, sum.clone(), angle.clone());
    assert_eq!(shown(&left), "walldist + 5 cm - wallangle");
    let right = binary(Operator::Sub, angle, sum.clone());
    assert_eq!(shown(&right), "wallangle - (walldist + 5 cm)");
    assert_eq!(shown(&neg(dist)), "-walldist");
    assert_eq!(shown(&neg(sum)), "-(walldist + 5 cm)");
    assert_eq!(shown(&neg(neg(float(1.0)))), "--1");
}

#[test]
fn conversions_are_not_shown() {
    let inner = Box::new(int(1));
    let kind = FormulaKind::Convert(Conversion::IntToFloat, inner);
    assert_eq!(shown(&Formula { kind, ty: Type::FLOAT, span: Span::default() }), "1");
}

#[test]
fn what_was_written_is_kept() {
    let mut sources = Sources::default();
    let file = sources.add(Source::new("a.afp", "x = 10000 cm, y = 1 cm + // more\n 2 cm").into());
    let span = |start, end| Span { file: file.unwrap(), start, end };
    let plan = plan_with_entries(&[]);
    let written = Formula { span: span(4, 12), ..quantity_of("length", 100.0) };
    assert_eq!(text(&written, &plan, Some(&sources)), "10000 cm");
    let broken = Formula { span: span(18, 38), ..quantity_of("length", 0.03) };
    assert_eq!(text(&broken, &plan, Some(&sources)), "3 cm");
}

#[test]
fn durations_are_whole_numbers_of_a_unit() {
    assert_eq!(duration(1_000_000), "1 ms");
    assert_eq!(duration(2_000_000_000), "2 s");
    assert_eq!(duration(1_500_000), "1500 us");
    assert_eq!(duration(7), "7 ns");
}
