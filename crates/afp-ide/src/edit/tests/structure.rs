//! Extracting elements into a plan and inlining a sub-plan.

use super::{Change, after, refused};

const PLAN: &str = "\
plan P {
    in  walldist: length = 30 cm
    var angle:    angle
    const half = 2 // of it
    const slow = half * 1 cm/s

    start find

    supervise escape: E { Pressed -> terminate }

    // looks around
    actor find: Search(range = walldist, angle => angle) {
        supervise touch: T { Touched -> back }
        Found -> turn
        Lost  -> back
    }

    actor turn: Turn(angle = angle, speed = slow) {
        supervise touch: T { Touched -> back } // careful
        Done -> follow
    }

    // a free note

    actor follow: Follow(walldist = walldist) { Done -> find }
    actor back: Forward(distance = -walldist) { Done -> find, Error -> terminate }
}

scenario \"s\" for P {
    expect find -> turn
    at 3 s: fire turn.touch.Touched
    until 5 s
}
";

fn extract(elements: &[&str]) -> Change {
    Change::Extract {
        plan: "P".into(),
        elements: elements.iter().map(|name| (*name).to_owned()).collect(),
        new_plan: "Align".into(),
        element: "align".into(),
    }
}

fn inline() -> Change {
    Change::Inline { plan: "P".into(), element: "align".into() }
}

const ONE_WAY: &str = "        Lost  -> back\n";

#[test]
fn a_selection_becomes_a_plan() {
    let text = PLAN.replace(ONE_WAY, "        Lost  -> follow\n");
    let extracted = after(&text, extract(&["turn", "find"]));
    let expected = "\
plan P {
    in  walldist: length = 30 cm
    var angle:    angle
    const half = 2 // of it
    const slow = half * 1 cm/s

    start align

    supervise escape: E { Pressed -> terminate }

    subplan align: Align(walldist = walldist, angle => angle) { OK -> follow, Interrupted -> back }

    // a free note

    actor follow: Follow(walldist = walldist) { Done -> align }
    actor back: Forward(distance = -walldist) { Done -> align, Error -> terminate }
}

plan Align {
    in  walldist: length
    out angle:    angle
    const half = 2
    const slow = half * 1 cm/s

    start find

    // looks around
    actor find: Search(range = walldist, angle => angle) {
        supervise touch: T { Touched -> terminate }
        Found -> turn
        Lost  -> terminate
    }

    actor turn: Turn(angle = angle, speed = slow) {
        supervise touch: T { Touched -> terminate } // careful
        Done -> terminate
    }
}

scenario \"s\" for P {
    expect align.find -> align.turn
    at 3 s: fire align.turn.touch.Touched
    until 5 s
}
";
    assert_eq!(extracted, expected);
    let back =
        after(&after(&extracted, inline()), Change::Remove { item: super::Item::plan("Align") });
    assert_eq!(afp_format::format(&back).unwrap(), text);
}

#[test]
fn scenarios_follow_an_extracted_plan() {
    let text = PLAN.replace(ONE_WAY, "        Lost  -> follow\n");
    let text = text.replace("{ Pressed -> terminate }", "{ Pressed -> find }");
    let scenario = |claim: &str| text.replace("    expect find -> turn\n", claim);
    for (claim, expected) in [
        ("find -> turn by Found", "align.find -> align.turn by Found"),
        ("turn -> follow", "align -> follow"),
        ("turn -> follow by Done", "align -> follow by OK"),
        ("find -> back by touch", "align -> back by Interrupted"),
        ("turn -> back by turn.touch.Touched", "align -> back by Interrupted"),
        ("back -> find by Done", "back -> align by Done"),
        ("follow -> find by escape", "follow -> align by escape"),
        ("turn -> find by escape.Pressed", "align -> align by escape.Pressed"),
        ("back -> terminate by Error", "back -> terminate by Error"),
        ("turn active", "align.turn active"),
        ("turn.touch.Touched", "align.turn.touch.Touched"),
        ("interrupt of turn", "interrupt of align.turn"),
        ("end by turn.Done", "end by align.OK"),
    ] {
        let extracted =
            after(&scenario(&format!("    expect {claim}\n")), extract(&["turn", "find"]));
        let line = extracted.lines().find(|line| line.contains("expect ")).unwrap_or_default();
        assert_eq!(line.trim(), format!("expect {expected}"), "of {claim}");
    }
}

#[test]
fn an_earlier_value_becomes_an_input() {
    let text =
        PLAN.replace(ONE_WAY, "        Lost  -> follow\n").replace("start find", "start turn");
    let text = text.replace("{ Done -> find", "{ Done -> turn");
    let extracted = after(&text, extract(&["find", "turn"]));
    assert!(extracted.contains("Align(walldist = walldist, angleBefore = angle, angle => angle)"));
    assert!(extracted.contains("    in  walldist:    length\n    in  angleBefore: angle\n    out angle:       angle = angleBefore\n"));
}

#[test]
fn a_handler_stays_a_sub_plan() {
    let text = "\
plan P {
    start go

    supervise escape: E { Pressed -> suspend align }

    actor go: Forward { Done -> terminate }

    subplan align: Align { OK -> return }
}

plan Align {
    start go

    actor go: Forward { Done -> terminate }
}
";
    let whole = "'align' handles an interruption as a whole, which its elements cannot do";
    refused(text, inline(), whole);
}

#[test]
fn a_flow_that_a_sub_plan_cannot_have_is_refused() {
    let ways = |what: &str| format!("{what}, but a sub-plan has only one target for them");
    refused(PLAN, extract(&["find", "turn"]), &ways("states lead to 'back' and 'follow'"));
    refused(
        PLAN,
        extract(&["follow", "back"]),
        &ways("'start' and edges lead to 'back' and 'follow'"),
    );
    let ends = PLAN.replace("{ Touched -> back } //", "{ Touched -> terminate } //");
    refused(
        &ends,
        extract(&["turn"]),
        "an event of the selection ends the plan as Interrupted, and a sub-plan cannot end its caller",
    );
    refused(PLAN, extract(&[]), "no element is selected");
    refused(PLAN, extract(&["x"]), "'P' has no element 'x'");
    let untyped = PLAN.replace("var angle:    angle", "var angle = 3 deg");
    refused(&untyped, extract(&["turn"]), "'angle' needs a written type for the new plan");
}

const CALL: &str = "\
plan P {
    var gap: length
    const base = 1 m

    start align

    /// Aligns.
    subplan align: Align(limit = base + 1 m, gap => gap) {
        // well
        OK          -> go
        Interrupted -> align
        Error       -> terminate // badly
    }

    actor go: A(x = gap) { Done -> align }
}

plan Align {
    in  limit: length
    in  scale: int = 2
    out gap:   length
    var own:   length
    const base = 2 m
    start go

    // goes
    actor go: A(x = 3 * limit / scale, y => own) {
        supervise touch: T(far = base) { Touched -> terminate }
        Done -> back
    }

    actor back: B(x = own, y => gap) { Done -> terminate, Error -> go }
}
";

#[test]
fn a_sub_plan_becomes_its_elements() {
    let inlined = after(CALL, inline());
    let expected = "\
plan P {
    var gap: length
    const base = 1 m
    const base2 = 2 m
    var own: length

    start go2

    // Aligns.
    // well
    // badly
    // goes
    actor go2: A(x = 3 * (base + 1 m) / 2, y => own) {
        supervise touch: T(far = base2) { Touched -> go2 }
        Done  -> back
        Error -> terminate
    }

    actor back: B(x = own, y => gap) { Done -> go, Error -> go2 }

    actor go: A(x = gap) { Done -> go2 }
}
";
    assert_eq!(inlined, format!("{expected}{}", &CALL[CALL.find("\nplan Align").unwrap()..]));
}

#[test]
fn an_inlined_failure_has_the_target_of_the_sub_plans_fault() {
    let failing = CALL
        .replace(
            "Touched -> terminate }\n        Done -> back",
            "Touched -> go }\n        Done -> fail \"x\"",
        )
        .replace("Error       -> terminate // badly", "Error       -> go");
    let edge = "{ Touched -> go2 }\n        Done  -> go\n        Error -> go\n";
    let inlined = after(&failing, inline());
    assert!(inlined.contains(edge), "{inlined}");
    let uncaught = failing.replace("        Error       -> go\n", "");
    let edge = "{ Touched -> go2 }\n        Done -> fail \"x\"\n    }";
    let inlined = after(&uncaught, inline());
    assert!(inlined.contains(edge), "{inlined}");
    let event = CALL.replace("Touched -> terminate", "Touched -> fail");
    refused(
        &event,
        inline(),
        "an event of the sub-plan that fails would end the plan as Interrupted, which it now ends as OK",
    );
}

#[test]
fn an_extracted_failure_fails_the_new_plan() {
    let failing = PLAN.replace(ONE_WAY, "        Lost  -> fail \"lost\"\n");
    let extracted = after(&failing, extract(&["turn", "find"]));
    assert!(extracted.contains("{ OK -> follow, Interrupted -> back }"), "{extracted}");
    assert!(extracted.contains("Lost  -> fail \"lost\"\n"), "{extracted}");
}

#[test]
fn resuming_computations_stay_in_their_plan() {
    let asks = "    computation ask: C { Yes -> resume, No -> also }\n    \
                computation also: C { Yes -> ask, No -> back }\n    // a free note";
    let resuming = PLAN.replace("    // a free note", asks).replace(
        "{ Touched -> back } // careful",
        "{ Touched -> also, Lifted -> resume } // careful",
    );
    let inside = "'ask' resumes the active element, which is not possible from a separate plan";
    refused(&resuming, extract(&["turn", "ask"]), inside);
    let outside =
        "'also' resumes the selection's active element, which is not possible from outside";
    refused(&resuming, extract(&["turn"]), outside);
    let here = resuming.replace("Touched -> also", "Touched -> back");
    let here = here.replace(ONE_WAY, "        Lost  -> follow\n");
    let extracted = after(&here, extract(&["turn", "find"]));
    assert!(extracted.contains("{ Touched -> terminate, Lifted -> resume }"), "{extracted}");
}

#[test]
fn a_change_of_meaning_is_refused() {
    let change = |old: &str, new: &str, reason: &str| {
        assert!(CALL.contains(old), "{old}");
        refused(&CALL.replace(old, new), inline(), reason);
    };
    change("base + 1 m", "gap", "'limit' is computed from 'gap', which the sub-plan changes");
    change(
        "var own:   length",
        "var own: length = 1 m",
        "'own' begins with a value at every activation",
    );
    change(
        "    start go\n\n    // goes",
        "    start go\n    supervise all: S {}\n    // goes",
        "the supervisors of 'Align' watch it as a whole; move them to its elements first",
    );
    change(
        "scale: int = 2",
        "scale: int = 2.5",
        "the sub-plan converts its input 'scale'; give it the type 'int' first",
    );
    change("out gap:   length", "out gap: int", "'gap' and 'gap' differ in type");
    change("limit = base + 1 m, ", "", "'limit' is not bound");
    change("        Interrupted -> align\n", "", "'Interrupted' of the sub-plan is not connected");
    change(
        "Interrupted -> align",
        "Interrupted -> terminate",
        "an event of the sub-plan would end the plan as Interrupted, which it now ends as OK",
    );
    change("subplan align: Align", "actor align: Align", "'align' is not a sub-plan of a plan");
    let watched = format!("{CALL}\nscenario \"s\" for P {{ expect align -> go until 5 s }}\n");
    refused(&watched, inline(), "a scenario expects something after 'align' as a whole");
}

#[test]
fn ranges_are_kept() {
    let text = "\
plan P {
    const most = 1 m
    var way: length = 0 m from 0 m to most
    start go
    actor go: A(x = way, y => way) { Done -> terminate }
}
";
    let change = Change::Extract {
        plan: "P".into(),
        elements: vec!["go".into()],
        new_plan: "Inner".into(),
        element: "inner".into(),
    };
    let inner = after(text, change);
    assert!(inner.contains("length = wayBefore from 0 m to most\n"), "{inner}");
    assert!(inner.split_once("plan Inner").is_some_and(|(_, it)| it.contains("const most = 1 m")));
    let ranged = CALL.replace("var own:   length", "var own:   length from base to 3 m");
    let inlined = after(&ranged, inline());
    assert!(inlined.contains("    var own: length from base2 to 3 m\n"), "{inlined}");
    let narrow = CALL.replace("out gap:   length", "out gap: length from 0 m to 1 m");
    refused(&narrow, inline(), "'gap' and 'gap' differ in range");
    let checked = CALL.replace("in  limit: length", "in  limit: length from 0 m to 9 m");
    refused(&checked, inline(), "the sub-plan checks the range of its input 'limit'");
}

#[test]
fn constants_for_times_are_kept() {
    let text = "\
plan P {
    const quick = 5 ms
    start go
    actor go: A { supervise t: T every quick { Seen -> go }  Done -> terminate }
}
";
    let change = Change::Extract {
        plan: "P".into(),
        elements: vec!["go".into()],
        new_plan: "Inner".into(),
        element: "inner".into(),
    };
    let inner = after(text, change);
    let (_, plan) = inner.split_once("plan Inner {").expect("a second plan");
    assert!(plan.contains("const quick = 5 ms"), "{inner}");
    let renamed =
        inner.replace("plan P {\n    const quick = 5 ms", "plan P {\n    const quick = 6 ms");
    let back = after(&renamed, Change::Inline { plan: "P".into(), element: "inner".into() });
    assert!(
        back.contains("const quick_2 = 5 ms") || back.contains("const quick2 = 5 ms"),
        "{back}"
    );
    assert!(back.contains("every quick_2") || back.contains("every quick2"), "{back}");
}
