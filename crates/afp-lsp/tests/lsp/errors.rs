//! Errors elsewhere in a file do not change the answers about its valid parts.

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

/// A plan with ten errors, from every stage of the compiler.
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

/// Counts the errors of a document in the server's messages.
fn errors_in(said: &[Value]) -> usize {
    let found = said[0]["params"]["diagnostics"].as_array().unwrap();
    found.iter().filter(|each| each["severity"] == 1).count()
}

/// Requests about a position.
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
        (
            "textDocument/codeAction",
            json!({
                "textDocument": document,
                "range": { "start": position, "end": position },
                "context": { "diagnostics": [] },
            }),
        ),
        ("afp/itemAt", at),
    ]
}

/// Requests about a whole file.
fn about_all(lines: u32) -> Vec<(&'static str, Value)> {
    let document = json!({ "uri": URI });
    let whole = json!({ "textDocument": document });
    let range =
        json!({ "start": { "line": 0, "character": 0 }, "end": { "line": lines, "character": 0 } });
    vec![
        ("textDocument/documentSymbol", whole.clone()),
        ("textDocument/foldingRange", whole.clone()),
        ("textDocument/codeLens", whole.clone()),
        ("textDocument/semanticTokens/full", whole),
        ("textDocument/inlayHint", json!({ "textDocument": document, "range": range })),
    ]
}

fn about_items() -> Vec<(&'static str, Value)> {
    let document = json!({ "uri": URI });
    let of = |item: &str, key: &str, value: &str| json!({ "textDocument": document, "item": item, key: value });
    vec![
        ("afp/candidates", of("P.go", "outcome", "ForwardSuccessful")),
        ("afp/candidates", of("P.go", "port", "distance")),
        ("afp/candidates", of("P.look", "port", "angle")),
        ("afp/spanOf", json!({ "textDocument": document, "item": "Q.ahead" })),
        ("afp/uses", json!({ "textDocument": document, "item": "P.gap" })),
        ("afp/copy", json!({ "textDocument": document, "items": ["P.go"] })),
        ("afp/parts", json!({ "textDocument": document, "item": "P.go" })),
        ("afp/palette", json!({ "textDocument": document, "query": "turn" })),
    ]
}

/// Drops everything from the last line on, and ranges that enclose the whole file, which is longer.
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
                // The erroneous part uses the same templates.
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
fn ten_errors_do_not_change_answers_elsewhere() {
    let mut sound = Client::ready(Files::default());
    let mut wrong = Client::ready(Files::default());
    let said = sound.open(URI, SOUND);
    assert_eq!(said[0]["params"]["diagnostics"], json!([]));
    let said = wrong.open(URI, &format!("{SOUND}{WRONG}"));
    let errors = errors_in(&said);
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
                    // Completions of plan names include the other plan.
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
    // The other answers are longer in the file with errors.
    let all = about_all(lines);
    let (method, params) = all.iter().find(|(name, _)| name.ends_with("inlayHint")).unwrap();
    let [one, other] = ask(method, params);
    assert_eq!((one["result"].as_array().map(Vec::len), &one), (Some(1), &other));
    let document = json!({ "uri": URI });
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

/// A plan, and an erroneous version of some of its lines, from various stages of the compiler.
const LINES: &[(&str, Option<&str>)] = &[
    ("use carbot", None),
    ("use std", None),
    ("/// To the wall, and along it.", None),
    ("plan P {", None),
    ("    in  gap: length = 20 cm", None),
    ("    var odd: int = 2", Some("    var odd: int = 2 m")),
    ("    var found: angle = 0 deg", None),
    ("    const rounds: int = 3", None),
    ("    start go", None),
    ("    supervise tired: CheckBattery every 100 ms { BatteryLow -> terminate }", None),
    ("    actor go: Forward(distance = 2 * gap) {", None),
    ("        supervise touch: CheckTouchSensor every 5 ms { TouchSensorPressed -> look }", None),
    ("        ForwardSuccessful -> look", None),
    ("    }", None),
    (
        "    actor look: SearchWall(angle => found) { WallFound -> face, NoWallFound -> a }",
        Some("    actor look: SearchWall(angle => found) { WallFound -> face, NoWallFound -> aa }"),
    ),
    ("    actor face: Turn(angle = found) { TurnSuccessful -> round }", None),
    ("    subplan round: Q(gap) { OK -> again, Error -> terminate }", None),
    ("    computation again: Count(value = 0, limit = rounds) { Again -> near, Done -> a }", None),
    ("    actor near: Forward(distance = gap / 2) {", None),
    ("        supervise bump: CheckTouchSensor every 4 ms { TouchSensorPressed -> go }", None),
    ("        on tired { BatteryLow -> look }", None),
    ("        ForwardSuccessful -> again", None),
    ("    }", None),
    (
        "    actor a: Forward(distance = 30 cm) { ForwardSuccessful -> b }",
        Some("    actor a: Forward(distance = 30) { ForwardSuccessful -> b }"),
    ),
    (
        "    actor b: Forward(distance = 30 cm, speed = 0.1 m/s) { ForwardSuccessful -> c }",
        Some("    actor b: Forward(distance = 30 cm, sped = 0.1 m/s) { ForwardSuccessful -> c }"),
    ),
    (
        "    actor c: Turn(angle = 90 deg) { TurnSuccessful -> d }",
        Some("    actor c: Turn(angle = 90 deg) { TurnSuccesful -> d }"),
    ),
    (
        "    actor d: Forward(distance = gap) { ForwardSuccessful -> e }",
        Some("    actor d: Forwad(distance = gap) { ForwardSuccessful -> e }"),
    ),
    (
        "    subplan e: Q(gap) { OK -> f, Error -> terminate }",
        Some("    subplan e: Qq(gap) { OK -> f, Error -> terminate }"),
    ),
    (
        "    actor f: Turn(angle = found) { TurnSuccessful -> h }",
        Some("    actor f: Turn(angle = found + 1) { TurnSuccessful -> h }"),
    ),
    ("    actor h: Forward(distance = gap) {", None),
    (
        "        supervise slow: CheckTouchSensor every 5 ms { TouchSensorPressed -> i }",
        Some("        supervise slow: CheckTouchSensor every 5 m { TouchSensorPressed -> i }"),
    ),
    ("        supervise fast: CheckTouchSensor every 2 ms { TouchSensorPressed -> go }", None),
    ("        ForwardSuccessful -> i", None),
    ("    }", None),
    (
        "    actor i: Turn(angle = 90 deg) { TurnSuccessful -> j }",
        Some("    actor i: Turn(angle = ) { TurnSuccessful -> j }"),
    ),
    (
        "    actor j: Turn(angle = 90 deg) { TurnSuccessful -> k }",
        Some("    actor j: Turn(angle = 90 deg) { }"),
    ),
    (
        "    actor k: Turn(angle = 90 deg) { TurnSuccessful -> terminate }",
        Some("    actor k: Turn(angle = far) { TurnSuccessful -> }"),
    ),
    ("}", None),
    ("", None),
    ("plan Q {", None),
    ("    in gap: length", None),
    ("    start ahead", None),
    ("    actor ahead: Forward(distance = gap) { ForwardSuccessful -> terminate }", None),
    ("}", None),
];

/// The line of a part of an answer, for matching parts.
fn line_of(part: &Value) -> Option<u64> {
    let at = ["/range/start/line", "/location/range/start/line", "/position/line", "/startLine"];
    at.iter().find_map(|at| part.pointer(at)?.as_u64())
}

/// Whether a completion names a declaration of an erroneous line.
fn names_wrong(part: &Value) -> bool {
    let Some(label) = part["label"].as_str() else { return false };
    let declares = |line: &str| line.split([' ', ':']).any(|word| word == label);
    LINES.iter().any(|(line, wrong)| {
        let head = line.split(" = ").next().unwrap_or_default();
        wrong.is_some() && declares(head.split('(').next().unwrap_or_default())
    })
}

/// Drops the parts in erroneous lines, and adds the line to each colour.
fn in_sound_lines(mut answer: Value) -> Value {
    fn cut(value: &mut Value) {
        let is_wrong = |part: &Value| {
            let line = line_of(part).and_then(|line| LINES.get(line as usize));
            line.is_some_and(|(_, wrong)| wrong.is_some()) || names_wrong(part)
        };
        match value {
            Value::Object(object) => object.values_mut().for_each(cut),
            Value::Array(list) => {
                list.retain(|part| !is_wrong(part));
                list.iter_mut().for_each(cut);
            }
            _ => {}
        }
    }
    if let Some(data) = answer["result"]["data"].as_array() {
        let mut line = 0;
        let colours = data.chunks(5).map(|colour| {
            line += colour[0].as_u64().unwrap_or_default();
            json!({ "range": { "start": { "line": line } }, "colour": colour[1..] })
        });
        answer["result"]["data"] = colours.collect();
    }
    cut(&mut answer);
    answer
}

#[test]
fn ten_errors_do_not_change_other_answers_of_their_plan() {
    let text = |wrong: bool| {
        let line = |(right, other): &(&'static str, Option<&'static str>)| match other {
            Some(other) if wrong => *other,
            _ => *right,
        };
        LINES.iter().map(line).collect::<Vec<_>>().join("\n")
    };
    let mut sound = Client::ready(Files::default());
    let mut wrong = Client::ready(Files::default());
    let said = sound.open(URI, &text(false));
    assert_eq!(errors_in(&said), 0);
    let errors = errors_in(&wrong.open(URI, &text(true)));
    assert!(errors >= 10, "{errors} errors");
    let mut ask = |method: &str, params: &Value| {
        let answers = [&mut sound, &mut wrong].map(|client| client.request(method, params.clone()));
        answers.map(|said| in_sound_lines(said[0].clone()))
    };
    let mut asked = 0;
    for (line, (text, _)) in (0..).zip(LINES).filter(|(_, (_, wrong))| wrong.is_none()) {
        for character in (0..=text.len() as u32).step_by(7) {
            for (method, params) in about(line, character) {
                let [mut one, other] = ask(method, &params);
                one["id"] = other["id"].clone();
                assert_eq!(one, other, "{method} at {line}:{character}");
                asked += 1;
            }
        }
    }
    assert!(asked > 700, "asked {asked} times");
    for (method, params) in about_all(LINES.len() as u32) {
        let [one, other] = ask(method, &params);
        assert_eq!(one, other, "{method}");
        let found = one.pointer("/result/data").unwrap_or(&one["result"]);
        let count = found.as_array().map_or(0, Vec::len);
        assert!(count > 1, "{method}: {count}");
        if method == "textDocument/inlayHint" {
            assert_eq!(count, 4, "{one}");
        }
    }
}
