//! World files: what is read, and that every mistake is named with its place.

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

/// The message for the good world with one change.
fn mistake(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "{from}");
    let text = GOOD.replacen(from, to, 1);
    placed(&text, &World::parse(&text).expect_err("a mistake"))
}

#[test]
fn every_mistake_is_named_with_its_line() {
    let cases = [
        ("closed = true", "colour = 3", "line 9, column 1: unknown field `colour`"),
        ("name = \"a room\"", "nam = \"a room\"", "line 2, column 1: unknown field `nam`"),
        ("size_m = [1.0, 0.5]", "size_cm = [1, 2]", "line 14, column 1: unknown field `size_cm`"),
        ("height_m = 0.7", "", "missing field `height_m`"),
        ("version = 1", "version = 2", "line 1, column 11: version 2 is unknown"),
        ("version = 1", "version = ", "line 1, column"),
        ("[1.0, 0.5]", "[1.0, 0.0]", "line 14, column 10: size_m: 0 must be greater than 0"),
        ("[1.0, 0.5]", "[1.0]", "line 14, column 10: invalid length 1"),
        ("height_m = 0.7", "height_m = nan", "line 15, column 12: height_m: NaN is not within"),
        ("1.0, 90.0]", "inf, 90.0]", "line 5, column 14: pose_m_deg: inf is not within"),
        (
            "[4.0, 0.0], [4.0, 3.0]",
            "[0.0, 0.0], [4.0, 3.0]",
            "line 8, column 12: points_m: two points",
        ),
        (", [2.5, 0.5]", "", "line 18, column 12: points_m: a polygon has three corners or more"),
        ("[2.5, 0.5]]", "[2.0, 1.0]]", "line 18, column 12: points_m: the polygon is not convex"),
        (
            "[1.0, 1.0, 90.0]",
            "[3.2, 2.0, 0]",
            "line 5, column 14: the robot starts inside of 'table'",
        ),
    ];
    for (from, to, expected) in cases {
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
