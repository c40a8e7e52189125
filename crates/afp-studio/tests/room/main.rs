//! A room with clients, with a test folder and a test clock.

mod conflicts;
mod files;

use std::fs;
use std::path::PathBuf;
use std::time::Duration;

use afp_lsp::{Host, Message};
use afp_studio::{ClientId, Example, Folder, Room};
use serde_json::{Value, json};

const PLAN: &str =
    "use std\n\nplan P {\n    start go\n    actor go: Wait { Elapsed -> terminate }\n}\n";

/// The real file system.
struct Disk;

impl Host for Disk {
    fn read(&self, path: &str) -> Result<String, String> {
        fs::read_to_string(path).map_err(|why| why.to_string())
    }

    fn plan_files(&self, _: &str) -> Vec<String> {
        Vec::new()
    }

    fn built_in(&self, _: &str, _: &str) -> Option<String> {
        None
    }
}

/// A folder with a plan, its room, and the room's time.
struct Place {
    folder: tempfile::TempDir,
    room: Room,
    now: Duration,
    asked: i32,
}

impl Place {
    fn new(text: &str) -> Place {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("p.afp"), text).unwrap();
        let (name, plan) = ("first.afp".to_owned(), format!("/// Wait.\n{PLAN}"));
        let examples = vec![Example { name, plan, ..Example::default() }];
        let room =
            Room::new(Folder::new(folder.path()).unwrap(), None, examples, || Box::new(Disk));
        Place { folder, room, now: Duration::ZERO, asked: 0 }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().canonicalize().unwrap().join(name)
    }

    fn uri(&self, name: &str) -> String {
        afp_lsp::uri_of(self.path(name).to_str().unwrap())
    }

    fn on_disk(&self) -> String {
        fs::read_to_string(self.path("p.afp")).unwrap()
    }

    fn ask(&mut self, client: ClientId, method: &str, params: Value) -> Result<Value, String> {
        self.asked += 1;
        let message = json!({ "id": self.asked, "method": method, "params": params });
        let out = self.room.handle(client, serde_json::from_value(message).unwrap(), self.now);
        let answer = out.iter().find_map(|(id, message)| match message {
            Message::Response(response) if *id == client => Some(response.clone()),
            _ => None,
        });
        let value = serde_json::to_value(answer.unwrap()).unwrap();
        match value["error"]["message"].as_str() {
            Some(why) => Err(why.to_owned()),
            None => Ok(value["result"].clone()),
        }
    }

    fn tell(&mut self, client: ClientId, method: &str, params: Value) -> Vec<(ClientId, Value)> {
        let message = json!({ "method": method, "params": params });
        said(self.room.handle(client, serde_json::from_value(message).unwrap(), self.now))
    }

    /// Adds a client that has the plan open.
    fn client(&mut self, client: ClientId) {
        self.room.join(client);
        self.ask(client, "initialize", json!({ "capabilities": {} })).unwrap();
        let read = self.ask(client, "afp/read", json!({ "uri": self.uri("p.afp") })).unwrap();
        let document =
            json!({ "uri": read["uri"], "languageId": "afp", "version": 1, "text": read["text"] });
        let told = self.tell(client, "textDocument/didOpen", json!({ "textDocument": document }));
        assert_eq!(told, []);
    }

    /// A client replaces the plan's text.
    fn types(&mut self, client: ClientId, version: i32, text: &str) -> Vec<(ClientId, Value)> {
        self.takes(client, version, text, Value::Null)
    }

    /// A client replaces the plan's text, and includes the change with that number.
    fn takes(
        &mut self,
        client: ClientId,
        version: i32,
        text: &str,
        number: Value,
    ) -> Vec<(ClientId, Value)> {
        let document = json!({ "uri": self.uri("p.afp"), "version": version });
        let changes = json!([{ "text": text }]);
        let said = json!({ "textDocument": document, "contentChanges": changes, "taken": number });
        self.tell(client, "textDocument/didChange", said)
    }

    /// Lets time pass.
    fn pass(&mut self, milliseconds: u64) -> Vec<(ClientId, Value)> {
        let end = self.now + Duration::from_millis(milliseconds);
        let mut out = Vec::new();
        while self.now < end {
            self.now += Duration::from_millis(10);
            out.extend(said(self.room.tick(self.now)));
        }
        out
    }

    /// Another program writes the plan; file times can be coarse, so the length differs, too.
    fn outside(&self, text: &str) {
        fs::write(self.path("p.afp"), text).unwrap();
    }
}

/// Notifications with their methods.
fn said(out: Vec<(ClientId, Message)>) -> Vec<(ClientId, Value)> {
    let value = |(id, message)| (id, serde_json::to_value::<Message>(message).unwrap());
    out.into_iter().map(value).filter(|(_, value)| value["method"] != Value::Null).collect()
}

fn methods(out: &[(ClientId, Value)]) -> Vec<(ClientId, &str)> {
    out.iter().map(|(id, value)| (*id, value["method"].as_str().unwrap())).collect()
}

#[test]
fn typing_is_saved_and_reported_within_300_ms() {
    let mut place = Place::new(&PLAN.replace('\n', "\r\n"));
    place.client(1);
    let next = PLAN.replace("go", "stay");
    assert_eq!(place.types(1, 2, &next), []);
    assert!(place.on_disk().contains("start go"), "not at every key");
    let out = place.pass(300);
    assert_eq!(methods(&out), [(1, "afp/saved")]);
    assert_eq!(out[0].1["params"]["version"], 2);
    assert_eq!(place.on_disk(), next.replace('\n', "\r\n"));
    assert_eq!(place.pass(2000), [], "what the room wrote is no news");
}

#[test]
fn a_change_right_after_a_save_arrives_despite_an_equal_stamp() {
    let mut place = Place::new(PLAN);
    place.client(1);
    place.types(1, 2, &PLAN.replace("go", "at"));
    place.pass(300);
    let written = fs::metadata(place.path("p.afp")).unwrap().modified().unwrap();
    place.outside(&PLAN.replace("go", "of"));
    let file = fs::File::options().write(true).open(place.path("p.afp")).unwrap();
    file.set_modified(written).unwrap();
    let out = place.pass(600);
    let changed = out.iter().find(|(_, value)| value["method"] == "afp/changed").unwrap();
    assert_eq!(changed.1["params"]["text"], PLAN.replace("go", "of"));
}

#[test]
fn clients_see_one_kind_of_line_end_and_the_file_keeps_its_own() {
    let mut place = Place::new("// one\r\n// two\n// three\r// four");
    place.client(1);
    let text = place.ask(1, "afp/read", json!({ "uri": place.uri("p.afp") })).unwrap();
    assert_eq!(text["text"], "// one\n// two\n// three\n// four");
    place.types(1, 2, "// one\n// 2\n// three\n// four\n");
    place.pass(300);
    assert_eq!(place.on_disk(), "// one\r\n// 2\n// three\r// four\r");
    // The room normalizes a client's text and sends it back.
    let out = place.types(1, 3, "// one\r\n// 2\n");
    assert_eq!(methods(&out), [(1, "afp/changed")]);
    assert_eq!(out[0].1["params"]["text"], "// one\n// 2\n");
}

#[test]
fn a_change_of_another_program_arrives() {
    let mut place = Place::new(PLAN);
    place.client(1);
    let next = format!("// theirs\n{PLAN}");
    place.outside(&next);
    let out = place.pass(600);
    let changed = out.iter().find(|(_, value)| value["method"] == "afp/changed").unwrap();
    assert_eq!(changed.1["params"]["text"], next);
    assert_eq!(changed.1["params"]["clean"], true);
}

#[test]
fn a_file_that_is_emptied_and_filled_is_never_empty_for_clients() {
    for typed in [false, true] {
        let mut place = Place::new(PLAN);
        place.client(1);
        let mine = PLAN.replace("Elapsed -> terminate", "Elapsed -> go");
        if typed {
            place.types(1, 2, &mine);
        }
        place.outside("");
        // The first check runs, and the second does not: a save is due earlier.
        let half = place.pass(if typed { 250 } else { 500 });
        assert_eq!(half.iter().find(|(_, it)| it["method"] == "afp/changed"), None);
        assert_eq!(place.on_disk(), "", "nothing is written into what somebody writes");
        place.outside(&format!("// theirs\n{PLAN}"));
        place.pass(1000);
        assert_eq!(place.on_disk(), format!("// theirs\n{}", if typed { &mine } else { PLAN }));
    }
}

#[test]
fn a_file_that_stays_empty_is_empty() {
    let mut place = Place::new(PLAN);
    place.client(1);
    place.outside("");
    let out = place.pass(1500);
    let changed = out.iter().find(|(_, value)| value["method"] == "afp/changed").unwrap();
    assert_eq!(changed.1["params"]["text"], "");
}

#[test]
fn a_text_written_by_another_program_counts_as_saved() {
    let mut place = Place::new(PLAN);
    place.client(1);
    let next = PLAN.replace("go", "stay");
    place.types(1, 2, &next);
    place.outside(&next);
    assert_eq!(methods(&place.pass(600)), [(1, "afp/saved")]);
}

#[test]
fn one_client_has_the_edit_lock() {
    let mut place = Place::new(PLAN);
    place.client(1);
    place.client(2);
    let next = PLAN.replace("go", "stay");
    let out = place.types(1, 2, &next);
    assert_eq!(methods(&out), [(2, "afp/changed")], "who watches sees it");
    // A read-only client takes over the sent text without a change.
    assert_eq!(place.types(2, 2, &next), []);
    place.pass(300);
    // A late client already has the saved text.
    assert_eq!(methods(&place.types(2, 2, &next)), [(2, "afp/saved")]);
    let out = place.types(2, 3, "nothing");
    assert_eq!((out[0].0, &out[0].1["params"]["text"]), (2, &json!(next)));
    let refused = place.ask(2, "afp/create", json!({ "uri": place.uri("n.afp") })).unwrap_err();
    assert!(refused.contains("edit lock"), "{refused}");
    assert_eq!(place.ask(2, "afp/pen", json!({ "take": true })).unwrap()["yours"], true);
    place.takes(2, 4, PLAN, out[0].1["params"]["number"].clone());
    place.pass(300);
    assert_eq!(place.on_disk(), PLAN);
}

#[test]
fn the_edit_lock_waits_for_its_holder_for_a_while() {
    // The absence of the holder, its previous id, and the next holder.
    for (gone, before, holder) in [
        (300, json!(1), 3),
        (4900, json!(1), 3),
        (300, Value::Null, 1),
        (300, json!(2), 1),
        (5500, json!(1), 2),
    ] {
        let mut place = Place::new(PLAN);
        place.client(1);
        place.client(2);
        place.room.leave(1, place.now);
        let told = place.pass(gone);
        assert_eq!(methods(&told), if holder == 2 { vec![(2, "afp/pen")] } else { vec![] });
        place.room.join(3);
        let hello = place.ask(3, "afp/hello", json!({ "client": before })).unwrap();
        assert_eq!(hello["pen"], holder == 3, "{gone} {before}");
        assert_eq!(place.ask(2, "afp/pen", json!({})).unwrap()["holder"], holder);
        // In the end a connected client has the edit lock.
        let told = place.pass(6000);
        assert_eq!(told.iter().any(|(_, it)| it["method"] == "afp/pen"), holder == 1);
    }
    // Without other clients: a new client gets the lock at once, and a returning one does not take
    // it from the late holder.
    for (before, has) in [(Value::Null, true), (json!(2), false)] {
        let mut place = Place::new(PLAN);
        place.client(1);
        place.client(2);
        place.room.leave(2, place.now);
        place.room.leave(1, place.now);
        place.room.join(3);
        let hello = place.ask(3, "afp/hello", json!({ "client": before })).unwrap();
        assert_eq!(hello["pen"], has, "{before}");
    }
}

#[test]
fn a_failed_save_is_reported_and_repeated() {
    let mut place = Place::new(PLAN);
    place.client(1);
    let next = PLAN.replace("go", "stay");
    place.types(1, 2, &next);
    // A directory at the path of the file prevents saving.
    fs::remove_file(place.path("p.afp")).unwrap();
    fs::create_dir(place.path("p.afp")).unwrap();
    let out = place.pass(300);
    assert!(out.iter().any(|(_, value)| value["params"]["failed"].is_string()), "{out:?}");
    fs::remove_dir(place.path("p.afp")).unwrap();
    let out = place.pass(3000);
    assert!(methods(&out).contains(&(1, "afp/saved")), "{out:?}");
    assert_eq!(place.on_disk(), next);
}

#[test]
fn a_removed_file_is_not_saved_before_a_change() {
    let mut place = Place::new(PLAN);
    place.client(1);
    fs::remove_file(place.path("p.afp")).unwrap();
    let out = place.pass(600);
    assert!(out.iter().any(|(_, value)| value["params"]["failed"].is_string()), "{out:?}");
    assert!(!place.path("p.afp").exists(), "who removes a file means it");
    let next = PLAN.replace("go", "stay");
    place.types(1, 2, &next);
    let out = place.pass(600);
    assert!(out.iter().any(|(_, value)| value["method"] == "afp/saved"), "{out:?}");
    assert_eq!(place.on_disk(), next);
    // The restored file is a change, and clients see its content.
    fs::remove_file(place.path("p.afp")).unwrap();
    place.pass(600);
    fs::write(place.path("p.afp"), &next).unwrap();
    let out = place.pass(600);
    let saved = |(_, value): &(_, Value)| {
        value["method"] == "afp/saved" && value["params"]["failed"].is_null()
    };
    assert!(out.iter().any(saved), "{out:?}");
}

#[test]
fn everything_is_saved_at_the_end() {
    let mut place = Place::new(PLAN);
    place.client(1);
    let next = PLAN.replace("go", "stay");
    place.types(1, 2, &next);
    place.room.save_all(place.now);
    assert_eq!(place.on_disk(), next);
}

#[test]
fn jobs_with_code_need_trust_and_files_of_the_folder() {
    let mut place = Place::new(PLAN);
    place.client(1);
    let file = place.uri("p.afp");
    let refused = place.ask(1, "afp/job", json!({ "kind": "build", "file": file }));
    assert!(refused.unwrap_err().contains("trust"));
    let told = place.ask(1, "afp/trust", json!({})).unwrap();
    assert_eq!(told["code"], json!([]));
    // Read-only clients can ask, but not grant.
    place.client(2);
    assert_eq!(place.ask(2, "afp/trust", json!({})).unwrap(), told);
    assert!(place.ask(2, "afp/trust", json!({ "give": true })).is_err());
    assert_eq!(place.ask(1, "afp/job", json!({ "kind": "test", "file": file })).unwrap()["id"], 1);
    for (wrong, why) in [
        (json!({ "kind": "generate", "file": "file:///etc/passwd.afp" }), "outside"),
        (json!({ "kind": "sweep", "file": file, "seeds": "--world" }), "seeds"),
        (json!({ "kind": "sweep", "file": file, "vary": ["gain=1,2", "--output=x"] }), "vary"),
        (json!({ "kind": "sweep", "file": file, "world": "/etc/rooms.toml" }), "outside"),
        (json!({ "kind": "new", "name": "../up" }), "name"),
        (json!({ "kind": "format c:" }), "unknown job"),
    ] {
        let refused = place.ask(1, "afp/job", wrong).unwrap_err();
        assert!(refused.contains(why), "{refused}");
    }
    for (until, why) in
        [("0 s", "'0 s' is not a time"), ("0.0ms", "not a time"), ("soon?", "'30 s'")]
    {
        let order = json!({ "kind": "sweep", "file": file, "until": until });
        let refused = place.ask(1, "afp/job", order).unwrap_err();
        assert!(refused.contains(why), "{refused}");
    }
    // In plan syntax.
    let order = json!({ "kind": "sweep", "file": file, "until": " 60 s" });
    assert_eq!(place.ask(1, "afp/job", order).unwrap()["id"], 2);
    assert!(place.ask(1, "afp/endJob", json!({ "id": 7 })).is_err());
    fs::write(place.path("afp.toml"), "[robot]\ncrate = \"x\"\n").unwrap();
    let refused = place.ask(1, "afp/job", json!({ "kind": "test" }));
    assert!(refused.unwrap_err().contains("trust"));
}

/// Folders that are skipped in scans can have projects.
#[test]
fn jobs_of_a_hidden_project_need_trust() {
    let mut place = Place::new(PLAN);
    place.client(1);
    fs::create_dir(place.path(".parts")).unwrap();
    fs::write(place.path(".parts/b.afp"), PLAN).unwrap();
    let toolboxes = "[toolboxes]\nt = { path = 't.afp', crate = 'c' }\n";
    fs::write(place.path(".parts/afp.toml"), toolboxes).unwrap();
    let (open, hidden) = (place.uri("p.afp"), place.uri(".parts/b.afp"));
    let code = |told: Value| told["code"].as_array().unwrap().len();
    for (file, count) in [(&open, 0), (&hidden, 1)] {
        assert_eq!(code(place.ask(1, "afp/trust", json!({ "file": file })).unwrap()), count);
        for kind in ["test", "generate", "sweep"] {
            let asked = place.ask(1, "afp/job", json!({ "kind": kind, "file": file }));
            let refused = asked.as_ref().is_err_and(|why| why.contains("trust"));
            assert_eq!(refused, count > 0, "{kind} of {file}: {asked:?}");
        }
    }
    assert_eq!(code(place.ask(1, "afp/trust", json!({})).unwrap()), 0);
}

#[test]
fn a_plan_has_the_same_drawing_for_each_page_and_in_each_room() {
    let mut place = Place::new(PLAN);
    let document = json!({ "uri": place.uri("p.afp") });
    let grown = PLAN.replace("start go", "start first").replace(
        "    actor go",
        "    actor first: Wait { Elapsed -> second }\n    actor second: Wait { Elapsed -> go }\n    actor go",
    );
    place.client(1);
    let drawing = json!({ "textDocument": document, "subscribe": true });
    place.ask(1, "afp/drawing", drawing.clone()).unwrap();
    place.types(1, 2, &grown);
    let before = place.ask(1, "afp/drawing", drawing.clone()).unwrap();
    place.room.leave(1, place.now);
    place.client(2);
    assert_eq!(drawn(&place.ask(2, "afp/drawing", drawing.clone()).unwrap()), drawn(&before));

    // A room that has not drawn the shorter plan gives the same drawing.
    let mut other = Place::new(&grown);
    other.client(1);
    let drawing = json!({ "textDocument": { "uri": other.uri("p.afp") } });
    assert_eq!(drawn(&other.ask(1, "afp/drawing", drawing).unwrap()), drawn(&before));
}

/// The boxes and edges of a drawing.
fn drawn(answer: &Value) -> [Value; 2] {
    [answer["elements"].clone(), answer["edges"].clone()]
}
