//! Bindings that are only a name.

use super::{Binding, Change, Item, after, refused};

const PLANS: &str = "\
use std

table route(x: length) { (1 m) }

plan P {
    var goal: length
    var x:    length
    start at
    computation at: Row(table = route, index = 0, x) { Row -> go, End -> terminate }
    subplan go: Q(x, goal) { OK -> last, Error -> terminate }
    subplan last: Q(x, goal = x) { OK -> terminate, Error -> terminate }
}

plan Q {
    in  x:    length
    out goal: length
    start rest
    computation rest: Log(label = \"\", x) { Done -> copy }
    computation copy: Assign(value = x, result => goal) { Done -> terminate }
}
";

fn rename(item: Item, to: &str) -> Change {
    Change::Rename { item, to: to.into() }
}

/// The text between two others after a change.
#[track_caller]
fn between(change: Change, before: &str, behind: &str) -> String {
    let text = after(PLANS, change);
    let from = text.find(before).unwrap_or_else(|| panic!("no '{before}' in\n{text}"));
    let rest = &text[from + before.len()..];
    rest[..rest.find(behind).unwrap()].to_owned()
}

#[test]
fn a_renamed_entry_leaves_the_port_its_name() {
    let change = || rename(Item::inner("P", "goal"), "there");
    assert_eq!(between(change(), "go: ", " {"), "Q(x, goal => there)");
    assert_eq!(between(change(), "var there", "\n"), ": length");
    let change = || rename(Item::inner("P", "x"), "far");
    assert_eq!(between(change(), "go: ", " {"), "Q(x = far, goal)");
    assert_eq!(between(change(), "at: ", " {"), "Row(table = route, index = 0, x => far)");
    let back = after(&after(PLANS, change()), rename(Item::inner("P", "far"), "x"));
    assert!(back.contains("go: Q(x = x, goal) {"), "{back}");
}

#[test]
fn a_renamed_port_leaves_the_entry_its_name() {
    let change = || rename(Item::inner("Q", "goal"), "there");
    assert_eq!(between(change(), "go: ", " {"), "Q(x, there => goal)");
    assert_eq!(between(change(), "last: ", " {"), "Q(x, there = x)");
    let change = || rename(Item::inner("Q", "x"), "far");
    assert_eq!(between(change(), "go: ", " {"), "Q(far = x, goal)");
    assert_eq!(between(change(), "rest: ", " {"), "Log(label = \"\", x = far)");
    let column =
        Change::RenameColumn { table: "route".into(), column: "x".into(), to: "far".into() };
    assert_eq!(between(column, "at: ", " {"), "Row(table = route, index = 0, far => x)");
}

#[test]
fn a_short_binding_can_be_changed_and_removed() {
    let bind =
        |port: &str, to| Change::Bind { component: Item::inner("P", "go"), port: port.into(), to };
    let to = |formula: &str| Binding::In(formula.into());
    assert_eq!(between(bind("x", to("2 m")), "go: ", " {"), "Q(x = 2 m, goal)");
    let out = Binding::Out("x".into());
    assert_eq!(between(bind("goal", out), "go: ", " {"), "Q(x, goal => x)");
    assert_eq!(after(PLANS, bind("x", to("x"))), PLANS);
    let unbind = Change::Unbind { component: Item::inner("P", "go"), port: "x".into() };
    assert_eq!(between(unbind, "go: ", " {"), "Q(goal)");
    let goal = Change::Remove { item: Item::inner("P", "goal") };
    assert_eq!(between(goal, "go: ", " {"), "Q(x)");
    refused(PLANS, Change::Remove { item: Item::inner("P", "x") }, "'x' is read by 'go'");
}

#[test]
fn a_short_binding_moves_between_plans() {
    let inline = Change::Inline { plan: "P".into(), element: "go".into() };
    let text = after(PLANS, inline);
    assert!(text.contains("rest: Log(label = \"\", x) {"), "{text}");
    let far = PLANS.replace("x, goal)", "x = 2 * x, goal)");
    let text = after(&far, Change::Inline { plan: "P".into(), element: "go".into() });
    assert!(text.contains("Log(label = \"\", x = (2 * x)) {"), "{text}");
}
