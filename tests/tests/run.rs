//! The cases of `run/`: interpreter and generated code must both print the expected trace.
//!
//! `AFP_BLESS=1` writes the interpreter's trace; read the difference like code.

#[path = "run/rules.rs"]
mod rules;

use std::path::PathBuf;
use std::{env, fs};

use afp_tests::case::Case;
use afp_tests::compare::part;
use afp_tests::interpret::{graph, interpret};
use afp_tests::script::Script;

/// One module per case, with the plan as Rust and a test that calls [`check`].
mod cases {
    include!(concat!(env!("OUT_DIR"), "/run.rs"));
}

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("run")
}

/// Runs a case through both back ends; `generated` is the compiled one.
fn check(name: &str, generated: fn(&Script) -> Vec<String>) {
    let path = folder().join(format!("{name}.afp"));
    let text = fs::read_to_string(&path).expect("the case can be read");
    let case = Case::parse(&text).expect("its script can be read");
    let graph = graph(name, &case.plan).unwrap_or_else(|errors| panic!("{errors}"));
    let interpreted = interpret(&graph, &case.script);
    if env::var_os("AFP_BLESS").is_some() {
        case.bless(&path, &interpreted).expect("the case can be written");
    } else {
        assert_same(&case.trace, &interpreted, "interpreted");
    }
    assert_same(&interpreted, &generated(&case.script), "generated");
    let copied = Script { copied: true, ..case.script };
    assert_same(&interpreted, &interpret(&graph, &copied), "interpreted, copied at each step");
    assert_same(&interpreted, &generated(&copied), "generated, copied at each step");
}

#[track_caller]
fn assert_same(expected: &[String], actual: &[String], who: &str) {
    if let Some(parted) = part(expected, actual) {
        panic!("{who}: {parted}");
    }
}
