//! Changes of world files: boxes, walls and the robot's start. Comments and the order stay.

use serde::Deserialize;
use toml_edit::{Array, ArrayOfTables, DocumentMut, Item, Table, Value, value};

/// An empty room of 4 m by 3 m.
const EMPTY: &str = "\
version = 1
name = \"\"

[robot]
pose_m_deg = [0.8, 1.5, 0.0]

[[wall]]
name = \"room\"
points_m = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]]
closed = true
";

/// The height of a new box, in metres.
const HEIGHT: f64 = 0.5;

/// A change of a world. Poses are in metres and radians.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) enum Change {
    AddBox {
        pose: [f64; 3],
        size: [f64; 2],
    },
    AddWall {
        points: Vec<[f64; 2]>,
    },
    /// Moves the robot's start.
    Start {
        pose: [f64; 3],
    },
    /// Moves a box, given by the id of its thing in `afp/world`, and turns it by the heading.
    Move {
        thing: String,
        pose: [f64; 3],
    },
    /// Removes a box, a polygon, or a wall with all its sides.
    Remove {
        thing: String,
    },
}

/// The text of an empty room.
pub(crate) fn empty(name: &str) -> String {
    let mut document: DocumentMut = EMPTY.parse().unwrap_or_default();
    document["name"] = value(name);
    document.to_string()
}

/// Returns the text of a world after a change.
///
/// # Errors
/// The text is not TOML, or the thing cannot be changed.
pub(crate) fn changed(text: &str, change: &Change) -> Result<String, String> {
    let unreadable = |why: toml_edit::TomlError| format!("the world cannot be read: {why}");
    let mut document: DocumentMut = text.parse().map_err(unreadable)?;
    match change {
        Change::AddBox { pose, size } => {
            let mut it = Table::new();
            it["pose_m_deg"] = value(in_degrees(*pose));
            it["size_m"] = value(numbers(size));
            it["height_m"] = value(HEIGHT);
            tables(&mut document, "box")?.push(it);
        }
        Change::AddWall { points } => {
            let mut it = Table::new();
            it["points_m"] = value(points.iter().map(|point| numbers(point)).collect::<Array>());
            tables(&mut document, "wall")?.push(it);
        }
        Change::Start { pose } => {
            let robot = document.entry("robot").or_insert(Item::Table(Table::new()));
            let robot = robot.as_table_like_mut().ok_or("'robot' is not a table")?;
            robot.insert("pose_m_deg", value(in_degrees(*pose)));
        }
        Change::Move { thing, pose } => {
            let (kind, nth) = found(&document, thing)?;
            if kind != "box" {
                return Err(format!("'{}' has no pose: remove it and draw it again", name(thing)));
            }
            if let Some(it) = tables(&mut document, kind)?.get_mut(nth) {
                let before = it.get("pose_m_deg").and_then(Item::as_array);
                let before = before.and_then(|pose| pose.get(2)).and_then(degrees).unwrap_or(0.0);
                let [x, y, turn] = *pose;
                it["pose_m_deg"] = value(in_degrees([x, y, before.to_radians() + turn]));
            }
        }
        Change::Remove { thing } => {
            let (kind, nth) = found(&document, thing)?;
            tables(&mut document, kind)?.remove(nth);
        }
    }
    Ok(document.to_string())
}

/// The kind and the number of a thing. Ids begin with the number among the sides of all walls, then
/// the boxes, then the polygons.
fn found(document: &DocumentMut, thing: &str) -> Result<(&'static str, usize), String> {
    let unknown = || format!("the world has no '{}'", name(thing));
    let number = thing.split(' ').next().unwrap_or_default();
    let mut left: usize = number.parse().map_err(|_| unknown())?;
    for kind in ["wall", "box", "polygon"] {
        let all = document.get(kind).and_then(Item::as_array_of_tables);
        for (nth, table) in all.into_iter().flat_map(ArrayOfTables::iter).enumerate() {
            let sides = if kind == "wall" { sides(table) } else { 1 };
            match left.checked_sub(sides) {
                None => return Ok((kind, nth)),
                Some(rest) => left = rest,
            }
        }
    }
    Err(unknown())
}

fn sides(wall: &Table) -> usize {
    let points = wall.get("points_m").and_then(Item::as_array).map_or(0, Array::len);
    let is_closed = wall.get("closed").and_then(Item::as_bool).unwrap_or(false);
    if is_closed { points } else { points.saturating_sub(1) }
}

fn name(thing: &str) -> &str {
    thing.split_once(' ').map_or(thing, |(_, name)| name)
}

fn tables<'d>(document: &'d mut DocumentMut, kind: &str) -> Result<&'d mut ArrayOfTables, String> {
    let all = document.entry(kind).or_insert(Item::ArrayOfTables(ArrayOfTables::new()));
    all.as_array_of_tables_mut().ok_or_else(|| format!("'{kind}' is not a list of tables"))
}

fn in_degrees([x, y, heading]: [f64; 3]) -> Array {
    let degrees = (heading.to_degrees() * 10.0).round() / 10.0;
    numbers(&[x, y]).into_iter().chain([Value::from(degrees + 0.0)]).collect()
}

fn degrees(number: &Value) -> Option<f64> {
    let whole = number.as_integer().map(|number| number as f64);
    number.as_float().or(whole)
}

/// Numbers with a millimetre's precision.
fn numbers(all: &[f64]) -> Array {
    // A sum with zero has no negative zero.
    all.iter().map(|number| (number * 1000.0).round() / 1000.0 + 0.0).collect()
}

#[cfg(test)]
mod tests {
    use super::{Change, changed, empty};

    /// The text after changes.
    fn after(text: &str, all: &[Change]) -> String {
        all.iter().fold(text.to_owned(), |text, change| changed(&text, change).expect("it fits"))
    }

    #[test]
    fn a_room_gets_boxes_walls_and_a_start() {
        let room = after(
            &empty("my room"),
            &[
                Change::AddBox { pose: [1.0, 2.00004, -0.0], size: [0.35, 0.5] },
                Change::AddWall { points: vec![[2.0, 0.0], [2.0, 1.5]] },
                Change::Start { pose: [0.5, 0.5, std::f64::consts::FRAC_PI_2] },
            ],
        );
        assert!(room.starts_with("version = 1\nname = \"my room\"\n"), "{room}");
        for part in [
            "[robot]\npose_m_deg = [0.5, 0.5, 90.0]\n",
            "[[box]]\npose_m_deg = [1.0, 2.0, 0.0]\nsize_m = [0.35, 0.5]\nheight_m = 0.5\n",
            "[[wall]]\npoints_m = [[2.0, 0.0], [2.0, 1.5]]\n",
        ] {
            assert!(room.contains(part), "{part}{room}");
        }
        // Four sides of the room and one of the new wall come before the box.
        let moved = Change::Move { thing: "5 box 1".to_owned(), pose: [3.0, 1.0, 0.0] };
        assert!(after(&room, &[moved]).contains("pose_m_deg = [3.0, 1.0, 0.0]\nsize_m"));
        let remove = |thing: &str| Change::Remove { thing: thing.to_owned() };
        let bare = after(&room, &[remove("5 box 1"), remove("4 wall 2")]);
        assert!(!bare.contains("[[box]]") && bare.matches("[[wall]]").count() == 1, "{bare}");
        assert_eq!(
            changed(&bare, &remove("4 wall 2")),
            Err("the world has no 'wall 2'".to_owned())
        );
    }

    #[test]
    fn comments_stay() {
        let text = "# A room.\nversion = 1\nname = \"x\" # its name\n\n[[box]]\nname = \"crate\" # wood\n\
                    pose_m_deg = [1, 1, 30]\nsize_m = [1, 1]\nheight_m = 1\n";
        let turn = 15.0_f64.to_radians();
        let moved = Change::Move { thing: "0 crate".to_owned(), pose: [2.0, 1.0, turn] };
        let wanted = text.replace("[1, 1, 30]", "[2.0, 1.0, 45.0]");
        assert_eq!(changed(text, &moved), Ok(wanted));
    }
}
