//! Errors elsewhere in a file: what is sound is answered as if they were not there.

use serde_json::{Value, json};

use crate::client::{Client, Files};

const URI: &str = "file:///w/plan.afp";

const SOUND: &str = "\
use carbot

/// To the wall, and along it.
plan P {
    in  gap: length = 20 cm
    var found: angle
    start go
    // far
    actor go: Forward(distance = 2 * gap) {
        supervise touch: CheckTouchSensor every 5 ms { TouchSensorPressed -> look }
        ForwardSuccessful -> look
    }
    actor look: SearchWall(angle => found) { WallFound -> face, NoWallFound -> terminate }
    actor face: Turn(angle = found) { TurnSuccessful -> round }
    subplan round: Q(gap) { OK -> go, Error -> terminate }
}

plan Q {
    in gap: length
    start ahead
    actor ahead: Forward(distance = gap) { ForwardSuccessful -> terminate }
}
";

/// A plan with ten errors, of every stage of the compiler.
const WRONG: &str = "
plan Wrong {
    in  far: lenght = 3
    var far: int = 2 m
    start nowhere
    actor a: Forwad { ForwardSuccessful -> b }
    actor c: Forward(distance = 30, sped = 2) { ForwardSuccesful -> c }
    actor d: Turn(angle = unknown + 1) { }
    subplan e: Wrong { OK -> e }
    computation f: Count(value = 1, limit = 2, next => nothing) { Again -> f }
    supervise g: CheckTouchSensor every 1 m { Pressed -> h }
}
";

/// What is asked about a place.
fn about(line: u32, character: u32) -> Vec<(&'static str, Value)> {
    let document = json!({ "uri": URI });
    let position = json!({ "line": line, "character": character });
    let at = json!({ "textDocument": document, "position": position });
    let with = |key: &str, value: Value| {
        let mut params = at.clone();
        params[key] = value;
        params
    };
    vec![
        ("textDocument/completion", at.clone()),
        ("textDocument/signatureHelp", at.clone()),
        ("textDocument/hover", at.clone()),
        ("textDocument/definition", at.clone()),
        ("textDocument/typeDefinition", at.clone()),
        ("textDocument/documentHighlight", at.clone()),
        ("textDocument/prepareRename", at.clone()),
        ("textDocument/prepareCallHierarchy", at.clone()),
        ("textDocument/references", with("context", json!({ "includeDeclaration": true }))),
        ("textDocument/rename", with("newName", json!("another"))),
        (
            "textDocument/selectionRange",
            json!({ "textDocument": document, "positions": [position] }),
        ),
        ("afp/itemAt", at),
    ]
}

/// What is asked about items.
fn about_items() -> Vec<(&'static str, Value)> {
    let document = json!({ "uri": URI });
    let of = |item: &str, key: &str, value: &str| json!({ "textDocument": document, "item": item, key: value });
    vec![
        ("afp/candidates", of("P.go", "outcome", "ForwardSuccessful")),
        ("afp/candidates", of("P.go", "port", "distance")),
        ("afp/candidates", of("P.look", "port", "angle")),
        ("afp/spanOf", json!({ "textDocument": document, "item": "Q.ahead" })),
        ("afp/uses", json!({ "textDocument": document, "item": "P.gap" })),
        ("afp/palette", json!({ "textDocument": document, "query": "turn" })),
    ]
}

/// Drops what stands in the last line and behind it; around everything stands the file, which is longer.
fn in_the_first_lines(mut answer: Value, lines: u32) -> Value {
    fn cut(value: &mut Value, lines: u32) {
        match value {
            Value::Object(object) => {
                let is_last = object.get("line").and_then(Value::as_u64) >= Some(lines.into());
                if is_last {
                    object.insert("character".to_owned(), Value::Null);
                    object.insert("line".to_owned(), Value::Null);
                }
                object.values_mut().for_each(|each| cut(each, lines));
            }
            Value::Array(list) => {
                list.iter_mut().for_each(|each| cut(each, lines));
                // What is wrong uses the same templates.
                let is_behind = |each: &Value| each["range"]["start"]["line"] == Value::Null;
                list.retain(|each| each.get("range").is_none() || !is_behind(each));
            }
            _ => {}
        }
    }
    cut(&mut answer, lines);
    answer
}

#[test]
fn what_is_sound_is_answered_alike_beside_ten_errors() {
    let mut sound = Client::ready(Files::default());
    let mut wrong = Client::ready(Files::default());
    let said = sound.open(URI, SOUND);
    assert_eq!(said[0]["params"]["diagnostics"], json!([]));
    let said = wrong.open(URI, &format!("{SOUND}{WRONG}"));
    let found = said[0]["params"]["diagnostics"].as_array().unwrap();
    let errors = found.iter().filter(|each| each["severity"] == 1).count();
    assert!(errors >= 10, "{errors} errors");
    let lines = SOUND.lines().count() as u32 - 1;
    let mut ask = |method: &str, params: &Value| {
        let answers = [&mut sound, &mut wrong].map(|client| client.request(method, params.clone()));
        answers.map(|said| in_the_first_lines(said[0].clone(), lines))
    };
    let mut asked = 0;
    for (line, text) in (0..).zip(SOUND.lines()) {
        for character in (0..=text.len() as u32).step_by(7) {
            for (method, params) in about(line, character) {
                let [mut one, other] = ask(method, &params);
                if method == "textDocument/completion" {
                    // Where plans can be named, the other one can be named, too.
                    let [few, more] = [&one, &other].map(|it| it["result"]["items"].as_array());
                    let more = more.map(Vec::as_slice).unwrap_or_default();
                    let named = |item: &Value| more.iter().any(|it| it["label"] == item["label"]);
                    assert!(few.into_iter().flatten().all(named), "at {line}:{character}");
                    asked += 1;
                    continue;
                }
                one["id"] = other["id"].clone();
                assert_eq!(one, other, "{method} at {line}:{character}");
                asked += 1;
            }
        }
    }
    for (method, params) in about_items() {
        let [one, other] = ask(method, &params);
        assert_eq!(one, other, "{method} of {params}");
    }
    let document = json!({ "uri": URI });
    let range =
        json!({ "start": { "line": 0, "character": 0 }, "end": { "line": lines, "character": 0 } });
    let [one, other] =
        ask("textDocument/inlayHint", &json!({ "textDocument": document, "range": range }));
    assert_eq!((one["result"].as_array().map(Vec::len), &one), (Some(1), &other));
    let [one, other] = ask("afp/timing", &json!({ "textDocument": document }));
    assert_eq!((one["result"]["supervisors"].as_array().map(Vec::len), &one), (Some(1), &other));
    let drawn = |plan: &str| json!({ "textDocument": { "uri": URI }, "plan": plan });
    for plan in ["P", "Q"] {
        let [one, other] = ask("afp/drawing", &drawn(plan));
        for part in ["elements", "edges", "entries", "bounds"] {
            assert_eq!(one["result"][part], other["result"][part], "{part} of {plan}");
        }
    }
    assert!(asked > 700, "asked {asked} times");
}
