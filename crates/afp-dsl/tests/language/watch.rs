//! Watches of a running plan.

use afp_dsl::Toolboxes;
use afp_dsl::compile;
use afp_dsl::files::Texts;
use afp_dsl::graph::{EntryId, Graph};
use afp_dsl::toolbox::Constant;
use afp_dsl::watch::Watch;
use afp_syntax::source::Source;

const PLAN: &str = "\
use std
enum Side { left right }
plan Run {
    in  way:    length = 30 cm
    var left:   int = 0
    var lost:   bool = false
    var said:   string = \"a < b\"
    var side:   Side = Side.right
    var unset:  duration
    start rest
    actor rest: Wait(duration = 1 s) { Elapsed -> rest }
    supervise end: CheckTimeout(duration = 9 s) { TimedOut -> terminate }
}
";

fn graph() -> Graph {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let compiled = compile(&Source::new("run.afp", PLAN), &toolboxes, &Texts::default());
    compiled.graph.as_ref().cloned().unwrap_or_else(|| panic!("{}", compiled.render(false)))
}

/// The values of the entries after a while.
fn now(entry: EntryId) -> Option<Constant> {
    [
        Some(Constant::Float(0.3)),
        Some(Constant::Int(4)),
        Some(Constant::Bool(true)),
        Some(Constant::try_from("a < b").unwrap()),
        Some(Constant::Choice(1)),
        None,
    ][entry.index()]
    .clone()
}

#[test]
fn watches_are_formulas_of_the_plan() {
    let graph = graph();
    for (text, value) in [
        ("way", "Some(Float(0.3))"),
        ("(way + 1 cm) ", "Some(Float(0.31))"),
        ("way + 20 cm", "Some(Float(0.5))"),
        ("left % 3", "Some(Int(1))"),
        ("max(left, 7)", "Some(Int(7))"),
        ("lost", "Some(Bool(true))"),
        ("lost == true", "Some(Bool(true))"),
        ("way > 25 cm", "Some(Bool(true))"),
        ("way<=25cm", "Some(Bool(false))"),
        ("2 * way == 60 cm", "Some(Bool(true))"),
        ("left != 4", "Some(Bool(false))"),
        ("left >= 4.5", "Some(Bool(false))"),
        ("left == 4.7", "Some(Bool(false))"),
        ("left == 8 / 2", "Some(Bool(true))"),
        ("left < 4.5", "Some(Bool(true))"),
        ("4.5 > left", "Some(Bool(true))"),
        ("said == \"a < b\"", "Some(Bool(true))"),
        ("side == Side.right", "Some(Bool(true))"),
        ("side", "Some(Choice(1))"),
        ("unset", "None"),
        ("unset < 2 s", "None"),
    ] {
        let watch =
            Watch::new(&graph, graph.main, text).unwrap_or_else(|why| panic!("{text}: {why}"));
        let value_now = watch.value(&now).unwrap_or_else(|why| panic!("{text}: {why:?}"));
        assert_eq!(format!("{value_now:?}"), value, "{text}");
    }
    let divided = Watch::new(&graph, graph.main, "1 % (left - 4)").expect("a formula");
    divided.value(&now).expect_err("nothing can be divided by 0");
}

#[test]
fn an_expression_that_cannot_be_watched_has_a_reason() {
    let graph = graph();
    for (text, why) in [
        ("", "expected a formula (help: "),
        ("wey", "'wey'"),
        ("way > 3", ""),
        ("way + 1 s", ""),
        ("side < Side.left", "have no order (help: write '==' or '!=')"),
        ("way > ", ""),
        ("way } plan Q {", "'way } plan Q {' is not a formula"),
        ("way == 1 m == 2 m", "unexpected '== 2 m' after the formula (help: write an entry"),
        ("way way", "unexpected 'way' after the formula (help: write an entry"),
        ("way, left", "unexpected ', left' after the formula"),
        ("?", "formulas have no '?' (help: write an entry"),
        ("not lost", "formulas have no 'not' (help: write an entry"),
        ("lost && lost", "(help: write an entry by its name"),
        ("lost ? way : 1 m", "(help: write an entry by its name"),
        ("left = 3", "'=' compares nothing (help: write 'left == 3')"),
        ("Run.way", "there is no enum 'Run' (help: write an entry by its name"),
        ("Side.up", "'Side' has no value 'up' (help: write 'left' or 'right')"),
    ] {
        let refused = Watch::new(&graph, graph.main, text).expect_err(text);
        assert!(refused.to_string().contains(why), "{text}: {refused}");
    }
}
