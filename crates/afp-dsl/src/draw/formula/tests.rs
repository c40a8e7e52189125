//! Tests of formulas as text.

use super::{duration, quantity, text};
use crate::draw::sample::compiled;
use crate::graph::Formula;
use crate::types::Dimension;

/// The text of a formula as printed from the graph, then with the sources at hand.
fn shown(written: &str) -> (String, String) {
    let plan = format!(
        "use std\nplan Shown {{\nin dist: length = 30 cm\nin count: int = 1\nstart log\n\
         computation log: Log(value = {written}) {{ Done -> terminate }}\n}}\n"
    );
    let compiled = compiled(&plan);
    let graph = compiled.graph.unwrap();
    let formula: &Formula = &graph.main().elements[0].inputs[0];
    (text(formula, graph.main(), None), text(formula, graph.main(), Some(&compiled.sources)))
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
    assert!(shown.contains("33333333333333"), "{shown}");
}

#[test]
fn brackets_stand_where_they_are_needed() {
    for written in [
        "dist + 5 cm",
        "2 * (dist + 5 cm)",
        "dist + 5 cm - dist",
        "dist - (dist + 5 cm)",
        "-dist",
        "-(dist + 5 cm)",
        "dist / (2 * dist)",
        "count % 3 + 1",
        "\"at \" + dist",
    ] {
        assert_eq!(shown(written), (written.to_owned(), written.to_owned()));
    }
}

#[test]
fn needless_brackets_and_conversions_are_not_printed() {
    assert_eq!(shown("((dist) * (count))").0, "dist * count");
    assert_eq!(shown("(dist - 1 m) - 1 m").0, "dist - 1 m - 1 m");
}

#[test]
fn what_was_written_is_kept() {
    let (printed, kept) = shown("10000 cm");
    assert_eq!((printed.as_str(), kept.as_str()), ("100 m", "10000 cm"));
    let (_, broken) = shown("dist + // more\n 2 cm");
    assert_eq!(broken, "dist + 2 cm");
}

#[test]
fn durations_are_whole_numbers_of_a_unit() {
    assert_eq!(duration(1_000_000), "1 ms");
    assert_eq!(duration(2_000_000_000), "2 s");
    assert_eq!(duration(1_500_000), "1500 us");
    assert_eq!(duration(7), "7 ns");
}
