//! The files that a change reads: a large folder must not slow down the drawing of one plan.

use std::sync::{Arc, Mutex};

use afp_lsp::Host;
use serde_json::{Value, json};

use crate::client::{Client, Files};

/// Files that record each read.
struct Noted {
    files: Files,
    read: Arc<Mutex<Vec<String>>>,
}

impl Host for Noted {
    fn read(&self, path: &str) -> Result<String, String> {
        self.read.lock().unwrap().push(path.to_owned());
        self.files.read(path)
    }

    fn plan_files(&self, folder: &str) -> Vec<String> {
        self.read.lock().unwrap().push(folder.to_owned());
        self.files.plan_files(folder)
    }

    fn built_in(&self, _: &str, _: &str) -> Option<String> {
        None
    }
}

const PLAN: &str = "use std\n\nplan P {\n    start a\n    actor a: Wait { Elapsed -> b }\n    actor b: Wait { Elapsed -> terminate }\n}\n";

/// A plan, its users, and many other files.
fn files() -> Files {
    let mut files = Files::default();
    let mut add = |name: &str, text: &str| files.0.insert(format!("/w/{name}"), text.to_owned());
    add("plan.afp", PLAN);
    add("lib.afp", &PLAN.replace("plan P", "plan L"));
    add(
        "tests/s.afp",
        "use \"../plan.afp\"\nuse \"../lib.afp\"\nscenario \"s\" for P {\n    from b\n}\n",
    );
    // Another file connects this one to the plan.
    add(
        "route.afp",
        "use \"plan.afp\"\nuse std\nplan R {\n    start p\n    subplan p: P { OK -> terminate }\n}\n",
    );
    add("tests/r.afp", "use \"../route.afp\"\nscenario \"r\" for R {\n    expect p.b active\n}\n");
    // The same name in a different file.
    add("other/plan.afp", PLAN);
    add("other/s.afp", "use \"plan.afp\"\nscenario \"s\" for P {\n    from b\n}\n");
    for number in 0..30 {
        add(&format!("{number}.afp"), &PLAN.replace("plan P", "plan Q"));
    }
    files
}

/// Returns the answer to an edit, and the files read for it.
fn edited(change: Value) -> (Value, Vec<String>) {
    let read = Arc::default();
    let mut client = Client::ready(Noted { files: files(), read: Arc::clone(&read) });
    client.open("file:///w/plan.afp", PLAN);
    read.lock().unwrap().clear();
    let document = json!({ "uri": "file:///w/plan.afp", "version": 1 });
    let said = client.request("afp/edit", json!({ "textDocument": document, "changes": [change] }));
    let plans = |path: &String| path.ends_with(".afp") || path == "/w";
    (said[0].clone(), read.lock().unwrap().iter().filter(|path| plans(path)).cloned().collect())
}

#[test]
fn a_change_of_one_file_reads_only_that_file() {
    for change in [
        json!({ "connect": { "from": "P.a", "outcome": "Elapsed", "to": "terminate" } }),
        json!({ "bind": { "component": "P.a", "port": "duration", "to": { "in": "2 s" } } }),
        json!({ "add": { "plan": "P", "text": "actor c: Wait { Elapsed -> a }" } }),
    ] {
        let (said, read) = edited(change);
        assert!(said["error"].is_null(), "{said}");
        assert!(read.is_empty(), "{read:?}");
    }
}

#[test]
fn users_of_a_file_follow_its_names() {
    let edits = |change: Value| {
        let said = edited(change).0;
        let changes = said["result"]["edit"]["changes"].as_object().cloned();
        changes.ok_or(said).map(|files| files.keys().cloned().collect::<Vec<_>>())
    };
    // The first edit also writes all positions.
    let own = ["file:///w/plan.afp", "file:///w/plan.afp.layout"];
    let below = [own[0], own[1], "file:///w/tests/r.afp", "file:///w/tests/s.afp"];
    let with_route = [own[0], own[1], "file:///w/route.afp", "file:///w/tests/s.afp"];
    for to in ["Patrol", "Q"] {
        let found = edits(json!({ "rename": { "item": "P", "to": to } }));
        assert_eq!(found.as_deref(), Ok(&with_route.map(str::to_owned)[..]), "{to}");
    }
    let found = edits(json!({ "rename": { "item": "P.b", "to": "c" } }));
    assert_eq!(found.as_deref(), Ok(&below.map(str::to_owned)[..]));
    // A user of the plan sees another plan of that name.
    let refused = edits(json!({ "rename": { "item": "P", "to": "L" } })).unwrap_err();
    assert!(refused["error"]["message"].as_str().unwrap().contains("lib.afp"), "{refused}");
}
