//! Valid plans, each with the dump of its graph.
//!
//! `AFP_BLESS=1` rewrites the dumps; read the diff like code.

use crate::support;

const MARK: &str = "\n// Graph:\n";

#[test]
fn every_case_has_its_graph() {
    let toolboxes = support::toolboxes();
    let mut wrong = Vec::new();
    for path in support::files("tests/graph") {
        let case = support::read(&path);
        let text = case.split(MARK).next().unwrap();
        let compiled = support::compile(text, &toolboxes);
        let Some(graph) = &compiled.graph else {
            panic!("{}:\n{}", path.display(), compiled.render(false));
        };
        let dump: String = graph.dump().lines().map(|line| format!("//  {line}\n")).collect();
        let shown = format!("{text}{MARK}{dump}");
        wrong.extend(support::compare(&path, &case, &shown));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_plan_of_the_paper_compiles_without_a_diagnostic() {
    let text = include_str!("../../../../plans/wall_following.afp");
    let compiled = support::compile(text, &support::toolboxes());
    assert!(compiled.diags.is_empty(), "{}", compiled.render(false));
    let graph = compiled.graph.unwrap();
    let plan = graph.main();
    let names: Vec<_> = plan.elements.iter().map(|element| element.name.as_str()).collect();
    let expected = [
        "searchFirstWall",
        "backupCollision",
        "findWallAngle",
        "parallelToWall",
        "followWall",
        "turnAfterWallLost",
    ];
    assert_eq!(names, expected);
    let rows = graph.rows(graph.main);
    let sweep: Vec<_> = rows
        .sweep(&rows.elements[0])
        .map(|id| plan.supervisors[id.index()].name.as_str())
        .collect();
    assert_eq!(sweep, ["touch", "checkLane", "escape"]);
}

#[test]
fn the_shown_example_has_its_diagnostic() {
    let text = "use carbot\n\nplan P {\n    start go\n\n\n    actor go: Forward(distance = 30) {\n        ForwardSuccessful -> go\n    }\n}\n";
    let compiled = support::compile(text, &support::toolboxes());
    let expected = "\
error[E0203]: expected a length, found a bare number
 --> case.afp:7:34
  |
7 |     actor go: Forward(distance = 30) {
  |                                  ^^ help: write '30 cm'";
    assert_eq!(compiled.render(false), expected);
    let json: serde_json::Value =
        serde_json::from_str(compiled.diags.json_lines(&compiled.sources).trim()).unwrap();
    assert_eq!(json["code"], "E0203");
    assert_eq!(json["place"]["line"], 7);
    assert_eq!(json["fix"]["text"], "30 cm");
}
