//! The drawing of a plan that gets another name, or goes.

use serde_json::{Value, json};

use crate::client::{Client, Files};

const URI: &str = "file:///w/a.afp";

/// A file with plans of these names, each with what follows its name.
fn text(plans: &[&str]) -> String {
    let body = "{\n    start go\n    actor go: Wait { Elapsed -> terminate }\n}\n";
    plans.iter().fold("use std\n".to_owned(), |text, name| format!("{text}\nplan {name} {body}"))
}

/// A client that has entered the plan `B` of a file with `A` and `B`.
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

    /// The plan that is drawn after a change, and the plans that there are; none where nothing is told of the drawing.
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
fn a_plan_that_is_renamed_goes_on_to_be_drawn() {
    let mut page = Page::new();
    assert_eq!(page.types(&["A", "C"]), drawn("C", &["A", "C"]));
    assert!(page.ask("B")["error"].is_object());
    assert_eq!(page.types(&["A", "B"]), drawn("B", &["A", "B"]), "who is refused hears on");
    // Letter by letter, without a name between.
    assert_eq!(page.types(&["A", ""]), None);
    assert_eq!(page.types(&["A", "D"]), drawn("D", &["A", "D"]));
    // On the way to its name it is called as another one.
    assert_eq!(page.types(&["A", "A"]), None);
    assert_eq!(page.types(&["A", "Ab"]), drawn("Ab", &["A", "Ab"]));
}

#[test]
fn other_plans_of_the_file_are_told_though_none_of_them_is_drawn() {
    let mut page = Page::new();
    assert_eq!(page.types(&["Z", "B"]), drawn("B", &["Z", "B"]));
    assert_eq!(page.types(&["Z", "B", "C"]), drawn("B", &["Z", "B", "C"]));
    assert_eq!(page.types(&["B", "C"]), drawn("B", &["B", "C"]));
}

#[test]
fn in_place_of_a_plan_that_is_gone_the_first_one_is_drawn() {
    let mut page = Page::new();
    assert_eq!(page.types(&["A"]), drawn("A", &["A"]));
    let mut page = Page::new();
    // While it is being written nobody knows that it is gone.
    assert_eq!(page.types(&["A", "1"]), None);
    assert_eq!(page.types(&["A", "B"]), None, "it is drawn as it is");
}
