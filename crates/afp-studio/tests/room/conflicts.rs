//! Two programs that write one file.

use super::*;

#[test]
fn changes_of_different_lines_are_merged() {
    let mut place = Place::new(PLAN);
    place.client(1);
    place.types(1, 2, &PLAN.replace("Elapsed -> terminate", "Elapsed -> go"));
    place.outside(&format!("// theirs\n{PLAN}"));
    place.pass(600);
    let both = format!("// theirs\n{}", PLAN.replace("Elapsed -> terminate", "Elapsed -> go"));
    assert_eq!(place.on_disk(), both);
    // The client receives the change and merges it; its next text is saved.
    let out = place.types(1, 3, &both);
    assert_eq!(
        (methods(&out), &out[0].1["params"]["version"]),
        (vec![(1, "afp/saved")], &json!(3))
    );
}

#[test]
fn typing_during_a_change_of_another_program_loses_nothing() {
    let mut place = Place::new(PLAN);
    place.client(1);
    let typed = |letters: &str| PLAN.replace("start go", &format!("start go // {letters}"));
    place.types(1, 2, &typed("a"));
    place.outside(&format!("// theirs\n{PLAN}"));
    let out = place.pass(600);
    let told = out.iter().find(|(_, value)| value["method"] == "afp/changed").unwrap();
    let both = |letters: &str| format!("// theirs\n{}", typed(letters));
    assert_eq!(told.1["params"]["text"], both("a"));
    assert_eq!((&told.1["params"]["version"], &told.1["params"]["number"]), (&json!(2), &json!(1)));
    // Typed before the change arrived: the file stays unchanged, and no save is reported.
    assert_eq!(place.types(1, 3, &typed("ab")), []);
    assert_eq!(place.pass(600), []);
    assert_eq!(place.on_disk(), both("a"));
    // A second change refers to the same version.
    place.outside(&format!("{}// end\n", both("a")));
    let out = place.pass(600);
    let told = out.iter().find(|(_, value)| value["method"] == "afp/changed").unwrap();
    assert_eq!((&told.1["params"]["version"], &told.1["params"]["number"]), (&json!(2), &json!(2)));
    assert_eq!(place.takes(1, 4, &both("ab"), json!(1)), []);
    place.takes(1, 5, &format!("{}// end\n", both("ab")), json!(2));
    place.pass(300);
    assert_eq!(place.on_disk(), format!("{}// end\n", both("ab")));
    place.types(1, 6, &both("abc"));
    place.pass(300);
    assert_eq!(place.on_disk(), both("abc"));
}

#[test]
fn a_change_that_is_undone_on_its_path_is_undone() {
    let mut place = Place::new(PLAN);
    place.client(1);
    let theirs = format!("// theirs\n{PLAN}");
    for (text, number) in [(theirs.as_str(), 1), (PLAN, 2)] {
        place.outside(text);
        let out = place.pass(600);
        let told = out.iter().find(|(_, value)| value["method"] == "afp/changed").unwrap();
        assert_eq!(
            (&told.1["params"]["text"], &told.1["params"]["number"]),
            (&json!(text), &json!(number))
        );
    }
    place.takes(1, 2, &theirs, json!(1));
    place.takes(1, 3, PLAN, json!(2));
    place.pass(600);
    assert_eq!(place.on_disk(), PLAN);
}

#[test]
fn a_text_equal_to_its_file_is_saved_even_on_a_full_disk() {
    let mut place = Place::new(PLAN);
    place.client(1);
    place.types(1, 2, &PLAN.replace("go", "stay"));
    let out = place.types(1, 3, PLAN);
    assert_eq!(
        (methods(&out), &out[0].1["params"]["version"]),
        (vec![(1, "afp/saved")], &json!(3))
    );
    assert_eq!(place.pass(1000), [], "nothing is written");
}

#[test]
fn a_new_client_during_a_conflict_can_choose() {
    let mut place = Place::new(PLAN);
    place.client(1);
    place.types(1, 2, &PLAN.replace("terminate", "go"));
    let theirs = PLAN.replace("terminate", "other");
    place.outside(&theirs);
    place.pass(1000);
    place.room.join(2);
    place.ask(2, "initialize", json!({ "capabilities": {} })).unwrap();
    let document = json!({ "uri": place.uri("p.afp"), "languageId": "afp", "version": 1,
        "text": PLAN.replace("terminate", "go") });
    let out = place.tell(2, "textDocument/didOpen", json!({ "textDocument": document }));
    assert_eq!(methods(&out), [(2, "afp/changed")]);
    assert_eq!(
        (&out[0].1["params"]["clean"], &out[0].1["params"]["text"]),
        (&json!(false), &json!(theirs))
    );
}

#[test]
fn a_conflict_is_not_written_before_a_choice() {
    let mine = PLAN.replace("terminate", "go");
    let theirs = PLAN.replace("terminate", "other");
    for (keep, expected) in [("mine", Some(&mine)), ("theirs", Some(&theirs)), ("both", None)] {
        let mut place = Place::new(PLAN);
        place.client(1);
        place.types(1, 2, &mine);
        place.outside(&theirs);
        let out = place.pass(1000);
        let conflict = out.iter().find(|(_, value)| value["params"]["clean"] == false).unwrap();
        assert_eq!(conflict.1["params"]["text"], theirs);
        assert_eq!(place.on_disk(), theirs, "never over somebody else's change");
        let choice = json!({ "uri": place.uri("p.afp"), "keep": keep });
        place.ask(1, "afp/choose", choice).unwrap();
        place.pass(300);
        match expected {
            Some(text) => assert_eq!(&place.on_disk(), text),
            None => assert!(
                place.on_disk().contains("<<<<<<<") && place.on_disk().contains("-> other"),
                "{}",
                place.on_disk()
            ),
        }
    }
}

#[test]
fn a_conflict_that_is_undone_is_resolved() {
    let mine = PLAN.replace("terminate", "go");
    let merged = format!("// more\n{mine}");
    // The ways to resolve a conflict: with another change, by undoing, by writing the same text,
    // and with the file.
    let ways = [
        (Some(format!("// more\n{PLAN}")), &merged),
        (Some(PLAN.to_owned()), &mine),
        (Some(mine.clone()), &mine),
        (None, &mine),
    ];
    for (written, expected) in ways {
        let mut place = Place::new(PLAN);
        place.client(1);
        place.types(1, 2, &mine);
        place.outside(&PLAN.replace("terminate", "other"));
        let out = place.pass(1000);
        assert!(out.iter().any(|(_, value)| value["params"]["clean"] == false), "{out:?}");
        match &written {
            Some(text) => place.outside(text),
            None => fs::remove_file(place.path("p.afp")).unwrap(),
        }
        let out = place.pass(1500);
        let settled = out.iter().find(|(_, value)| value["params"]["clean"] == true);
        assert_eq!(settled.unwrap().1["params"]["text"], **expected, "{written:?}");
        assert_eq!(place.on_disk(), *expected, "{written:?}");
        // Later typing is saved again.
        let number = out.iter().filter_map(|(_, it)| it["params"]["number"].as_u64()).max();
        place.takes(1, 3, PLAN, json!(number));
        place.pass(1000);
        assert_eq!(place.on_disk(), PLAN, "{written:?}");
    }
}

#[test]
fn an_unreadable_file_is_not_overwritten() {
    let mut place = Place::new(PLAN);
    place.client(1);
    let mine = PLAN.replace("terminate", "go");
    place.types(1, 2, &mine);
    fs::write(place.path("p.afp"), [0xff, 0xfe, b'a']).unwrap();
    let out = place.pass(1500);
    let failed: Vec<_> = out.iter().filter(|(_, it)| it["params"]["failed"].is_string()).collect();
    assert_eq!(failed.len(), 1, "said once: {out:?}");
    place.room.save_all(place.now);
    assert_eq!(fs::read(place.path("p.afp")).unwrap(), [0xff, 0xfe, b'a']);
    place.outside(PLAN);
    place.pass(1500);
    assert_eq!(place.on_disk(), mine);
}
