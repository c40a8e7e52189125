//! Ports, templates, times, entries, help text.

use super::{Binding, Change, Item, PLAN, after, back, go, refused, replaces, touch};

fn bind(component: Item, port: &str, formula: &str) -> Change {
    Change::Bind { component, port: port.into(), to: Binding::In(formula.into()) }
}

fn bind_out(component: Item, port: &str, entry: &str) -> Change {
    Change::Bind { component, port: port.into(), to: Binding::Out(entry.into()) }
}

fn unbind(component: Item, port: &str) -> Change {
    Change::Unbind { component, port: port.into() }
}

#[test]
fn a_port_gets_another_formula() {
    replaces(bind(go(), "distance", "2 * limit"), &[("= limit, gap", "= 2 * limit, gap")]);
    replaces(bind(back(), "distance", "limit"), &[("-limit", "limit")]);
    replaces(bind(back(), "distance", "-limit"), &[]);
    replaces(bind(go(), "gap", "1 cm"), &[("gap => gap", "gap = 1 cm")]);
    replaces(bind_out(back(), "speed", "gap"), &[("speed = 3 cm/s", "speed => gap")]);
}

#[test]
fn a_new_binding_has_the_style_of_its_neighbours() {
    replaces(bind(go(), "speed", "1 cm/s"), &[("gap => gap)", "gap => gap, speed = 1 cm/s)")]);
    replaces(
        bind_out(back(), "driven", "gap"),
        &[("3 cm/s,\n", "3 cm/s,\n        driven => gap,\n")],
    );
    replaces(
        bind(touch(), "margin", "1 cm"),
        &[("touch: T every", "touch: T(margin = 1 cm) every")],
    );
}

#[test]
fn a_binding_goes_with_its_comments() {
    replaces(unbind(go(), "distance"), &[("distance = limit, gap", "gap")]);
    replaces(unbind(go(), "gap"), &[(", gap => gap)", ")")]);
    replaces(
        unbind(back(), "distance"),
        &[("        // why\n        distance = -limit, // because\n", "")],
    );
    let bound = after(PLAN, bind(touch(), "margin", "1 cm"));
    assert_eq!(after(&bound, unbind(touch(), "margin")), PLAN);
}

#[test]
fn a_fragment_is_one_formula() {
    for text in ["", "1 +", "1, b = 2", "1 } }", "1 // c", "1 cm 2", ") + (", "a b"] {
        let reason = format!("'{text}' is not a formula");
        refused(PLAN, bind(go(), "distance", text), &reason);
    }
    refused(PLAN, bind_out(go(), "gap", "nowhere"), "there is no entry 'nowhere' in the plan");
    refused(PLAN, unbind(go(), "speed"), "'speed' of 'go' is not bound");
    let commented = PLAN.replace("-limit,", "-  // c\n limit,");
    refused(&commented, bind(back(), "distance", "1 m"), "the formula contains a comment");
}

#[test]
fn templates_and_times_are_set() {
    let template =
        |template: &str| Change::SetTemplate { component: back(), template: template.into() };
    replaces(template("c.Forward"), &[("back: B(", "back: c.Forward(")]);
    refused(
        PLAN,
        template("c.F {} actor x: Y"),
        "'c.F {} actor x: Y' is not the name of a template",
    );
    let timing = |keyword: &str, value: Option<&str>| Change::SetTiming {
        supervisor: touch(),
        keyword: keyword.into(),
        value: value.map(str::to_owned),
    };
    replaces(timing("every", Some("2 ms")), &[("every 1 ms", "every 2 ms")]);
    replaces(timing("every", None), &[("T every 1 ms {", "T {")]);
    replaces(timing("deadline", Some("1 ms")), &[("1 ms {", "1 ms deadline 1 ms {")]);
    replaces(timing("deadline", None), &[]);
    let deadline = after(&after(PLAN, timing("every", None)), timing("deadline", Some("1 ms")));
    assert!(
        after(&deadline, timing("every", Some("5 ms"))).contains("T every 5 ms deadline 1 ms {")
    );
    replaces(timing("every", Some("pace")), &[("every 1 ms", "every pace")]);
    refused(PLAN, timing("every", Some("gap + 1")), "'gap + 1' is not a time");
    refused(PLAN, timing("budget", None), "a supervisor has no 'budget'");
}

#[test]
fn entries_change_part_by_part() {
    let limit = || Item::inner("P", "limit");
    let ty = |ty: Option<&str>| Change::SetEntryType { entry: limit(), ty: ty.map(str::to_owned) };
    let value = |value: Option<&str>| Change::SetEntryValue {
        entry: limit(),
        value: value.map(str::to_owned),
    };
    let kind = |name: &str, keyword: &str| Change::SetEntryKind {
        entry: Item::inner("P", name),
        keyword: keyword.into(),
    };
    replaces(ty(Some("length^2/mass")), &[("limit: length =", "limit: length^2/mass =")]);
    replaces(ty(None), &[("limit: length =", "limit =")]);
    replaces(value(Some("1 m + 2 cm")), &[("30 cm", "1 m + 2 cm")]);
    replaces(value(None), &[(" = 30 cm // how", " // how")]);
    let bare = after(&after(PLAN, value(None)), ty(None));
    assert!(bare.contains("in  limit // how far\n"), "{bare}");
    assert!(
        after(&after(&bare, value(Some("1"))), ty(Some("int"))).contains("limit: int = 1 // how")
    );
    replaces(kind("limit", "out"), &[("in  limit", "out limit")]);
    replaces(kind("limit", "const"), &[("in  limit", "const limit")]);
    let live = PLAN.replace("in  limit", "in live limit");
    assert_eq!(after(&live, kind("limit", "var")), PLAN.replace("in  limit", "var limit"));
    assert_eq!(after(&live, kind("limit", "in")), live);
    replaces(kind("gap", "in"), &[("var gap", "in gap")]);
    refused(PLAN, kind("gap", "let"), "an entry is 'in', 'out', 'var' or 'const', not 'let'");
    refused(PLAN, kind("go", "in"), "'go' is not an entry");
    refused(PLAN, ty(Some("length = 3")), "'length = 3' is not a type");
}

#[test]
fn an_entry_is_added_from_its_parts() {
    let add = |keyword: &str, name: &str, ty: Option<&str>, value: Option<&str>| Change::AddEntry {
        plan: "P".into(),
        keyword: keyword.into(),
        name: name.into(),
        ty: ty.map(str::to_owned),
        value: value.map(str::to_owned),
    };
    for (ty, value, wanted) in [
        (Some("int"), Some("3"), "    var turns: int = 3\n"),
        (Some("int"), None, "    var turns: int\n"),
        (None, Some("1 m + gap"), "    var turns = 1 m + gap\n"),
    ] {
        let text = after(PLAN, add("var", "turns", ty, value));
        assert!(text.contains(wanted.trim_end()), "{text}");
    }
    refused(PLAN, add("var", "x", None, None), "the entry 'x' needs a type or a value");
    refused(PLAN, add("var", "x", Some("int = 3"), None), "'int = 3' is not a type");
    refused(
        PLAN,
        add("let", "x", Some("int"), None),
        "an entry is 'in', 'out', 'var' or 'const', not 'let'",
    );
}

#[test]
fn a_component_is_added_from_its_parts() {
    let add =
        |owner: Option<&str>, keyword: &str, name: &str, template: &str| Change::AddComponent {
            plan: "P".into(),
            owner: owner.map(str::to_owned),
            keyword: keyword.into(),
            name: name.into(),
            template: template.into(),
        };
    let text = after(PLAN, add(None, "actor", "on", "home.Drive"));
    assert!(text.contains("    actor on: home.Drive {}\n"), "{text}");
    let text = after(PLAN, add(Some("back"), "supervise", "late", "Late"));
    assert!(text.contains("supervise late: Late {}\n"), "{text}");
    refused(PLAN, add(None, "plan", "on", "Drive"), "there is no kind of component 'plan'");
    refused(PLAN, add(None, "actor", "on", "A {} }"), "'A {} }' is not the name of a template");
}

#[test]
fn an_entry_keeps_its_range() {
    let text = PLAN.replace("length = 30 cm", "length = 30 cm from 0 m to 1 m");
    let value = |value: Option<&str>| Change::SetEntryValue {
        entry: Item::inner("P", "limit"),
        value: value.map(str::to_owned),
    };
    let without = after(&text, value(None));
    assert!(without.contains("limit: length from 0 m to 1 m // how"), "{without}");
    assert_eq!(after(&without, value(Some("30 cm"))), text);
    let other = after(&text, value(Some("5 cm")));
    assert!(other.contains("limit: length = 5 cm from 0 m to 1 m // how"), "{other}");
}

#[test]
fn help_text_is_set() {
    let doc = |item: Item, text: &str| Change::SetDoc { item, text: text.into() };
    replaces(
        doc(go(), "Drives.\n\nFar."),
        &[("    actor go", "    /// Drives.\n    ///\n    /// Far.\n    actor go")],
    );
    replaces(doc(back(), "Returns."), &[("Goes back.", "Returns.")]);
    replaces(doc(back(), ""), &[("    /// Goes back.\n", "")]);
    replaces(doc(back(), "Goes back."), &[]);
    replaces(doc(Item::plan("P"), "Help."), &[("plan P {", "/// Help.\nplan P {")]);
}

#[test]
fn notes_are_set() {
    let note = |item: Item, text: &str| Change::SetNote { item, text: text.into() };
    replaces(
        note(go(), "far\nand away"),
        &[("    // belongs to 'go'\n", "    // far\n    // and away\n")],
    );
    replaces(note(go(), ""), &[("    // belongs to 'go'\n", "")]);
    replaces(note(go(), "belongs to 'go'"), &[]);
    replaces(
        note(back(), "as it came"),
        &[("    /// Goes back.\n", "    // as it came\n    /// Goes back.\n")],
    );
    replaces(note(Item::inner("P", "gap"), "free"), &[("    var gap", "    // free\n    var gap")]);
    replaces(
        note(touch(), "it"),
        &[("{\n        supervise", "{\n        // it\n        supervise")],
    );
}
