//! The published schema of world files agrees with the reader.

use afp_sim::World;
use serde_json::Value;
use std::collections::BTreeSet;
use toml_edit::{DocumentMut, Item};

/// A file with every table and every combinable key.
const FULL: &str = r##"
version = 1
name = "everything"
robot = { pose_m_deg = [0, 0, 0], charge = 0.5, length_m = 0.3, width_m = 0.2, track_m = 0.16, wheelbase_m = 0.09, steering_deg = 30, fastest_m_s = 0.4, sonar_m = 0.1, encoders = false }
floor = { color = "#ffffff", texture = "checks" }
[[wall]]
name = "wall"
points_m = [[2, 0], [2, 1], [3, 1]]
closed = true
thickness_m = 0.2
height_m = 2
color = "#000000"
texture = "bricks"
echo = 0.5
mapped = false
[[box]]
name = "box"
pose_m_deg = [0, 3, 0]
size_m = [1, 1]
height_m = 1
path = { by_m = [[1, 0]], speed_m_s = 0.5, closed = true, wait_s = 1, start_s = 2 }
color = "#000000"
texture = "plain"
echo = 0.5
mapped = false
[[polygon]]
name = "polygon"
points_m = [[-2, 0], [-2, 1], [-3, 1]]
height_m = 1
mass_kg = 1
color = "#000000"
texture = "stripes"
echo = 0.5
mapped = false
[[patch]]
name = "patch"
points_m = [[-2, 0], [-2, 1], [-3, 1]]
color = "#00ff00"
[[infrared]]
name = "light"
position_m = [5, 5]
height_m = 1
strength = 2
[map]
corners_m = [[-9, -9], [9, -9], [9, 9], [-9, 9]]
"##;

/// Each table of the schema, and a file with a key `KEY` in that table.
const TABLES: [(&str, &str); 10] = [
    ("", "KEY = 1"),
    ("robot", "[robot]\nKEY = 1"),
    ("floor", "[floor]\nKEY = 1"),
    ("wall", "[[wall]]\nKEY = 1"),
    ("box", "[[box]]\nKEY = 1"),
    ("polygon", "[[polygon]]\nKEY = 1"),
    ("path", "[[box]]\npath = { KEY = 1 }"),
    ("patch", "[[patch]]\nKEY = 1"),
    ("infrared", "[[infrared]]\nKEY = 1"),
    ("map", "[map]\nKEY = 1"),
];

fn schema() -> Value {
    serde_json::from_str(World::SCHEMA).expect("the schema is JSON")
}

/// A table of the schema; the whole file has no name.
fn table<'a>(schema: &'a Value, name: &str) -> &'a Value {
    if name.is_empty() { schema } else { &schema["$defs"][name] }
}

/// The keys that the schema allows in a table.
fn known(table: &Value) -> BTreeSet<String> {
    table["properties"].as_object().expect("a table has keys").keys().cloned().collect()
}

fn required(table: &Value) -> BTreeSet<&str> {
    let keys = table["required"].as_array();
    keys.into_iter().flatten().filter_map(Value::as_str).collect()
}

#[test]
fn the_reader_has_exactly_the_keys_of_the_schema() {
    let schema = schema();
    for (name, text) in TABLES {
        let error = World::parse(&text.replace("KEY", "no_such_key"));
        let list = error.unwrap_err().help;
        let read: BTreeSet<String> =
            list.split('\'').skip(1).step_by(2).map(str::to_owned).collect();
        assert_eq!(read, known(table(&schema, name)), "[{name}]: {list}");
        assert_eq!(table(&schema, name)["additionalProperties"], false, "[{name}]");
    }
}

#[test]
fn the_page_on_worlds_names_every_key() {
    let page = include_str!("../../../../docs/simulator.md");
    // Text is outside of fences and outside of inline code.
    let text: String = page.split("```").step_by(2).collect();
    let words =
        text.split('`').skip(1).step_by(2).flat_map(|span| span.split([' ', '[', ']', ',']));
    let words: BTreeSet<&str> = words.collect();
    let schema = schema();
    for (name, _) in TABLES {
        for key in known(table(&schema, name)) {
            assert!(words.contains(&*key), "docs/simulator.md: nothing of '{key}' in '{name}'");
        }
    }
}

#[test]
fn required_keys_of_the_schema_are_required_by_the_reader() {
    World::parse(FULL).expect("the example is whole");
    let schema = schema();
    for (name, _) in TABLES {
        let table = table(&schema, name);
        let (all, required) = (known(table), required(table));
        for key in all {
            let mut document: DocumentMut = FULL.parse().expect("the example is TOML");
            let there = match name {
                "" => document.as_item_mut(),
                "robot" | "floor" | "map" => &mut document[name],
                "path" => &mut document["box"][0]["path"],
                name => &mut document[name][0],
            };
            if there.get(&key).is_none() {
                assert!(["mass_kg", "path"].contains(&key.as_str()), "[{name}] {key}");
                continue;
            }
            there[key.as_str()] = Item::None;
            let read = World::parse(&document.to_string());
            assert_eq!(read.is_err(), required.contains(key.as_str()), "[{name}] {key}: {read:?}");
        }
    }
}

#[test]
fn schema_and_reader_have_the_same_textures_and_defaults() {
    let schema = schema();
    let textures = schema["$defs"]["texture"]["enum"].as_array().expect("a list");
    for texture in textures.iter().filter_map(Value::as_str) {
        World::parse(&FULL.replace("checks", texture)).expect("a texture that the schema lists");
    }
    let help = World::parse(&FULL.replace("checks", "marble")).unwrap_err().help;
    assert_eq!(help.matches('\'').count(), 2 * textures.len(), "{help}");
    let bare = World::parse(
        "version = 1\nrobot = { pose_m_deg = [0, 0, 0] }\n\
         wall = [{ points_m = [[2, 0], [2, 1]] }]\ninfrared = [{ position_m = [1, 1] }]",
    );
    let bare = bare.expect("nothing else is required");
    let default = |table: &str, key: &str| {
        schema["$defs"][table]["properties"][key]["default"].as_f64().expect("a default")
    };
    assert_eq!(bare.charge, default("robot", "charge"));
    assert_eq!(bare.obstacles[0].height, default("wall", "height_m"));
    assert_eq!(bare.obstacles[0].echo, default("wall", "echo"));
    assert_eq!(bare.lights[0].height, default("infrared", "height_m"));
    assert_eq!(bare.lights[0].strength, default("infrared", "strength"));
}

#[test]
fn shipped_worlds_name_the_schema() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../worlds");
    for entry in std::fs::read_dir(folder).expect("there are worlds") {
        let path = entry.expect("a file").path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            let text = std::fs::read_to_string(&path).expect("a text");
            assert!(text.starts_with("#:schema ./world.schema.json\n"), "{}", path.display());
        }
    }
}
