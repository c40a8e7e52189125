//! `afpc check --timing`: the table, targets of `afp.toml`, and the exit codes.

use crate::common::Place;

const PLAN: &str = "\
use carbot

plan P {
    start go
    actor go: Forward {
        supervise touch: CheckTouchSensor every 1 ms { TouchSensorPressed -> terminate }
        ForwardSuccessful -> terminate
    }
}
";

fn project(toml: &str) -> Place {
    let place = Place::new();
    place.write("p.afp", PLAN);
    if !toml.is_empty() {
        place.write("afp.toml", toml);
    }
    place
}

#[test]
fn the_table_shows_the_parts_of_a_bound() {
    let said = project("").afpc("check p.afp --timing");
    let table = &said.succeeds().out;
    assert!(table.contains("no target: ticks and capacity are not checked"), "{table}");
    let sum = "301.13 ms proved  period 1 ms + response 80 us + interrupt 50 us + stop 300 ms";
    assert!(table.contains(sum), "{table}");
}

#[test]
fn json_has_the_contents_of_the_table() {
    let line = project("").afpc("check p.afp --timing --json --target pi").last_json();
    assert_eq!(line["target"], "pi");
    let row = &line["timing"]["supervisors"][0];
    assert_eq!(row["supervisor"], "go.touch");
    assert_eq!(row["response"]["total_ns"], 180_000);
    assert_eq!(row["interruption"]["trust"], "proved");
    assert_eq!(row["interruption"]["total_ns"], 301_230_000);
}

#[test]
fn targets_of_the_project_are_checked_by_default() {
    let place = project("[target.slow]\ntick = \"2 ms\"\ncapacity = 0.01\n");
    place.afpc("check p.afp").fails(1, &["error[E0403]", "error[E0404]"]);
    place.afpc("check p.afp --target mcu").succeeds();
}

#[test]
fn errors_of_a_target_are_at_their_place() {
    let place = project("[target.slow]\ntock = 3\n");
    place.afpc("check p.afp").fails(1, &["afp.toml:2:1", "tock"]);
    project("").afpc("check p.afp --target moon").fails(2, &["there is no target 'moon'"]);
}

#[test]
fn a_budget_needs_a_known_template() {
    let budget = |of: &str| project(&format!("[target.slow]\nbudgets.{of} = \"30 us\"\n"));
    let wrong = |of: &str, said: &[&str]| _ = budget(of).afpc("check p.afp").fails(2, said);
    wrong("carbt.Forward", &["there is no toolbox 'carbt'", "write 'budgets.carbot.Forward'"]);
    wrong("gripper.Grip", &["there is no toolbox 'gripper'", "there are 'std' and 'carbot'"]);
    wrong("carbot.Forwrd", &["has no template 'Forwrd'", "write 'budgets.carbot.Forward'"]);
    // Another plan may use it.
    budget("std.Wait").afpc("check p.afp").succeeds();
}
