//! Several changes at once, with references to new items.

use super::super::{Change, Item, apply, edit_all};
use super::{Binding, toolboxes};
use afp_syntax::source::Source;

const PLAN: &str = "\
use std

plan Inner {
    in  far: float
    out result: float
    start a
    actor a: Wait(duration = 1 s) { Elapsed -> terminate }
}

plan P {
    const period: time = 10 ms
    var speed: float = 1
    start go
    actor go: Wait(duration = 1 s) { Elapsed -> terminate }
    supervise low: CheckValue(value = speed, limit = 9) { Below -> go, Above -> ignore }
}
";

/// The text after changes, and the assigned names.
#[track_caller]
fn after(changes: &[Change]) -> (String, Vec<(String, String)>) {
    match edit_all(&[Source::new("case.afp", PLAN)], &toolboxes(), 0, changes) {
        Ok(made) => (apply(PLAN, &made.edits), made.given.all().to_vec()),
        Err(refused) => panic!("{changes:?}: {refused}"),
    }
}

fn add(text: &str) -> Change {
    Change::Add { plan: "P".into(), owner: None, text: text.into(), before: None }
}

fn add_to(owner: &str, text: &str) -> Change {
    Change::Add { plan: "P".into(), owner: Some(owner.into()), text: text.into(), before: None }
}

fn bind(component: &str, port: &str, to: Binding) -> Change {
    Change::Bind { component: Item::inner("P", component), port: port.into(), to }
}

#[track_caller]
fn has(changes: &[Change], lines: &[&str]) {
    let (text, _) = after(changes);
    for line in lines {
        assert!(text.lines().any(|known| known.trim() == *line), "{line} is not in\n{text}");
    }
}

#[test]
fn an_assigned_name_is_not_looked_up_again() {
    let wait = "(duration = 1 s) { Elapsed -> terminate }";
    let two = [add(&format!("actor go: Wait{wait}")), add(&format!("actor go2: Wait{wait}"))];
    let go = || Item::inner("P", "go");
    let connect = Change::Connect { from: go(), outcome: "Elapsed".into(), to: "go2".into() };
    let mut changes = two.to_vec();
    changes.push(connect);
    let (text, names) = after(&changes);
    let given = [("go", "go2"), ("go2", "go22")].map(|(a, b)| (a.to_owned(), b.to_owned()));
    assert_eq!(names, given);
    assert!(text.contains("actor go2: Wait(duration = 1 s) { Elapsed -> go22 }"), "{text}");
    // New supervisors and reactions of new items.
    let touch = "supervise low: CheckTimeout(duration = 1 s) { TimedOut -> go2 }";
    changes.extend([add_to("go2", touch), add_to("go2", touch)]);
    let low = Item::local("P", "go2", "low");
    changes.push(Change::Connect { from: low, outcome: "TimedOut".into(), to: "go".into() });
    has(
        &changes,
        &[
            "supervise low: CheckTimeout(duration = 1 s) { TimedOut -> go22 }",
            "supervise low2: CheckTimeout(duration = 1 s) { TimedOut -> go2 }",
        ],
    );
}

#[test]
fn an_entry_from_parts_gets_a_free_name_that_later_changes_use() {
    let speed = Change::AddEntry {
        plan: "P".into(),
        keyword: "var".into(),
        name: "speed".into(),
        ty: None,
        value: Some("3".into()),
    };
    let bound = bind("low", "limit", Binding::In("speed".into()));
    let (text, _) = after(&[speed, bound]);
    for part in ["var speed2 = 3", "limit = speed2"] {
        assert!(text.contains(part), "{text}");
    }
}

#[test]
fn formulas_and_outputs_mean_what_was_added() {
    let speed = add("var speed: float = 2");
    let inner = add("subplan part: Inner(far = 1) { OK -> terminate }");
    let formula = |text: &str| Binding::In(text.into());
    let value = Change::SetEntryValue {
        entry: Item::inner("P", "other"),
        value: Some("speed * 2 + period / 1 s".into()),
    };
    let every = Change::SetTiming {
        supervisor: Item::inner("P", "late"),
        keyword: "every".into(),
        value: Some("period".into()),
    };
    has(
        &[
            speed.clone(),
            inner,
            add("const period: time = 20 ms"),
            add("in other: float = 0"),
            add("supervise late: CheckTimeout(duration = 1 s) { TimedOut -> go }"),
            bind("part", "far", formula("2 * (speed + other)")),
            bind("part", "result", Binding::Out("speed".into())),
            value,
            every,
        ],
        &[
            "var speed2: float = 2",
            "subplan part: Inner(far = 2 * (speed2 + other), result => speed2) { OK -> terminate }",
            "in other: float = speed2 * 2 + period2 / 1 s",
            "supervise late: CheckTimeout(duration = 1 s) every period2 { TimedOut -> go }",
        ],
    );
}

#[test]
fn texts_mean_what_was_added() {
    let wait = "(duration = 1 s) { Elapsed -> terminate }";
    has(
        &[
            add("var speed: float = 2"),
            add(&format!("actor go: Wait{wait}")),
            add("supervise low: CheckTimeout(duration = 1 s) { TimedOut -> go }"),
            add("subplan part: Inner(far = speed, result => speed) { OK -> go }"),
            add("var far: float = 1\nvar result: float = 1"),
            add(
                "subplan whole: Inner(far, result) { OK -> part }\nactor part: Wait(duration = 1 s) {\nElapsed -> part\non low { TimedOut -> go }\n}",
            ),
        ],
        &[
            "supervise low2: CheckTimeout(duration = 1 s) { TimedOut -> go2 }",
            "subplan part: Inner(far = speed2, result => speed2) { OK -> go2 }",
            "subplan whole: Inner(far, result) { OK -> part2 }",
            "Elapsed -> part2",
            "on low2 { TimedOut -> go2 }",
        ],
    );
}

#[test]
fn a_port_that_is_its_entry_is_spelled_out() {
    has(
        &[
            add("var far: float = 1\nvar result: float = 1"),
            add("var far: float = 2\nvar result: float = 2"),
            add("subplan whole: Inner(far, result) { OK -> terminate }"),
        ],
        &["subplan whole: Inner(far = far2, result => result2) { OK -> terminate }"],
    );
}
