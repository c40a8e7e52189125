//! Conditions and assignments of declared computations.

use super::{Change, after, edit};

const TEXT: &str = "\
use std

computation Steer {
    in error: length
    out turn: angle
    out far: bool
    state Left when error > 2 cm { turn = 10 deg, far = true }
    state Right when error < -2 cm {}
    state Straight {}
}

plan P {
    start wait
    actor wait: Wait -> terminate
}
";

fn condition(state: &str, condition: Option<&str>) -> Change {
    Change::SetCondition {
        computation: "Steer".to_owned(),
        state: state.to_owned(),
        condition: condition.map(str::to_owned),
    }
}

fn assign(state: &str, output: &str, formula: Option<&str>) -> Change {
    Change::Assign {
        computation: "Steer".to_owned(),
        state: state.to_owned(),
        output: output.to_owned(),
        formula: formula.map(str::to_owned),
    }
}

/// Checks that a change makes the only replacement.
fn replaces(change: Change, from: &str, to: &str) {
    assert_eq!(TEXT.matches(from).count(), 1, "{from}");
    assert_eq!(after(TEXT, change), TEXT.replace(from, to));
}

#[test]
fn a_condition_is_changed_added_and_removed() {
    let two = "error > 2 cm and error < 1 m";
    replaces(condition("Left", Some(two)), "error > 2 cm", two);
    replaces(
        condition("Straight", Some(" error == 0 cm ")),
        "Straight {",
        "Straight when error == 0 cm {",
    );
    replaces(condition("Right", None), "Right when error < -2 cm {}", "Right {}");
    assert_eq!(edit(TEXT, &condition("Left", Some("error > 2 cm"))).unwrap(), []);
}

#[test]
fn an_assignment_is_changed_added_and_removed() {
    replaces(assign("Left", "turn", Some("2 * error / 1 s")), "= 10 deg", "= 2 * error / 1 s");
    replaces(assign("Right", "turn", Some("5 deg")), "-2 cm {}", "-2 cm { turn = 5 deg }");
    replaces(assign("Left", "turn", None), "turn = 10 deg, ", "");
    replaces(assign("Left", "far", None), ", far = true", "");
    let one = TEXT.replace(", far = true", "");
    assert_eq!(after(&one, assign("Left", "turn", None)), one.replace("{ turn = 10 deg }", "{}"));
    let two = after(&one, assign("Left", "far", Some("false")));
    assert_eq!(two, one.replace("10 deg }", "10 deg, far = false }"));
    assert_eq!(edit(TEXT, &assign("Right", "far", None)).unwrap(), []);
    let bare = TEXT.replace("Straight {}", "Straight");
    assert!(
        after(&bare, assign("Straight", "far", Some("false"))).contains("Straight { far = false }")
    );
}

#[test]
fn only_conditions_and_formulas_are_accepted() {
    let refused = |change| edit(TEXT, &change).unwrap_err().reason;
    for text in ["error", "error > 2 cm {} state New when error > 1 cm", "error > 2 cm // no", ""] {
        let expected = format!("'{text}' is not a condition");
        assert_eq!(refused(condition("Left", Some(text))), expected);
    }
    assert_eq!(
        refused(assign("Left", "turn", Some("1 deg, far = true"))),
        "'1 deg, far = true' is not a formula"
    );
    assert_eq!(refused(assign("Left", "a = 1, b", Some("1"))), "'a = 1, b' cannot be a name");
    assert_eq!(refused(condition("Up", None)), "'Steer' has no state 'Up'");
    let other = TEXT.replace("Steer", "Other");
    assert_eq!(
        edit(&other, &condition("Left", None)).unwrap_err().reason,
        "there is no computation 'Steer'"
    );
    let noted = TEXT.replace("turn = 10 deg", "turn = 10 /* why */ deg");
    let reason = edit(&noted, &assign("Left", "turn", None)).unwrap_err().reason;
    assert_eq!(reason, "it contains a comment");
}

#[test]
fn computations_are_added_before_the_first_plan_with_a_new_name() {
    let add = |text: &str| Change::AddPlan { text: text.to_owned() };
    let new = "computation Low {\n    in a: int\n    state Yes when a < 3 {}\n    state No {}\n}\n";
    let wanted = TEXT.replace("plan P", &format!("{new}\nplan P"));
    assert_eq!(after(TEXT, add(&new.replace('\n', " "))), wanted);
    for taken in ["computation P { state S {} }", "plan Steer {}"] {
        let reason = edit(TEXT, &add(taken)).unwrap_err().reason;
        assert!(reason.ends_with("already exists"), "{reason}");
    }
    let reason = edit(TEXT, &add("actor A { state S }")).unwrap_err().reason;
    assert_eq!(reason, "the text has items other than plans and computations");
}
