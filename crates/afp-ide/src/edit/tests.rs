//! Each change on a small plan, with the exact resulting text.

mod alone;
mod data;
mod declared;
mod files;
mod flow;
mod items;
mod several;
mod structure;
mod tables;

use super::{Binding, Change, Item, Refused, TextEdit, apply};
use afp_dsl::Toolboxes;
use afp_format::format;
use afp_syntax::source::Source;

fn toolboxes() -> Toolboxes {
    afp_toolboxes::sources().collect()
}

/// The edits of a file without a project.
fn edit(text: &str, change: &Change) -> Result<Vec<TextEdit>, Refused> {
    super::edit(&[Source::new("case.afp", text)], &toolboxes(), 0, change)
}

/// A plan with comments in many places.
const PLAN: &str = "\
use std

// About the plan.
plan P {
    in  limit: length = 30 cm // how far
    var gap:   length

    start go // at the beginning

    // a free note

    // belongs to 'go'
    actor go: A(distance = limit, gap => gap) {
        supervise touch: T every 1 ms { Pressed -> back }
        Done  -> go // again
        // the way out
        Error -> terminate
    }

    /// Goes back.
    actor back: B(
        // why
        distance = -limit, // because
        speed = 3 cm/s,
    ) { Done -> go, Lost -> terminate }
}
";

#[track_caller]
fn after(text: &str, change: Change) -> String {
    match edit(text, &change) {
        Ok(edits) => apply(text, &edits),
        Err(refused) => panic!("{change:?}: {refused}"),
    }
}

/// Checks that a change replaces exactly these unique texts in the plan.
#[track_caller]
fn replaces(change: Change, pairs: &[(&str, &str)]) {
    let mut expected = PLAN.to_owned();
    for (old, new) in pairs {
        assert_eq!(expected.matches(old).count(), 1, "{old}");
        expected = expected.replace(old, new);
    }
    let changed = after(PLAN, change);
    assert_eq!(changed, expected);
    format(&changed).unwrap();
}

#[track_caller]
fn refused(text: &str, change: Change, reason: &str) {
    assert_eq!(edit(text, &change).map_err(|refused| refused.reason), Err(reason.to_owned()));
}

fn go() -> Item {
    Item::inner("P", "go")
}

fn back() -> Item {
    Item::inner("P", "back")
}

fn touch() -> Item {
    Item::local("P", "go", "touch")
}
