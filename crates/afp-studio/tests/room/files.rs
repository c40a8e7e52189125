//! Creating, renaming and removing files, with concurrent changes by others.

use std::fs;

use serde_json::{Value, json};

use super::{PLAN, Place};

#[test]
fn files_are_created_renamed_and_removed_only_in_the_folder() {
    let mut place = Place::new(PLAN);
    place.client(1);
    let new = place.uri("n.afp");
    let made = place.ask(1, "afp/create", json!({ "uri": new, "example": "first.afp" })).unwrap();
    assert!(made["text"].as_str().unwrap().starts_with("/// Wait."));
    let again = place.ask(1, "afp/create", json!({ "uri": new })).unwrap_err();
    assert_eq!(again, "the file 'n.afp' already exists");
    for wrong in ["../n.afp", "n.sh"] {
        let uri = format!("{}/{wrong}", place.uri(""));
        assert!(place.ask(1, "afp/create", json!({ "uri": uri })).is_err(), "{wrong}");
    }
    let over = json!({ "uri": new, "to": place.uri("p.afp") });
    assert!(place.ask(1, "afp/rename", over).unwrap_err().contains("already"));
    let to = place.uri("m.afp");
    place.ask(1, "afp/rename", json!({ "uri": new, "to": to })).unwrap();
    let gone = place.ask(1, "afp/remove", json!({ "uri": to })).unwrap();
    assert!(gone["text"].as_str().unwrap().contains("plan P"));
    let hello = place.ask(1, "afp/hello", json!({})).unwrap();
    assert_eq!(hello["files"].as_array().unwrap().len(), 1);
    assert_eq!(hello["examples"][0]["title"], "Wait.");
    // A new client sees the current folder, not the last scan.
    fs::write(place.path("q.afp"), PLAN).unwrap();
    let hello = place.ask(1, "afp/hello", json!({})).unwrap();
    assert_eq!(hello["files"].as_array().unwrap().len(), 2);
}

#[test]
fn a_moved_file_keeps_recent_changes_of_others() {
    let mut place = Place::new(PLAN);
    place.client(1);
    let (here, there) = (place.uri("p.afp"), place.uri("q.afp"));
    let theirs = PLAN.replace("Elapsed -> terminate", "Elapsed -> terminate // theirs");
    place.outside(&theirs);
    let gone = place.ask(1, "afp/remove", json!({ "uri": here })).unwrap();
    assert_eq!(gone["text"], json!(theirs));
    // An open address without its file gets a new text.
    fs::write(place.path("q.afp"), format!("// q\n{PLAN}")).unwrap();
    place.ask(1, "afp/read", json!({ "uri": there })).unwrap();
    fs::remove_file(place.path("q.afp")).unwrap();
    place.outside(PLAN);
    place.ask(1, "afp/read", json!({ "uri": here })).unwrap();
    place.outside(&theirs);
    let renamed = place.ask(1, "afp/rename", json!({ "uri": here, "to": there })).unwrap();
    assert_eq!(renamed["text"], json!(theirs));
    // A user has to resolve a conflict.
    let mut place = Place::new(PLAN);
    place.client(1);
    let here = place.uri("p.afp");
    place.types(1, 2, &PLAN.replace("start go", "start mine"));
    place.outside(&PLAN.replace("start go", "start theirs"));
    let refused = place.ask(1, "afp/remove", json!({ "uri": here })).unwrap_err();
    assert!(refused.contains("choose"), "{refused}");
    assert!(place.path("p.afp").exists());
}

#[test]
fn a_folder_opens_with_the_first_file_that_has_a_plan() {
    let mut place = Place::new("toolbox p {\n}\n");
    fs::create_dir(place.path("plans")).unwrap();
    fs::write(place.path("plans/a.afp"), "use std\n").unwrap();
    fs::write(place.path("plans/b.afp"), "plan P {\n    start\n").unwrap();
    place.room.join(1);
    let hello = |place: &mut Place| place.ask(1, "afp/hello", json!({})).unwrap()["open"].clone();
    assert_eq!(hello(&mut place), json!(place.uri("plans/b.afp")));
    fs::remove_file(place.path("plans/b.afp")).unwrap();
    assert_eq!(hello(&mut place), Value::Null);
}

/// An open text is checked every half second; others are read on demand.
#[test]
fn closed_texts_are_forgotten_after_their_save() {
    let later = format!("// later\n{PLAN}");
    let is_forgotten = |place: &mut Place| {
        place.outside(&later);
        place.room.join(9);
        let read = place.ask(9, "afp/read", json!({ "uri": place.uri("p.afp") })).unwrap();
        read["text"] == json!(later)
    };
    let mut place = Place::new(PLAN);
    place.client(1);
    place.room.leave(1, place.now);
    assert!(is_forgotten(&mut place));
    // Another client still has it open.
    let mut place = Place::new(PLAN);
    place.client(1);
    place.client(2);
    let document = json!({ "uri": place.uri("p.afp") });
    place.tell(1, "textDocument/didClose", json!({ "textDocument": document }));
    assert!(!is_forgotten(&mut place));
    // First unsaved, then saved.
    for (passes, saved) in [(0, false), (300, true)] {
        let mut place = Place::new(PLAN);
        place.client(1);
        place.types(1, 2, &PLAN.replace("go", "stay"));
        place.room.leave(1, place.now);
        place.pass(passes);
        assert_eq!(place.on_disk() != PLAN, saved);
        assert_eq!(is_forgotten(&mut place), saved);
    }
    // Another program has removed the file: only the room has its text.
    let mut place = Place::new(PLAN);
    place.client(1);
    fs::remove_file(place.path("p.afp")).unwrap();
    place.pass(600);
    place.room.leave(1, place.now);
    place.room.join(2);
    let read = place.ask(2, "afp/read", json!({ "uri": place.uri("p.afp") })).unwrap();
    assert_eq!(read["text"], json!(PLAN));
}

#[test]
fn an_open_text_without_a_file_gets_the_new_text() {
    for text in ["plan New { }\n", PLAN] {
        let mut place = Place::new(PLAN);
        place.client(1);
        place.client(2);
        fs::remove_file(place.path("p.afp")).unwrap();
        place.pass(600);
        let what = json!({ "uri": place.uri("p.afp"), "text": text });
        let request = json!({ "id": 1, "method": "afp/create", "params": what });
        let request = serde_json::from_value(request).unwrap();
        let out = super::said(place.room.handle(1, request, place.now));
        let out: Vec<_> =
            out.into_iter().filter(|(_, said)| said["params"]["uri"] == what["uri"]).collect();
        let method = if text == PLAN { "afp/saved" } else { "afp/changed" };
        assert_eq!(super::methods(&out), [(1, method), (2, method)]);
        assert!(out.iter().all(|(_, said)| text == PLAN || said["params"]["text"] == text));
        assert!(out.iter().all(|(_, said)| said["params"]["failed"].is_null()));
    }
    // A file about to be saved cannot be created.
    let mut place = Place::new(PLAN);
    place.client(1);
    fs::remove_file(place.path("p.afp")).unwrap();
    place.pass(600);
    let mine = PLAN.replace("go", "stay");
    place.types(1, 2, &mine);
    let what = json!({ "uri": place.uri("p.afp"), "text": "" });
    let refused = place.ask(1, "afp/create", what).unwrap_err();
    assert!(refused.contains("about to be saved"), "{refused}");
    place.pass(300);
    assert_eq!(place.on_disk(), mine);
}

/// An undone first edit once left an empty file of positions.
#[test]
fn positions_without_a_line_have_no_file() {
    let mut place = Place::new(PLAN);
    place.client(1);
    let (uri, path) = (place.uri("p.afp.layout"), place.path("p.afp.layout"));
    place.ask(1, "afp/read", json!({ "uri": uri })).unwrap();
    let document = json!({ "uri": uri, "languageId": "afp", "version": 1, "text": "" });
    place.tell(1, "textDocument/didOpen", json!({ "textDocument": document }));
    let types = |place: &mut Place, version: i32, text: &str| {
        let document = json!({ "uri": uri, "version": version });
        let said = json!({ "textDocument": document, "contentChanges": [{ "text": text }] });
        place.tell(1, "textDocument/didChange", said);
        place.pass(600)
    };
    types(&mut place, 2, "P.go 0 96\n");
    assert_eq!(fs::read_to_string(&path).unwrap(), "P.go 0 96\n");
    let told = types(&mut place, 3, "");
    assert!(!path.exists());
    assert!(
        told.iter()
            .any(|(_, said)| said["method"] == "afp/saved" && said["params"]["version"] == 3)
    );
    types(&mut place, 4, "P.go 0 96\n");
    assert_eq!(fs::read_to_string(&path).unwrap(), "P.go 0 96\n");
}
