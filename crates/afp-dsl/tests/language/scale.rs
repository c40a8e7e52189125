//! Large plans: deep ones need no deep stack, long ones need linear time.

use crate::support;

use std::fmt::Write;
use std::sync::Arc;
use std::time::{Duration, Instant};

use afp_dsl::Compiled;
use afp_dsl::timing::timing;
use afp_syntax::diagnostics::{Code, Severity};

fn nested(depth: usize) -> String {
    let mut text = String::from("use carbot\n");
    for level in 0..depth {
        let inner = level + 1;
        let _ =
            writeln!(text, "plan P{level} {{ start a subplan a: P{inner} {{ OK -> terminate }} }}");
    }
    text + &format!(
        "plan P{depth} {{ start a actor a: Forward {{ ForwardSuccessful -> terminate }} }}\n"
    )
}

/// A sequence of actors, each with a supervisor that leads back, and an entry for each.
fn long(length: usize) -> String {
    let mut text = String::from(
        "use carbot\nplan P {\n    start a0\n    supervise escape: CheckEscapeButton { EscapeButtonPressed -> terminate }\n",
    );
    for at in 0..length {
        let next = match at + 1 == length {
            true => "terminate".to_owned(),
            false => format!("a{}", at + 1),
        };
        let before = at.saturating_sub(1);
        let distance = if at == 0 { "1 m".to_owned() } else { format!("v{before}") };
        let _ = writeln!(
            text,
            "    out v{at}: length\n    actor a{at}: Forward(distance = {distance}, driven => v{at}) {{\n        supervise touch: CheckTouchSensor {{ TouchSensorPressed -> terminate }}\n        ForwardSuccessful -> {next}\n    }}"
        );
    }
    text + "}\n"
}

#[test]
fn a_thousand_nested_sub_plans_fit_on_the_stack() {
    let compiled = support::compile(&nested(1000), &support::toolboxes());
    let graph = compiled.graph.unwrap();
    assert!(compiled.diags.is_empty());
    let timing = timing(&graph, None);
    let (_, path) = timing.demand.unwrap();
    assert_eq!(path.split('.').count(), 1001);
}

#[test]
fn plans_that_are_too_large_to_unfold_are_refused() {
    let mut text = String::from("use carbot\nplan P0 { start a subplan a: P1 { OK -> b } ");
    text += "subplan b: P1 { OK -> terminate } }\n";
    for level in 1..40 {
        let inner = level + 1;
        let _ = writeln!(
            text,
            "plan P{level} {{ start a subplan a: P{inner} {{ OK -> b }} subplan b: P{inner} {{ OK -> terminate }} }}"
        );
    }
    text += "plan P40 { start a actor a: Forward { ForwardSuccessful -> terminate } }\n";
    let compiled = support::compile(&text, &support::toolboxes());
    let codes: Vec<_> = compiled.diags.iter().map(|each| each.code.as_str()).collect();
    assert_eq!(codes, ["E0231"], "{}", compiled.render(false));
    assert!(compiled.graph.is_none());
    let deep = support::compile(&nested(1001), &support::toolboxes()).render(false);
    assert!(deep.contains("1001 deep; at most 1000"), "{deep}");
}

/// The shorter of two times for compiling a text; `check` asserts the result.
fn least(text: &str, check: impl Fn(&Compiled)) -> Duration {
    let toolboxes = support::toolboxes();
    let run = || {
        let begin = Instant::now();
        let compiled = support::compile(text, &toolboxes);
        check(&compiled);
        begin.elapsed()
    };
    (0..2).map(|_| run()).min().unwrap_or(Duration::ZERO)
}

/// Checks that a long task takes less than this many times as long as a short one. The machine may
/// be busy during one of them, so both are repeated together.
fn takes_at_most(most: u32, what: &str, short: impl Fn() -> Duration, long: impl Fn() -> Duration) {
    let fits = |(short, long): &(Duration, Duration)| {
        *long < (*short).max(Duration::from_millis(1)) * most
    };
    let mut tries = Vec::new();
    for _ in 0..4 {
        tries.push((short(), long()));
        if tries.last().is_some_and(fits) {
            return;
        }
    }
    panic!("{what}: never less than {most} times: {tries:?}");
}

#[test]
fn ten_times_the_plan_takes_about_ten_times_as_long() {
    let check = |compiled: &Compiled| {
        assert!(compiled.graph.is_some(), "{}", compiled.render(false));
    };
    let time = |length: usize| move || least(&long(length), check);
    // A quadratic part would take a hundred times as long.
    takes_at_most(35, "400 and 4000 actors", time(400), time(4000));
}

/// A chain of elements with conditions forwards and back, which never hold together.
fn contradicting(length: usize) -> String {
    let mut text = String::from("use std\nplan P {\n    in x: float = 0\n    start a0\n");
    for at in 0..length {
        let (next, before) = ((at + 1) % length, at.saturating_sub(1));
        let _ = writeln!(
            text,
            "    actor a{at}: Wait {{ supervise s: CheckValue(value = x, limit = 1) {{ Below -> a{next}, Above -> a{before} }} Elapsed -> terminate }}"
        );
    }
    text + "}\n"
}

/// A ring of elements with conditions, of which the first and the last never hold together, and as
/// many edges from the last to the first.
fn ring(length: usize) -> String {
    let mut text = String::from("use std\nplan P {\n    start a0\n    in v0: float = 0\n");
    for at in 0..length {
        let next = at + 1;
        let _ = writeln!(
            text,
            "    in v{next}: float = 0\n    actor a{at}: Wait {{ supervise s: CheckValue(value = v{at}, limit = v{next}) {{ Below -> a{next}, Above -> ignore }} Elapsed -> terminate }}"
        );
    }
    let _ = writeln!(text, "    actor a{length}: Wait {{");
    for at in 0..length {
        let _ = writeln!(
            text,
            "        supervise s{at}: CheckValue(value = v{length}, limit = v0) {{ Below -> a0, Above -> ignore }}"
        );
    }
    text + "        Elapsed -> terminate\n    }\n}\n"
}

/// An element with edges for unknown states, all with one name, and with different names.
fn undeclared_states(count: usize) -> String {
    let names: String = (0..count).map(|at| format!("A, B{at}, ")).collect();
    format!(
        "use std\nplan P {{ start a actor a: Wait {{ {names}C -> terminate Elapsed -> terminate }} }}\n"
    )
}

/// An element with bindings for unknown ports.
fn undeclared_ports(count: usize) -> String {
    let binds: String =
        (0..count).map(|at| format!("p = 1, p{at} = 1, q => x, q{at} => x, ")).collect();
    format!("use std\nplan P {{ start a actor a: Wait({binds}) {{ Elapsed -> terminate }} }}\n")
}

/// A text with this many items.
type Text = fn(usize) -> String;

#[test]
fn ten_times_the_items_take_about_ten_times_as_long() {
    let texts: [(Text, usize); 4] =
        [(contradicting, 400), (ring, 150), (undeclared_states, 500), (undeclared_ports, 400)];
    for (of, count) in texts {
        let time = |count: usize| {
            move || {
                least(&of(count), |compiled| {
                    assert!(!compiled.render(false).is_empty() || compiled.graph.is_some())
                })
            }
        };
        takes_at_most(35, &of(2), time(count), time(10 * count));
    }
}

#[test]
fn ten_times_the_unknown_names_take_about_ten_times_as_long() {
    let time = |count: usize| {
        move || {
            let mut text = String::from("use carbot\nplan P {\n    start a0\n");
            for at in 0..count {
                let to = at * 7 % (count + 1);
                let _ = writeln!(text, "    actor a{at}: Forward {{ ForwardSuccessful -> b{to} }}");
            }
            text += "}\n";
            least(&text, |compiled| {
                let unknown = compiled.diags.iter().filter(|each| each.code.as_str() == "E0216");
                assert_eq!(unknown.count(), count);
            })
        }
    };
    // Comparing all pairs would take a hundred times as long.
    takes_at_most(50, "312 and 3120 names", time(312), time(3120));
}

#[test]
fn only_twenty_of_thousands_of_errors_are_shown() {
    let wrong = (0..4000).map(|at| format!("const a{at} = 1 m + 1 s "));
    let text = format!("plan P {{ {}}}", wrong.collect::<String>());
    let compiled = support::compile(&text, &support::toolboxes());
    let errors = compiled.diags.iter().filter(|each| each.severity == Severity::Error).count();
    assert_eq!(errors, 4001);
    let shown = compiled.render(false);
    assert!(shown.ends_with("and 3,981 more errors"), "{}", &shown[shown.len() - 100..]);
    assert!(shown.len() < 30 * text.len(), "{} bytes", shown.len());
    let lines = compiled.diags.json_lines(&compiled.sources);
    assert_eq!(lines.lines().count(), 1001);
    assert!(lines.lines().last().is_some_and(|it| it.contains("and 3,001 more errors")));
}

#[test]
fn a_repeated_cause_is_reported_once() {
    let toolboxes = support::toolboxes();
    let edges =
        |count: usize| "    actor a: Forward { ForwardSuccessful -> zurück }\n".repeat(count);
    for (piece, places) in [
        (edges(2001), "the name 'zurück' has characters that are not ASCII, at 2,001 places"),
        ("    const a = 1;\n".repeat(2001), "';' has no meaning here, at 2,001 places"),
    ] {
        let compiled =
            support::compile(&format!("plan P {{\n    start a\n{piece}}}\n"), &toolboxes);
        let found = compiled.diags.iter().filter(|each| each.code < Code::E0201);
        let found: Vec<_> = found.map(|each| each.message_text()).collect();
        assert_eq!(found, [places]);
    }
}

/// One-line files with an error at every token took quadratic time, as well as many errors, and
/// errors that refer far back, for which the file was read again each time.
#[test]
fn sixteen_times_the_junk_takes_about_sixteen_times_as_long() {
    let pieces = [
        "{ supervise ",
        "plan { ",
        "scenario use ",
        "table scenario ",
        "actor Forward ",
        "=> # ",
        "( ",
        "# x = 3\n",
        "--------------------",
        "plan P {}\n",
        "actor a: Forward(\n",
        "actor a: W { a, a, a, ",
        "\"",
        "\u{201c}",
        "#=",
        "/**/",
        "& ",
        "\u{e9} ",
        "; ",
        "after 3 s -> ",
        "n [n < 3] -> ",
        "-> { n = ",
        "if ( ",
    ];
    let shown = |compiled: &Compiled| assert!(!compiled.render(false).is_empty());
    for piece in pieces {
        let time = |count: usize| move || least(&piece.repeat(count), shown);
        // Quadratic time would be a factor of 256.
        takes_at_most(90, piece, time(125), time(2000));
    }
}

/// Thousands of scenarios with separate graphs took gigabytes.
#[test]
fn scenarios_of_one_plan_share_its_graph() {
    let mut text = long(20);
    for at in 0..5 {
        let _ =
            writeln!(text, "scenario \"s{at}\" for P {{\n    over seeds 0..3\n    expect end\n}}");
    }
    let scenarios = support::compile(&text, &support::toolboxes()).scenarios;
    assert_eq!(scenarios.len(), 15);
    assert!(scenarios.iter().all(|one| Arc::ptr_eq(&one.graph, &scenarios[0].graph)));
}

#[test]
fn an_unknown_name_is_not_searched_in_every_copy_of_a_plan() {
    let mut text = String::from("use std\nplan P { start a subplan a: L40 { OK -> terminate } }\n");
    text += "plan L0 { start x out a: int = 0 ";
    text += "computation x: Assign(value = 1, result => a) { Done -> terminate } }\n";
    for level in 1..=40 {
        let inner = level - 1;
        let _ = writeln!(
            text,
            "plan L{level} {{ start a subplan a: L{inner} {{ OK -> b }} subplan b: L{inner} {{ OK -> terminate }} }}"
        );
    }
    text += "scenario \"s\" for P { at 1 s: fire Nothing  expect end }\n";
    // Exponential time would not end.
    let compiled = support::compile(&text, &support::toolboxes());
    assert!(compiled.graph.is_none());
}
