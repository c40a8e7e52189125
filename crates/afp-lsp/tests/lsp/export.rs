//! Data for pages in addition to a drawing: its style sheet, and the book's pages.

use afp_syntax::diagnostics::Code;
use serde_json::json;

use crate::client::{Client, Files};

/// The style sheet for a page with that background.
fn sheet(theme: &str) -> String {
    let mut client = Client::ready(Files::default());
    client.open("file:///w/a.afp", "plan P {}\n");
    let document = json!({ "uri": "file:///w/a.afp" });
    let wanted = json!({ "textDocument": document, "format": "css", "theme": theme });
    let said = client.request("afp/export", wanted);
    said[0]["result"]["text"].as_str().unwrap_or_default().to_owned()
}

#[test]
fn the_style_sheet_has_the_colours_of_the_theme() {
    let page = |css: &str| {
        let rule = css.lines().find(|line| line.starts_with(".afp-plan .page{"));
        rule.unwrap_or_default().to_owned()
    };
    let (light, dark) = (sheet("light"), sheet("dark"));
    assert!(page(&light).contains("#ffffff"), "{light}");
    assert!(page(&dark).contains("#12161d"), "{dark}");
    assert!(!light.contains("prefers-color-scheme"), "the page has chosen already");
    assert!(sheet("auto").contains("prefers-color-scheme"), "the reader's system chooses");
    assert_eq!(sheet("sepia"), "");
}

#[test]
fn a_code_is_explained_as_on_the_command_line() {
    let mut client = Client::ready(Files::default());
    let said = client.request("afp/explain", json!({ "code": "E0203" }));
    let page = Code::parse("E0203").map(Code::explanation);
    assert_eq!(said[0]["result"]["text"].as_str(), page);
    let said = client.request("afp/explain", json!({ "code": "E9999" }));
    assert_eq!(said[0]["error"]["message"], "there is no error code 'E9999'");
}
