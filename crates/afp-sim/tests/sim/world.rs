//! World files: their contents, and a message with a place for every error.

use afp_sim::world::Outline;
use afp_sim::{World, WorldError};

const GOOD: &str = r#"version = 1
name = "a room"

[robot]
pose_m_deg = [1.0, 1.0, 90.0]

[[wall]]
points_m = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]]
closed = true

[[box]]
name = "table"
pose_m_deg = [3.0, 2.0, 45.0]
size_m = [1.0, 0.5]
height_m = 0.7

[[polygon]]
points_m = [[2.0, 0.5], [2.0, 0.9], [2.5, 0.5]]
height_m = 0.1
"#;

#[test]
fn a_world_has_its_obstacles_in_order() {
    let world = World::parse(GOOD).unwrap();
    let names: Vec<_> = world.obstacles.iter().map(|obstacle| obstacle.name.as_str()).collect();
    assert_eq!(names, ["wall 1", "wall 1", "wall 1", "wall 1", "table", "polygon 1"]);
    assert_eq!(world.obstacles[5].outline.corners(), [[2.5, 0.5], [2.0, 0.9], [2.0, 0.5]]);
    let Outline::Box { pose, half } = &world.obstacles[4].outline else { panic!("no box") };
    assert_eq!((pose.x, pose.y, *half), (3.0, 2.0, [0.5, 0.25]));
    assert!((pose.heading.to_degrees() - 45.0).abs() < 1e-9);
    assert!((world.start.heading.to_degrees() - 90.0).abs() < 1e-9);
}

/// An error with its line and column.
pub fn placed(text: &str, error: &WorldError) -> String {
    let Some(span) = &error.span else { return error.message.clone() };
    let (line, column) = afp_excerpt::line_column(text, span.start);
    format!("line {line}, column {column}: {}", error.message)
}

/// The message for the valid world with one change, and its help.
fn mistake(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "{from}");
    let text = GOOD.replacen(from, to, 1);
    let error = World::parse(&text).expect_err("a mistake");
    format!("{}; {}", placed(&text, &error), error.help)
}

/// A part of the valid world, its replacement, and the message.
const MISTAKES: &[(&str, &str, &str)] = &[
    ("closed = true", "colour = 3", "line 9, column 1: '[[wall]]' has no 'colour'; write 'color'"),
    (
        "name = \"a room\"",
        "nam = \"a room\"",
        "line 2, column 1: a world has no 'nam'; write 'name'",
    ),
    (
        "size_m = [1.0, 0.5]",
        "rim_cm = [1, 2]",
        "line 14, column 1: '[[box]]' has no 'rim_cm'; it has 'name', 'pose_m_deg',",
    ),
    (
        "height_m = 0.7",
        "hieght_m = 0.7",
        "line 15, column 1: '[[box]]' has no 'hieght_m'; write 'height_m'",
    ),
    (
        "height_m = 0.7",
        "",
        "line 11, column 1: '[[box]]' has no 'height_m'; write 'height_m = 0.5'",
    ),
    (
        "pose_m_deg = [1.0, 1.0, 90.0]",
        "",
        "line 4, column 2: '[robot]' has no 'pose_m_deg'; write 'pose_m_deg = [",
    ),
    ("version = 1", "version = 2", "line 1, column 11: version 2 is unknown; write 'version = 1'"),
    (
        "version = 1",
        "version = 1.0",
        "line 1, column 11: 'version' cannot have this value; write a whole number, such as 'version = 1'",
    ),
    ("version = 1", "", "a world has no 'version'; write 'version = 1'"),
    (
        "version = 1",
        "version = ",
        "line 1, column 11: string values must be quoted, expected literal string; a world is TOML: 'key = value', strings in quotes",
    ),
    ("[robot]", "[[robot]]", "line 4, column 3: 'robot' is a table; write '[robot]'"),
    (
        "[[box]]",
        "[box]",
        "line 11, column 2: 'box' is a list of tables; write '[[box]]' above each of them",
    ),
    (
        "closed = true",
        "closed = \"yes\"",
        "line 9, column 10: 'closed' cannot have this value; write true or false, such as 'closed = true'",
    ),
    (
        "[1.0, 0.5]",
        "[1.0, 0.0]",
        "line 14, column 10: size_m: 0 is less than 0.001; write 0.001 or more",
    ),
    (
        "height_m = 0.7",
        "height_m = 0.7\nmass_kg = 1e-40",
        "line 16, column 11: mass_kg: 1e-40 is less than 0.001; write 0.001 or more",
    ),
    (
        "closed = true",
        "closed = true\nthickness_m = -0.1",
        "line 10, column 15: thickness_m: -0.1 is less than 0.001; write 0.001 or more",
    ),
    (
        "height_m = 0.7",
        "height_m = 0.7\npath = { by_m = [[1, 0]], speed_m_s = 1e-50 }",
        "line 16, column 39: speed_m_s: 1e-50 is less than 0.001",
    ),
    (
        "[2.0, 0.5], [2.0, 0.9], [2.5, 0.5]",
        "[900.0, 0.0], [900.00001, 0.0], [900.0, 0.001]",
        "line 18, column 12: points_m: the corner [900.00001, 0] is on the line between its neighbours; remove it",
    ),
    (
        "[1.0, 0.5]",
        "[1.0]",
        "line 14, column 10: 'size_m' cannot have this value; write two numbers in brackets, such as 'size_m = [",
    ),
    (
        "height_m = 0.7",
        "height_m = \"0.7\"",
        "line 15, column 12: 'height_m' cannot have this value; write a number, such as 'height_m = 0.5'",
    ),
    (
        "height_m = 0.7",
        "height_m = nan",
        "line 15, column 12: height_m: NaN is not within 1000 of zero; write a number from -1000",
    ),
    (
        "height_m = 0.7",
        "height_m = 0.7\npath = 3",
        "line 16, column 8: 'path' is a table; write 'path = { by_m",
    ),
    (
        "height_m = 0.7",
        "height_m = 0.7\npath = { by_m = [[1, 0]], sped_m_s = 1 }",
        "line 16, column 27: 'path' has no 'sped_m_s'; write 'speed_m_s'",
    ),
    (
        "height_m = 0.7",
        "height_m = 0.7\ntexture = \"brick\"",
        "line 16, column 11: texture: 'brick' is not a texture; write 'bricks'",
    ),
    (
        "closed = true",
        "closed = true\nclosed = true",
        "line 10, column 1: duplicate key; remove one of them",
    ),
    ("1.0, 90.0]", "inf, 90.0]", "line 5, column 14: pose_m_deg: inf is not within"),
    (
        "[4.0, 0.0], [4.0, 3.0]",
        "[0.0, 0.0], [4.0, 3.0]",
        "line 8, column 12: points_m: two consecutive points of the wall are equal; remove one of them",
    ),
    (
        ", [2.5, 0.5]",
        "",
        "line 18, column 12: points_m: a polygon has three corners or more, not 2; add the other corners",
    ),
    (
        "[2.5, 0.5]]",
        "[2.0, 1.0]]",
        "line 18, column 12: points_m: the corner [2, 0.9] is on the line between its neighbours; remove it",
    ),
    (
        "[2.5, 0.5]]",
        "[2.1, 0.6], [2.5, 0.5]]",
        "line 18, column 12: points_m: the polygon is not convex; split it into convex polygons",
    ),
    (
        "[1.0, 1.0, 90.0]",
        "[3.2, 2.0, 0]",
        "line 5, column 14: the robot starts inside of 'table'; choose another place",
    ),
    (
        "height_m = 0.7",
        "height_m = 1e300",
        "line 15, column 12: height_m: 1e300 is not within 1000 of zero; write a number from -1000",
    ),
    (
        "[2.0, 0.5], [2.0, 0.9], [2.5, 0.5]",
        "[900.0, 900.0], [901.0, 900.00001], [902.0, 900.0]",
        "points_m: the corner [901, 900.00001] is on the line between its neighbours; remove it",
    ),
    (
        "[robot]",
        "[map]\ncorners_m = [[2, 0], [4, 0], [4, 3], [2, 3]]\n\n[robot]",
        "line 8, column 14: the robot starts beyond the edge of the map; choose another place",
    ),
];

#[test]
fn every_error_has_its_line_and_a_fix() {
    for (from, to, expected) in MISTAKES {
        let message = mistake(from, to);
        assert!(message.contains(expected), "{to}: {message}");
    }
}

#[test]
fn a_star_is_not_convex() {
    let star = "[[2.0, 0.5], [2.6, 0.9], [1.9, 0.9], [2.5, 0.5], [2.2, 1.2]]";
    let message = mistake("[[2.0, 0.5], [2.0, 0.9], [2.5, 0.5]]", star);
    assert!(message.contains("not convex"), "{message}");
}
