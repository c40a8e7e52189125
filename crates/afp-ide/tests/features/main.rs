//! Features case by case: texts with cursor marks `$0`, and the answers after each text.
//!
//! `AFP_BLESS=1` rewrites the answers; read the diff like code.

mod answers;
mod prefixes;
mod shipped;
mod support;

use support::{Case, cases, compare};

type Answer = fn(&Case) -> String;

/// The features, by the folder of their cases.
const FEATURES: &[(&str, Answer)] = &[
    ("actions", answers::actions),
    ("colours", answers::colours),
    ("completion", answers::completion),
    ("definition", answers::definition),
    ("folding", answers::folding),
    ("hints", answers::hints),
    ("hover", answers::hover),
    ("lenses", answers::lenses),
    ("references", answers::references),
    ("selection", answers::selection),
    ("signature", answers::signature),
    ("symbols", answers::symbols),
];

#[test]
fn every_case_has_its_answers() {
    let mut wrong = Vec::new();
    for (folder, answer) in FEATURES {
        let cases = cases(folder);
        assert!(!cases.is_empty(), "no case of '{folder}'");
        for (path, case) in cases {
            wrong.extend(compare(&path, &case, &answer(&case)));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
