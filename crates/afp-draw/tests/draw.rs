//! The drawings' public interface: JSON and GraphViz text of whole plans.

use afp_draw::{Options, dot, json, svg};
use afp_dsl::Toolboxes;
use afp_dsl::files::Texts;
use afp_dsl::{Compiled, compile};
use afp_syntax::source::Source;
use serde_json::Value;

const WALL_FOLLOWING: &str = include_str!("../../../plans/wall_following.afp");
const EVERY_PART: &str = include_str!("draw/every_part.afp");

/// A handler and the element that it pauses.
const PAUSED: &str = include_str!("draw/paused.afp");
const PAUSED_DOT: &str = include_str!("draw/paused.dot");

/// Table I and Fig. 2 of the paper: its numbers are centimetres and degrees.
const EXPECTED: &str = include_str!("draw/wall_following.json");

fn compiled(text: &str) -> Compiled {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let compiled = compile(&Source::new("plan.afp", text), &toolboxes, &Texts::default());
    assert!(compiled.graph.is_some(), "{}", compiled.render(false));
    compiled
}

fn json_of(text: &str) -> Value {
    let compiled = compiled(text);
    serde_json::from_str(&json(&compiled.outline, &Options::default())).unwrap()
}

/// Removes the units from the inputs, so that `10000 cm` equals the paper's `10000`.
fn without_units(value: &mut Value) {
    match value {
        Value::Object(object) => {
            for (key, value) in object {
                match value {
                    Value::Array(inputs) if key == "inputs" => inputs.iter_mut().for_each(strip),
                    _ => without_units(value),
                }
            }
        }
        Value::Array(items) => items.iter_mut().for_each(without_units),
        _ => {}
    }
}

fn strip(input: &mut Value) {
    let text = input.as_str().unwrap();
    let number = text.strip_suffix(" cm").or_else(|| text.strip_suffix(" deg"));
    *input = Value::from(number.unwrap_or(text).to_owned());
}

#[test]
fn json_of_wall_following_is_the_plan_of_the_paper() {
    let mut found = json_of(WALL_FOLLOWING);
    without_units(&mut found);
    let expected: Value = serde_json::from_str(EXPECTED).unwrap();
    assert_eq!(found["first"], expected["first"]);
    assert_eq!(found["global_supervisors"], expected["global_supervisors"]);
    let (found, expected) =
        (found["actors"].as_array().unwrap(), expected["actors"].as_array().unwrap());
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        for key in ["name", "template", "inputs", "outputs", "states", "supervisors"] {
            assert_eq!(found.get(key), expected.get(key), "{key} of {}", expected["name"]);
        }
    }
}

#[test]
fn json_has_entries_timing_ports_and_sub_plans() {
    let found = json_of(EVERY_PART);
    assert_eq!(found["plan"], "Square");
    assert_eq!(found["entries"][0]["init"], "100 cm");
    assert_eq!(found["entries"][1]["type"], "int");
    assert_eq!(found["actors"][0]["states"]["Error"], "avoid");
    assert_eq!(found["actors"][0]["supervisors"][0]["events"]["DeadlineMissed"], "turn");
    assert_eq!(found["actors"][0]["ports"]["in"]["speed"], "20 cm/s", "a default");
    assert_eq!(found["actors"][2]["kind"], "computation");
    assert_eq!(found["actors"][2]["conditions"], serde_json::json!({"Again": "value < limit"}));
    let avoid = &found["actors"][3];
    assert_eq!((&avoid["kind"], &avoid["template"]), (&"subplan".into(), &"Avoid".into()));
    assert_eq!(avoid["inputs"], serde_json::json!(["-side / 4"]), "unbound inputs are left out");
    assert_eq!(avoid["ports"]["in"]["turned"], "30 deg");
    assert_eq!(avoid["outputs"], serde_json::json!(["gap"]));
    assert_eq!(avoid["states"]["Interrupted"], "turn");
    assert_eq!(found["timing"][1]["element"], "drive");
    assert_eq!(found["timing"][1]["every_ns"], 5_000_000);
    assert_eq!(found["sub_plans"][0]["plan"], "Avoid");
}

#[test]
fn dot_has_every_element_and_every_edge_except_ignored_events() {
    let text = dot(&compiled(EVERY_PART).outline, &Options::default());
    for expected in [
        "\"Square!start\" -> \"Square:drive\" [penwidth=2];",
        "\"Square:drive\" -> \"Square:turn\" [label=\"ForwardSuccessful\", style=solid];",
        "\"Square:drive\" -> \"Square:avoid\" [label=\"touch: TouchSensorPressed\", style=dashed];",
        "\"Square:drive\" -> \"Square:avoid\" [label=\"Error\", style=dotted];",
        "\"Square!start\" -> \"Square!terminate\" [label=\"escape: EscapeButtonPressed\", style=dashed];",
        "\"Avoid:away\" -> \"Avoid!terminate\"",
        "\"Avoid:away\" -> \"Avoid!fail\" [label=\"Error\", style=dotted];",
        "\"Avoid!fail\" [label=\"fail\", shape=oval, color=red];",
        "\"Square:loop\" [label=\"loop\\nCount\\nvalue = round\\nlimit = 4\\nnext => round\", shape=hexagon",
    ] {
        assert!(text.contains(expected), "no {expected} in\n{text}");
    }
    assert!(!text.contains("Below"));
    assert_eq!(text.matches('{').count(), text.matches('}').count());
}

#[test]
fn dot_has_arrows_back_for_resuming_exits() {
    let plan = "use std plan P { start go var n: int = 0
        actor go: Wait(duration = 3 s) {
            supervise tick: Every(period = 1 s) { Due -> count }  Elapsed -> terminate
        }
        computation count: Count(value = n, limit = 3, next => n) { Again -> resume Done -> terminate } }";
    let text = dot(&compiled(plan).outline, &Options::default());
    let back = r#""P:count" -> "P:count" [label="Again\nvalue < limit\nresume", style=solid, arrowhead=empty];"#;
    assert!(text.contains(back), "{text}");
    assert!(!text.contains("!resume"), "{text}");
}

#[test]
fn live_entries_and_ranges_are_shown() {
    let plan = "use std plan P { in live far: duration = 1 s from 0 s to 2 * 5 s start go
        actor go: Wait(duration = far) { Elapsed -> terminate } }";
    assert_eq!(json_of(plan)["entries"][0]["range"], serde_json::json!(["0 s", "2 * 5 s"]));
    assert_eq!(json_of(plan)["entries"][0]["live"], true);
    let drawing = svg(&compiled(plan).outline, &Options::default());
    assert!(drawing.contains(">in live<"), "{drawing}");
    assert!(drawing.contains(">duration = 1 s from 0 s to 2 * 5 s<"), "{drawing}");
}

#[test]
fn an_endless_plan_is_marked_in_every_drawing() {
    let plan = "use std plan Patrol forever { start go actor go: Wait { Elapsed -> go } }";
    assert_eq!(json_of(plan)["forever"], true);
    assert_eq!(json_of(EVERY_PART).get("forever"), None);
    let outline = compiled(plan).outline;
    let text = dot(&outline, &Options::default());
    assert!(text.contains(r#""Patrol!start" [label="Patrol\nforever", shape=cds];"#), "{text}");
    let shown = |outline| svg(outline, &Options::default()).contains(">forever<");
    assert!(shown(&outline));
    assert!(!shown(&compiled(EVERY_PART).outline));
}

#[test]
fn declared_computations_show_their_conditions() {
    let plan = "use std
        enum Side { left right }
        computation Steer {
            in  error: length
            in  side:  Side = Side.left
            out turn:  angle
            state Far when error >= 3 cm and -error - 1 cm != 2 * (error + 1 cm) and side == Side.left {
                turn = 10 deg
            }
            state Near {}
        }
        plan P { in error: length = 1 m var turn: angle start steer
            computation steer: Steer(error, turn => turn) { Far -> steer, Near -> terminate } }";
    let outline = compiled(plan).outline;
    let condition = "error >= 3 cm and -error - 1 cm != 2 * (error + 1 cm) and side == Side.left";
    assert_eq!(json_of(plan)["actors"][0]["conditions"]["Far"], condition);
    let text = dot(&outline, &Options::default());
    assert!(text.contains(&format!("[label=\"Far\\n{condition}\", style=solid]")), "{text}");
    assert!(text.contains("[label=\"Near\", style=solid]"), "{text}");
    let drawing = svg(&outline, &Options::default());
    assert!(drawing.contains(">error &gt;= 3 cm and -error - 1 cm != …<"), "{drawing}");
    let whole = condition.replace('>', "&gt;");
    let tooltip = format!("Steer\nFar when {whole} {{ turn = 10 deg }}\nNear {{}}</title>");
    assert!(drawing.contains(&tooltip), "{drawing}");
    let plain = svg(&outline, &Options { data: false, ..Options::default() });
    assert!(!plain.contains(">error &gt;"), "{plain}");
}

#[test]
fn a_handler_is_dashed_its_suspension_has_a_ring_and_its_return_a_hook() {
    let compiled = compiled(PAUSED);
    assert_eq!(dot(&compiled.outline, &Options::default()), PAUSED_DOT);
    let drawn = svg(&compiled.outline, &Options::default());
    for part in ["box actor handler", "flow hollow event", "resume"] {
        assert_eq!(drawn.matches(&format!("class=\"{part}\"")).count(), 1, "{part}");
    }
    let json = json_of(PAUSED);
    let events = &json["global_supervisors"][0]["events"];
    assert_eq!(events["TouchSensorClicked"], "suspend pause");
    let reactions = &json["actors"][1]["reactions"][0]["events"];
    assert_eq!(reactions["TouchSensorClicked"], "return");
}
