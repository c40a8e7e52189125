//! The drawing of a plan that is renamed or removed.

use serde_json::{Value, json};

use crate::client::{Client, Files};

const URI: &str = "file:///w/a.afp";

/// A file with these plans: each name and the text after it.
fn text(plans: &[&str]) -> String {
    let body = "{\n    start go\n    actor go: Wait { Elapsed -> terminate }\n}\n";
    plans.iter().fold("use std\n".to_owned(), |text, name| format!("{text}\nplan {name} {body}"))
}

/// A client that shows the plan `B` of a file with `A` and `B`.
struct Page {
    client: Client,
    version: i32,
}

impl Page {
    fn new() -> Page {
        let mut client = Client::ready(Files::default());
        client.open(URI, &text(&["A", "B"]));
        let mut page = Page { client, version: 1 };
        assert_eq!(page.ask("B")["result"]["plan"], "B");
        page
    }

    fn ask(&mut self, plan: &str) -> Value {
        let document = json!({ "uri": URI });
        let params = json!({ "textDocument": document, "plan": plan, "subscribe": true });
        self.client.request("afp/drawing", params).swap_remove(0)
    }

    /// Changes the text and returns the drawn plan and all plans; `None` without a message about
    /// the drawing.
    fn types(&mut self, plans: &[&str]) -> Option<(String, Vec<String>)> {
        self.version += 1;
        let document = json!({ "uri": URI, "version": self.version });
        let params =
            json!({ "textDocument": document, "contentChanges": [{ "text": text(plans) }] });
        let said = self.client.notify("textDocument/didChange", params);
        let change = said.into_iter().find(|it| it["method"] == "afp/drawingChanged")?;
        let read = |name: &str| serde_json::from_value(change["params"][name].clone()).unwrap();
        Some((
            serde_json::from_value(read("plan")).ok()?,
            serde_json::from_value(read("plans")).ok()?,
        ))
    }
}

fn drawn(plan: &str, plans: &[&str]) -> Option<(String, Vec<String>)> {
    Some((plan.to_owned(), plans.iter().map(|&name| name.to_owned()).collect()))
}

#[test]
fn a_renamed_plan_is_still_drawn() {
    let mut page = Page::new();
    assert_eq!(page.types(&["A", "C"]), drawn("C", &["A", "C"]));
    assert!(page.ask("B")["error"].is_object());
    assert_eq!(page.types(&["A", "B"]), drawn("B", &["A", "B"]), "who is refused hears on");
    // The name is typed letter by letter and empty in between.
    assert_eq!(page.types(&["A", ""]), None);
    assert_eq!(page.types(&["A", "D"]), drawn("D", &["A", "D"]));
    // An intermediate name is another plan's name.
    assert_eq!(page.types(&["A", "A"]), None);
    assert_eq!(page.types(&["A", "Ab"]), drawn("Ab", &["A", "Ab"]));
}

#[test]
fn plans_without_a_drawing_are_listed() {
    let mut page = Page::new();
    assert_eq!(page.types(&["Z", "B"]), drawn("B", &["Z", "B"]));
    assert_eq!(page.types(&["Z", "B", "C"]), drawn("B", &["Z", "B", "C"]));
    assert_eq!(page.types(&["B", "C"]), drawn("B", &["B", "C"]));
}

#[test]
fn the_first_plan_replaces_a_missing_one() {
    let mut page = Page::new();
    assert_eq!(page.types(&["A"]), drawn("A", &["A"]));
    let mut page = Page::new();
    // While the file is unreadable, the plan counts as present.
    assert_eq!(page.types(&["A", "1"]), None);
    assert_eq!(page.types(&["A", "B"]), None, "it is drawn as it is");
}
