//! Adding, removing, renaming, reordering and moving items.

use super::{Change, Item, PLAN, after, back, go, refused, replaces, touch};

fn add(text: &str, owner: Option<&str>, before: Option<&str>) -> Change {
    Change::Add {
        plan: "P".into(),
        owner: owner.map(str::to_owned),
        text: text.into(),
        before: before.map(str::to_owned),
    }
}

fn remove(item: Item) -> Change {
    Change::Remove { item }
}

fn rename(item: Item, to: &str) -> Change {
    Change::Rename { item, to: to.into() }
}

#[test]
fn items_are_added_after_their_kind() {
    replaces(
        add("var n:int=1", None, None),
        &[("length\n\n    start", "length\n    var n: int = 1\n\n    start")],
    );
    replaces(
        add("actor c:C{Done->go}", None, None),
        &[("terminate }\n}", "terminate }\n\n    actor c: C { Done -> go }\n}")],
    );
    replaces(
        add("actor c: C {\nDone->go }", None, Some("back")),
        &[("    /// Goes", "    actor c: C {\n        Done -> go\n    }\n\n    /// Goes")],
    );
    replaces(
        add("supervise all: T { Pressed -> go }", None, None),
        &[("beginning\n", "beginning\n\n    supervise all: T { Pressed -> go }\n")],
    );
    replaces(
        add("supervise two: T { Pressed -> go }", Some("go"), None),
        &[("back }\n", "back }\n        supervise two: T { Pressed -> go }\n")],
    );
    replaces(
        add("supervise two: T { Pressed -> go }", Some("back"), None),
        &[(
            ") { Done -> go, Lost -> terminate }",
            ") {\n        supervise two: T { Pressed -> go }\n        Done -> go, Lost -> terminate }",
        )],
    );
}

#[test]
fn items_are_added_to_empty_plans_and_files() {
    let plan = after("", Change::AddPlan { text: "plan P{}".into() });
    assert_eq!(plan, "plan P {}\n");
    let plan = after(&plan, add("actor a: A {}", None, None));
    assert_eq!(plan, "plan P {\n    actor a: A {}\n}\n");
    let plan = after(&plan, Change::AddUse { toolbox: "std".into(), alias: None });
    assert_eq!(plan, "use std\n\nplan P {\n    actor a: A {}\n}\n");
    let with_alias = Change::AddUse { toolbox: "carbot".into(), alias: Some("c".into()) };
    let plan = after(&plan, with_alias.clone());
    assert_eq!(plan, "use std\nuse carbot as c\n\nplan P {\n    actor a: A {}\n}\n");
    assert_eq!(after(&plan, with_alias), plan);
    let file = Change::AddUse { toolbox: r#""parts/explore.afp""#.into(), alias: None };
    let used = after(&plan, file.clone());
    assert_eq!(
        used,
        "use std\nuse carbot as c\nuse \"parts/explore.afp\"\n\nplan P {\n    actor a: A {}\n}\n"
    );
    assert_eq!(after(&used, file), used);
    let start = Change::SetStart { plan: "P".into(), to: "a".into() };
    let plan = after(&plan, start);
    let edge = Change::Connect {
        from: Item::inner("P", "a"),
        outcome: "Done".into(),
        to: "terminate".into(),
    };
    let plan = after(&plan, edge);
    let entry = add("in x: int", None, None);
    let plan = afp_format::format(&after(&plan, entry)).unwrap();
    let expected = "\
use std
use carbot as c

plan P {
    in x: int

    start a

    actor a: A {
        Done -> terminate
    }
}
";
    assert_eq!(plan, expected);
}

#[test]
fn invalid_items_are_refused() {
    let used = |path: &str, alias: Option<&str>| Change::AddUse {
        toolbox: path.into(),
        alias: alias.map(str::to_owned),
    };
    refused(
        PLAN,
        used(r#""a.toml""#, None),
        r#""a.toml" is not a plan file: use a file that ends in '.afp'"#,
    );
    refused(PLAN, used(r#""a.afp""#, Some("a")), r#""a.afp" is a file, which has no short name"#);
    refused(PLAN, used(r#""a" "b.afp""#, None), r#"'"a" "b.afp"' cannot be a name"#);
    refused(PLAN, add("actor go: A {}", None, None), "'go' already exists");
    refused(PLAN, add("actor GO: A {}", None, None), "'GO' and 'go' differ only in case or '_'");
    refused(
        PLAN,
        add("actor ignore: A {}", None, None),
        "'ignore' cannot be the name of an element",
    );
    refused(PLAN, add("var x: int var x: int", None, None), "'x' is given twice");
    refused(PLAN, add("start go", None, None), "'start go' cannot be put here");
    refused(PLAN, add("} plan Q {", None, None), "the text has more than the items of one list");
    refused(PLAN, add("", None, None), "the text has no item");
    refused(PLAN, add("var x: int", None, Some("y")), "there is no 'y' to insert before");
    refused(
        "plan P { computation c: C {} }",
        add("supervise s: S {}", Some("c"), None),
        "'c' is a computation, which has no supervisors",
    );
}

#[test]
fn items_go_with_their_comments_and_their_edges() {
    replaces(
        remove(back()),
        &[
            (
                "\n    /// Goes back.\n    actor back: B(\n        // why\n        distance = -limit, // because\n        speed = 3 cm/s,\n    ) { Done -> go, Lost -> terminate }\n",
                "",
            ),
            ("{ Pressed -> back }", "{}"),
        ],
    );
    replaces(
        remove(go()),
        &[
            ("    start go // at the beginning\n\n", ""),
            (
                "    // belongs to 'go'\n    actor go: A(distance = limit, gap => gap) {\n        supervise touch: T every 1 ms { Pressed -> back }\n        Done  -> go // again\n        // the way out\n        Error -> terminate\n    }\n\n",
                "",
            ),
            ("{ Done -> go, Lost", "{ Lost"),
        ],
    );
    replaces(
        remove(touch()),
        &[("        supervise touch: T every 1 ms { Pressed -> back }\n", "")],
    );
    replaces(
        remove(Item::inner("P", "gap")),
        &[("    var gap:   length\n", ""), (", gap => gap)", ")")],
    );
    refused(PLAN, remove(Item::inner("P", "limit")), "'limit' is read by 'go'");
    refused(PLAN, remove(Item::inner("P", "none")), "'P' has no 'none'");
}

const NESTED: &str = "\
use mine

plan Main {
    var gap: length = Gap + 1 m
    const Gap = 2 m
    start a
    subplan a: Sub(limit = Gap, found => gap) { OK -> a }
    actor Sub: Sub { OK -> a }
}

plan Sub {
    in  limit: length
    out found: length = limit
    start go
    actor go: A(limit = limit, found => found) {
        supervise touch: T(limit = 2 * (limit + 1 m)) { limit -> go }
        found -> go
    }
}

scenario \"s\" for Main {
    set gap = 3 m
    at 1 s: press a
    at 2 s: fire a.go.touch.limit
    at 3 s: set a.limit = gap
    expect a.go -> terminate by a.go.touch
    expect a.found == gap + 2 m always
    never a
}
";

#[test]
fn every_reference_takes_the_new_name() {
    let expect = |item: Item, to: &str, pairs: &[(&str, &str)]| {
        let expected = pairs.iter().fold(NESTED.to_owned(), |text, (old, new)| {
            assert!(text.contains(old), "{old}");
            text.replace(old, new)
        });
        assert_eq!(after(NESTED, rename(item, to)), expected);
    };
    expect(
        Item::inner("Sub", "limit"),
        "reach",
        &[
            ("in  limit", "in  reach"),
            ("length = limit", "length = reach"),
            ("= limit, found", "= reach, found"),
            ("limit + 1 m", "reach + 1 m"),
            ("Sub(limit", "Sub(reach"),
            ("a.limit", "a.reach"),
        ],
    );
    expect(
        Item::inner("Main", "a"),
        "b",
        &[
            ("start a", "start b"),
            ("subplan a", "subplan b"),
            ("OK -> a", "OK -> b"),
            ("fire a.", "fire b."),
            ("set a.", "set b."),
            ("expect a.", "expect b."),
            ("by a.", "by b."),
            ("never a", "never b"),
        ],
    );
    expect(
        Item::inner("Sub", "go"),
        "drive",
        &[
            ("start go", "start drive"),
            ("actor go", "actor drive"),
            ("-> go", "-> drive"),
            ("a.go", "a.drive"),
        ],
    );
    expect(Item::local("Sub", "go", "touch"), "bump", &[("touch", "bump")]);
    expect(
        Item::plan("Sub"),
        "Inner",
        &[("subplan a: Sub", "subplan a: Inner"), ("plan Sub {", "plan Inner {")],
    );
    expect(
        Item::inner("Main", "gap"),
        "room",
        &[
            ("var gap", "var room"),
            ("=> gap", "=> room"),
            ("set gap", "set room"),
            ("= gap", "= room"),
        ],
    );
}

#[test]
fn conflicting_names_are_refused() {
    refused(PLAN, rename(go(), "back"), "'back' already exists");
    refused(PLAN, rename(go(), "Back"), "'Back' and 'back' differ only in case or '_'");
    refused(PLAN, rename(go(), "terminate"), "'terminate' cannot be the name of an element");
    refused(PLAN, rename(go(), "1a"), "'1a' cannot be a name");
    refused(PLAN, rename(go(), "a b"), "'a b' cannot be a name");
    refused(PLAN, rename(go(), "Self"), "'Self' cannot be a name");
    replaces(rename(touch(), "go"), &[("touch", "go")]);
    replaces(rename(back(), "Back"), &[("-> back }", "-> Back }"), ("actor back", "actor Back")]);
    replaces(rename(back(), "back"), &[]);
}

fn reorder(item: Item, before: Option<&str>) -> Change {
    Change::Reorder { item, before: before.map(str::to_owned) }
}

#[test]
fn items_change_places_with_their_comments() {
    let turned = after(PLAN, reorder(back(), Some("go")));
    assert!(
        turned.contains("\n\n    // a free note\n\n    /// Goes back.\n    actor back: B("),
        "{turned}"
    );
    assert!(turned.ends_with("    // belongs to 'go'\n    actor go: A(distance = limit, gap => gap) {\n        supervise touch: T every 1 ms { Pressed -> back }\n        Done  -> go // again\n        // the way out\n        Error -> terminate\n    }\n}\n"), "{turned}");
    assert_eq!(after(&turned, reorder(back(), None)), PLAN);
    replaces(reorder(go(), Some("back")), &[]);
    replaces(reorder(back(), None), &[]);
    replaces(
        reorder(Item::inner("P", "gap"), Some("limit")),
        &[(
            "    in  limit: length = 30 cm // how far\n    var gap:   length\n",
            "    var gap:   length\n    in  limit: length = 30 cm // how far\n",
        )],
    );
    let plans = "plan A {}\n\n// b\nplan B {}\n";
    assert_eq!(after(plans, reorder(Item::plan("B"), Some("A"))), "// b\nplan B {}\n\nplan A {}\n");
    refused(PLAN, reorder(go(), Some("x")), "there is no 'x' to insert before");
}

fn shift(item: Item, plan: &str, owner: Option<&str>) -> Change {
    Change::Move { item, plan: plan.into(), owner: owner.map(str::to_owned) }
}

#[test]
fn items_move_between_plans_and_owners() {
    let two = format!(
        "{PLAN}\nplan Q {{\n    in limit: length\n    start b\n\n    actor b: B {{ Done -> b }}\n}}\n"
    );
    let moved = after(&two, shift(back(), "Q", None));
    assert!(moved.contains("supervise touch: T every 1 ms {}"), "{moved}");
    assert!(moved.ends_with("    actor b: B { Done -> b }\n\n    /// Goes back.\n    actor back: B(\n        // why\n        distance = -limit, // because\n        speed = 3 cm/s,\n    ) { Lost -> terminate }\n}\n"), "{moved}");
    refused(&two, shift(go(), "Q", None), "'Q' has no entry 'gap'");
    let timed = two.replace("every 1 ms", "every limit").replace("in limit: length\n", "");
    refused(&timed, shift(touch(), "Q", Some("b")), "'Q' has no entry 'limit'");
    refused(&two, shift(Item::inner("P", "gap"), "Q", None), "'gap' is used at its present place");
    refused(&two, shift(back(), "P", None), "'back' is already in this place");
    refused(&two, shift(back(), "Q", Some("b")), "'back' is not a supervisor");
    replaces(
        shift(touch(), "P", None),
        &[
            ("        supervise touch: T every 1 ms { Pressed -> back }\n", ""),
            ("beginning\n", "beginning\n\n    supervise touch: T every 1 ms { Pressed -> back }\n"),
        ],
    );
}
