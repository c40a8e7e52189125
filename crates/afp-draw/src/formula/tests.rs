//! Tests of formulas as text.

use super::text;
use crate::sample::compiled;
use afp_dsl::graph::Formula;

/// The text of a formula, printed from the graph and then from the sources.
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
fn necessary_parentheses_are_printed() {
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
fn unnecessary_parentheses_and_conversions_are_not_printed() {
    assert_eq!(shown("((dist) * (count))").0, "dist * count");
    assert_eq!(shown("(dist - 1 m) - 1 m").0, "dist - 1 m - 1 m");
}

#[test]
fn source_text_is_kept() {
    let (printed, kept) = shown("10000 cm");
    assert_eq!((printed.as_str(), kept.as_str()), ("100 m", "10000 cm"));
    let (_, broken) = shown("dist + // more\n 2 cm");
    assert_eq!(broken, "dist + 2 cm");
}
