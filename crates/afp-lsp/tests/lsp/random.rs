//! Properties of any conversation.

use proptest::prelude::*;
use serde_json::{Value, json};

use crate::client::{Client, Files};

const URI: &str = "file:///w/plan.afp";
const PLAN: &str = "use carbot\n\n// ä𝄞\nplan P {\n    start go\n    actor go: Forward {\n        ForwardSuccessful -> go\n    }\n}\n";

/// The number of cases by day; `AFP_BY_NIGHT` multiplies it by forty.
fn cases(by_day: u32) -> u32 {
    if std::env::var_os("AFP_BY_NIGHT").is_some() { by_day * 40 } else { by_day }
}

/// Texts to type.
const WORDS: &[&str] = &[
    "",
    "a",
    "\n",
    "}",
    "{",
    "𝄞",
    "\r\n",
    " -> ",
    "actor b: Turn { TurnSuccessful -> go }\n",
    "30 cm",
    "var x: length = 3 cm\n",
    "use std\n",
    "(distance = ",
    ")",
    "// ",
    "start go\n",
    "Forward",
];

/// One change: from line and column to line and column, and the new text.
type Typed = (u32, u32, u32, u32, usize);

fn change((line, column, lines, columns, word): Typed) -> Value {
    let end = json!({ "line": line + lines, "character": if lines == 0 { column + columns } else { columns } });
    json!({ "range": { "start": { "line": line, "character": column }, "end": end }, "text": WORDS[word] })
}

fn typed() -> impl Strategy<Value = Typed> {
    (0..12_u32, 0..30_u32, 0..3_u32, 0..12_u32, 0..WORDS.len())
}

/// Returns a document after an edit by the protocol's rules, line by line in UTF-16 units.
fn after(text: &str, (line, column, lines, columns, word): Typed) -> String {
    let units: Vec<u16> = text.encode_utf16().collect();
    let offset = |line: u32, column: u32| {
        let (mut at, mut left) = (0, line);
        while left > 0 {
            let Some(end) = units[at..].iter().position(|unit| *unit == 10 || *unit == 13) else {
                return units.len();
            };
            at += end + 1;
            if units[at - 1] == 13 && units.get(at) == Some(&10) {
                at += 1;
            }
            left -= 1;
        }
        let rest = &units[at..];
        let length = rest.iter().position(|unit| *unit == 10 || *unit == 13).unwrap_or(rest.len());
        let within = (column as usize).min(length);
        // The second half of a surrogate pair means its first half.
        let half = rest.get(within).is_some_and(|unit| (0xdc00..0xe000).contains(unit));
        at + within - usize::from(half)
    };
    let start = offset(line, column);
    let end =
        if lines == 0 { offset(line, column + columns) } else { offset(line + lines, columns) };
    let new: Vec<u16> = WORDS[word].encode_utf16().collect();
    let all: Vec<u16> =
        units[..start].iter().chain(&new).chain(&units[end.max(start)..]).copied().collect();
    String::from_utf16(&all).unwrap()
}

/// Requests about a document and a position.
fn questions(line: u32, character: u32) -> Vec<(&'static str, Value)> {
    let document = json!({ "uri": URI });
    let position = json!({ "line": line, "character": character });
    let at = json!({ "textDocument": document, "position": position });
    let whole = json!({ "textDocument": document });
    let range = json!({ "start": position, "end": position });
    vec![
        ("textDocument/completion", at.clone()),
        ("textDocument/hover", at.clone()),
        ("textDocument/definition", at.clone()),
        ("textDocument/signatureHelp", at.clone()),
        ("textDocument/documentHighlight", at.clone()),
        (
            "textDocument/references",
            json!({ "textDocument": document, "position": position, "context": { "includeDeclaration": true } }),
        ),
        (
            "textDocument/codeAction",
            json!({ "textDocument": document, "range": range, "context": { "diagnostics": [] } }),
        ),
        ("textDocument/documentSymbol", whole.clone()),
        ("textDocument/semanticTokens/full", whole.clone()),
        ("textDocument/foldingRange", whole.clone()),
        (
            "textDocument/selectionRange",
            json!({ "textDocument": document, "positions": [position] }),
        ),
        (
            "textDocument/inlayHint",
            json!({ "textDocument": document, "range": { "start": { "line": 0, "character": 0 }, "end": position } }),
        ),
        ("textDocument/prepareCallHierarchy", at.clone()),
        ("afp/itemAt", at),
        ("afp/drawing", whole.clone()),
        ("afp/palette", whole.clone()),
        ("afp/timing", whole.clone()),
        ("afp/export", json!({ "textDocument": document, "format": "dot" })),
    ]
}

/// The last published diagnostics.
fn last(said: &[Value]) -> Option<Value> {
    let mut published =
        said.iter().filter(|message| message["method"] == "textDocument/publishDiagnostics");
    published.next_back().map(|message| message["params"]["diagnostics"].clone())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(48)))]

    /// A server after any edits answers like a new server with the same text.
    #[test]
    fn a_changed_text_gives_the_answers_of_a_new_server(
        all in prop::collection::vec(typed(), 1..12),
        (line, character) in (0..12_u32, 0..30_u32),
    ) {
        let mut client = Client::ready(Files::default());
        let mut diagnostics = last(&client.open(URI, PLAN));
        let mut text = PLAN.to_owned();
        client.request("afp/drawing", json!({ "textDocument": { "uri": URI }, "subscribe": true }));
        for (place, typed) in all.into_iter().enumerate() {
            text = after(&text, typed);
            let document = json!({ "uri": URI, "version": place + 2 });
            let said = client.notify("textDocument/didChange", json!({ "textDocument": document, "contentChanges": [change(typed)] }));
            diagnostics = last(&said).or(diagnostics);
        }
        let mut fresh = Client::ready(Files::default());
        let first = last(&fresh.open(URI, &text));
        prop_assert_eq!(&diagnostics, &first, "{}", text);
        for (method, params) in questions(line, character) {
            // A drawing keeps its boxes in place.
            if method == "afp/drawing" {
                continue;
            }
            let (one, other) = (client.request(method, params.clone()), fresh.request(method, params));
            prop_assert_eq!(&one[0]["result"], &other[0]["result"], "{} of\n{}", method, text);
            prop_assert!(one[0].get("error").is_none() || one[0]["error"]["code"] == -32803, "{:?}", one);
        }
    }
}

/// Field names that the server knows.
const KEYS: &[&str] = &[
    "textDocument",
    "uri",
    "version",
    "text",
    "languageId",
    "contentChanges",
    "position",
    "line",
    "character",
    "range",
    "start",
    "end",
    "context",
    "diagnostics",
    "positions",
    "changes",
    "connect",
    "from",
    "outcome",
    "to",
    "add",
    "plan",
    "places",
    "P.go",
    "item",
    "port",
    "format",
    "query",
    "newName",
    "subscribe",
];

/// JSON of any shape, often with known keys.
fn any_json() -> impl Strategy<Value = Value> {
    let leaf = prop_oneof![
        Just(Value::Null),
        any::<bool>().prop_map(Value::from),
        any::<i64>().prop_map(Value::from),
        (0..20_u32).prop_map(Value::from),
        prop::sample::select(vec![
            URI,
            "file:///w/%",
            "P",
            "P.go",
            "go",
            "svg",
            "",
            "𝄞",
            "afp:/carbot.afp",
            "enum S"
        ])
        .prop_map(Value::from),
    ];
    leaf.prop_recursive(5, 40, 6, |inner| {
        let object = prop::collection::vec((prop::sample::select(KEYS), inner.clone()), 0..6);
        prop_oneof![
            prop::collection::vec(inner, 0..4).prop_map(Value::from),
            object.prop_map(|pairs| Value::Object(
                pairs.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
            )),
        ]
    })
}

/// Known and unknown methods.
const METHODS: &[&str] = &[
    "textDocument/didOpen",
    "textDocument/didChange",
    "textDocument/didClose",
    "textDocument/didSave",
    "workspace/didChangeWatchedFiles",
    "workspace/didChangeWorkspaceFolders",
    "textDocument/rename",
    "textDocument/prepareRename",
    "textDocument/formatting",
    "workspace/symbol",
    "callHierarchy/incomingCalls",
    "afp/edit",
    "afp/place",
    "afp/paste",
    "afp/spanOf",
    "afp/candidates",
    "initialize",
    "workspace/textDocumentContent",
    "textDocument/diagnostic",
    "nonsense",
    "$/cancelRequest",
    "afp/drawing",
    "textDocument/completion",
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(192)))]

    /// Every request has exactly one response.
    #[test]
    fn invalid_messages_are_answered(
        said in prop::collection::vec((prop::sample::select(METHODS.to_vec()), any_json(), any::<bool>()), 1..12),
    ) {
        let mut client = Client::ready(Files::default());
        client.open(URI, PLAN);
        for (method, params, asks) in said {
            match asks {
                true => {
                    let said = client.request(method, params);
                    let answers = said.iter().filter(|message| message.get("method").is_none());
                    prop_assert_eq!(answers.count(), 1);
                }
                false => {
                    client.notify(method, params);
                }
            }
        }
        let said = client.request("shutdown", Value::Null);
        prop_assert!(said[0]["result"].is_null() && said[0].get("error").is_none());
        client.notify("exit", Value::Null);
        prop_assert_eq!(client.server.exit_code(), Some(0));
    }
}
