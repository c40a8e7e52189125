//! Edges and the start.

use super::{Change, Item, PLAN, after, back, go, refused, replaces, touch};

fn connect(from: Item, outcome: &str, to: &str) -> Change {
    Change::Connect { from, outcome: outcome.into(), to: to.into() }
}

fn disconnect(from: Item, outcome: &str) -> Change {
    Change::Disconnect { from, outcome: outcome.into() }
}

#[test]
fn the_target_of_an_edge_changes() {
    replaces(connect(go(), "Done", "back"), &[("Done  -> go // again", "Done  -> back // again")]);
    replaces(connect(go(), "Done", "go"), &[]);
    replaces(connect(touch(), "Pressed", "ignore"), &[("Pressed -> back", "Pressed -> ignore")]);
}

#[test]
fn an_edge_leads_to_fail_and_back() {
    let stuck = "fail \"it is \\\"stuck\\\"\"";
    let failing = PLAN.replace("Pressed -> back", &format!("Pressed -> {stuck}"));
    assert_eq!(after(PLAN, connect(touch(), "Pressed", stuck)), failing);
    assert_eq!(after(&failing, connect(touch(), "Pressed", stuck)), failing);
    assert_eq!(after(&failing, connect(touch(), "Pressed", "back")), PLAN);
    replaces(connect(go(), "Done", "fail"), &[("Done  -> go // again", "Done  -> fail // again")]);
    for wrong in ["fail stuck", "fail \"", "fail \"a\" b\"", "fail \"a\\\"", "fail \"a\nb\""] {
        let message = format!("there is no element '{wrong}' in the plan");
        refused(PLAN, connect(go(), "Done", wrong), &message);
    }
}

#[test]
fn events_and_computations_may_resume() {
    replaces(connect(touch(), "Pressed", "resume"), &[("Pressed -> back", "Pressed -> resume")]);
    refused(PLAN, connect(go(), "Done", "resume"), "an element that has ended cannot be resumed");
    let counts = PLAN.replace("actor back: B", "computation back: B");
    let resumes = counts.replace("Done -> go, Lost", "Done -> resume, Lost");
    assert_eq!(after(&counts, connect(back(), "Done", "resume")), resumes);
}

#[test]
fn a_new_edge_has_the_style_of_its_neighbours() {
    replaces(
        connect(go(), "Lost", "back"),
        &[("        Error -> terminate\n", "        Error -> terminate\n        Lost  -> back\n")],
    );
    replaces(
        connect(touch(), "DeadlineMissed", "ignore"),
        &[("Pressed -> back }", "Pressed -> back, DeadlineMissed -> ignore }")],
    );
    replaces(
        connect(back(), "Error", "go"),
        &[("Lost -> terminate }", "Lost -> terminate, Error -> go }")],
    );
}

#[test]
fn an_edge_goes_with_its_comments() {
    replaces(disconnect(go(), "Done"), &[("        Done  -> go // again\n", "")]);
    replaces(
        disconnect(go(), "Error"),
        &[("        // the way out\n        Error -> terminate\n", "")],
    );
    replaces(disconnect(back(), "Done"), &[("Done -> go, Lost", "Lost")]);
    replaces(disconnect(back(), "Lost"), &[(", Lost -> terminate", "")]);
    replaces(disconnect(touch(), "Pressed"), &[("{ Pressed -> back }", "{}")]);
}

#[test]
fn the_start_changes() {
    let start = |to: &str| Change::SetStart { plan: "P".into(), to: to.into() };
    replaces(start("back"), &[("start go //", "start back //")]);
    refused(PLAN, start("gap"), "'P' has no element 'gap'");
}

#[test]
fn invalid_connections_are_refused() {
    refused(PLAN, connect(go(), "Done", "ignore"), "a state cannot lead to 'ignore'");
    refused(PLAN, connect(go(), "Done", "gap"), "there is no element 'gap' in the plan");
    refused(PLAN, connect(go(), "Done -> x", "go"), "'Done -> x' cannot be a name");
    refused(PLAN, disconnect(go(), "Lost"), "'Lost' of 'go' is not connected");
    refused(
        PLAN,
        connect(Item::inner("P", "gap"), "Done", "go"),
        "'gap' is not an element or supervisor",
    );
}

/// A plan whose states share an edge.
const SHARED: &str = "\
plan P {
    start go
    actor go: A { Done, Lost, Error -> back }
    actor back: B {
        Done, Lost -> terminate
    }
}
";

#[test]
fn a_state_that_shares_an_edge_leaves_it() {
    let changed = |change, old: &str, new: &str| {
        assert_eq!(after(SHARED, change), SHARED.replace(old, new));
    };
    let all = "{ Done, Lost, Error -> back }";
    changed(connect(go(), "Done", "go"), all, "{ Lost, Error -> back, Done -> go }");
    changed(connect(go(), "Error", "go"), all, "{ Done, Lost -> back, Error -> go }");
    changed(connect(go(), "Lost", "back"), all, all);
    changed(disconnect(go(), "Lost"), all, "{ Done, Error -> back }");
    let two = "        Done, Lost -> terminate\n";
    changed(connect(back(), "Lost", "go"), two, "        Done -> terminate\n        Lost -> go\n");
    changed(disconnect(back(), "Done"), two, "        Lost -> terminate\n");
}

/// A plan whose elements have no braces.
const SHORT: &str = "\
use std

plan P {
    start rest
    actor rest: Wait(duration = 1 s) -> work // then work
    subplan work: Q -> say,
    computation say: Log(value = 1) -> fail \"late\"
}

plan Q {
    start rest
    actor rest: Wait -> terminate
}
";

fn rest() -> Item {
    Item::inner("P", "rest")
}

/// Checks that a change of the short plan replaces one text in it.
#[track_caller]
fn shortens(change: Change, old: &str, new: &str) {
    let changed = after(SHORT, change);
    assert_eq!(changed, SHORT.replacen(old, new, 1));
    afp_format::format(&changed).unwrap();
}

#[test]
fn an_edge_without_braces_leads_elsewhere() {
    shortens(connect(rest(), "Elapsed", "say"), "-> work //", "-> say //");
    shortens(connect(Item::inner("P", "work"), "OK", "rest"), "-> say,", "-> rest,");
    shortens(connect(Item::inner("P", "say"), "Done", "rest"), "-> fail \"late\"", "-> rest");
    shortens(connect(rest(), "Elapsed", "work"), "", "");
}

#[test]
fn an_element_without_braces_gets_them_for_more_edges_and_supervisors() {
    let opened = "{\n        Elapsed -> work\n        Error -> say\n    } //";
    shortens(connect(rest(), "Error", "say"), "-> work //", opened);
    let opened = "{\n        OK -> say\n        Interrupted -> rest\n    },";
    shortens(connect(Item::inner("P", "work"), "Interrupted", "rest"), "-> say,", opened);
    let text = "supervise late: CheckTimeout { TimedOut -> work }".to_owned();
    let owner = Some("rest".to_owned());
    let add = Change::Add { plan: "P".into(), owner, text, before: None };
    let opened = "{\n        supervise late: CheckTimeout { TimedOut -> work }\n        Elapsed -> work\n    } //";
    shortens(add, "-> work //", opened);
}

#[test]
fn an_element_without_braces_loses_its_edge() {
    shortens(disconnect(rest(), "Elapsed"), "-> work //", "{} //");
    refused(SHORT, disconnect(rest(), "Error"), "'Error' of 'rest' is not connected");
    let removed = after(SHORT, Change::Remove { item: Item::inner("P", "say") });
    assert!(removed.contains("subplan work: Q {},\n}"), "{removed}");
    let unknown = SHORT.replacen("Wait(", "Nothing(", 1);
    let why = "the edge of 'rest' is not for a known state";
    refused(&unknown, connect(rest(), "Error", "say"), why);
}

#[test]
fn a_sub_plan_without_braces_is_put_into_its_plan() {
    let inline = Change::Inline { plan: "P".into(), element: "work".into() };
    let text = after(SHORT, inline);
    assert!(text.contains("Wait -> say"), "{text}");
    let extract = Change::Extract {
        plan: "P".into(),
        elements: vec!["rest".into(), "work".into()],
        new_plan: "Both".into(),
        element: "both".into(),
    };
    let text = after(SHORT, extract);
    assert!(text.contains("subplan work: Q -> terminate"), "{text}");
}
