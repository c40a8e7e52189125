//! Plans of several files, in every command.

use crate::common::Place;

const MAIN: &str = "use std
use carbot
use \"lib/avoid.afp\"

/// Drives on after a detour.
plan Patrol {
    start go
    var gap: length
    actor go: Forward(distance = 20 cm) { ForwardSuccessful -> avoid }
    subplan avoid: Avoid(side = Side.left, gap => gap) { OK -> last }
    actor last: Forward(distance = gap) { ForwardSuccessful -> terminate }
}
";

const AVOID: &str = "use std
use carbot

enum Side { left right }

/// Waits for a while.
plan Avoid {
    in side: Side
    out gap: length
    start pause
    actor pause: Wait(duration = 1 s) { Elapsed -> tell }
    computation tell: Log(value = side) { Done -> set }
    computation set: Assign(value = 5 cm, result => gap) { Done -> terminate }
}
";

fn place() -> Place {
    let place = Place::new();
    place.write("plans/patrol.afp", MAIN);
    place.write("plans/lib/avoid.afp", AVOID);
    place
}

#[test]
fn a_run_takes_its_plans_from_several_files_and_logs_them_all() {
    let place = place();
    let said = place.afpc("run plans/patrol.afp --svg none --log a.mcap");
    said.succeeds();
    assert!(said.out.contains("avoid.pause"), "{}", said.out);
    let info = place.afpc("log a.mcap info");
    info.succeeds();
    for name in ["patrol.afp", "lib/avoid.afp"] {
        assert!(info.out.contains(name), "{}", info.out);
    }
}

#[test]
fn a_generated_crate_carries_all_files_and_names_them() {
    let place = place();
    let mut command = place.command();
    command.args(["build", "plans/patrol.afp"]).env("PATH", "").env("CARGO", "no-such-cargo");
    crate::common::said(command.output().unwrap()).fails(1, &["is not installed"]);
    let folder = "target/afp/patrol";
    assert_eq!(place.read(&format!("{folder}/patrol.afp")), MAIN);
    assert_eq!(place.read(&format!("{folder}/lib/avoid.afp")), AVOID);
    let sub_plan = place.read(&format!("{folder}/src/avoid.rs"));
    let head =
        "// Made by 'afpc build' from patrol.afp.\n\n//! The plan `Avoid` of `lib/avoid.afp`";
    assert!(sub_plan.starts_with(head), "{sub_plan}");
    // The crate's copy is a valid plan.
    place.afpc(&format!("check {folder}/patrol.afp")).succeeds();
}

#[test]
fn errors_of_a_shared_file_are_reported_once_at_that_file() {
    let place = place();
    place.write("plans/lib/avoid.afp", &AVOID.replace("1 s", "1"));
    place.write("plans/other.afp", &MAIN.replace("20 cm", "20"));
    let said = place.afpc("check plans/patrol.afp ./plans/other.afp plans/lib/../lib/avoid.afp");
    said.fails(1, &["--> plans/lib/avoid.afp:11:", "--> ./plans/other.afp:9:"]);
    assert_eq!(said.err.matches("error[").count(), 2, "{}", said.err);
    assert_eq!(said.out, "");
    let json = place.afpc("check plans/patrol.afp plans/other.afp --json");
    json.fails(1, &[]);
    assert_eq!(json.out.lines().count(), 2, "{}", json.out);
}

#[test]
fn a_missing_file_is_an_error_at_its_path() {
    let place = place();
    place.write("plans/lib/avoid.afp", &AVOID.replace("carbot\n", "carbot\nuse \"../wall.afp\"\n"));
    let said = place.afpc("run plans/patrol.afp");
    said.fails(
        1,
        &["--> plans/lib/avoid.afp:3:5", "cannot read 'plans/wall.afp': there is no such file"],
    );
}

#[test]
fn a_plan_is_chosen_among_those_of_the_file_itself() {
    let place = place();
    place.afpc("check plans/patrol.afp:Avoid").fails(1, &["the file has no plan 'Avoid'"]);
    place.afpc("check plans/lib/avoid.afp:Avoid").succeeds();
}

#[test]
fn a_drawing_and_the_formatter_work_with_several_files() {
    let place = place();
    let json = place.afpc("graph plans/patrol.afp --format json");
    json.succeeds();
    assert!(json.out.contains("\"plan\": \"Avoid\""), "{}", json.out);
    place.afpc("fmt plans/patrol.afp").succeeds();
    assert_eq!(place.read("plans/lib/avoid.afp"), AVOID);
}

#[cfg(unix)]
#[test]
fn a_link_and_its_target_are_one_file() {
    use std::os::unix::fs::symlink;
    let place = Place::new();
    let rest = "plan Rest { start w actor w: Wait { Elapsed -> terminate } }";
    place.write("rest.afp", &format!("use \"other.afp\"\nuse std\n{rest}\n"));
    place.write(
        "other.afp",
        "use \"link.afp\"\nplan Other { start r subplan r: Rest { OK -> terminate } }\n",
    );
    let main =
        "plan Main { start r subplan r: Rest { OK -> o } subplan o: Other { OK -> terminate } }";
    place.write("main.afp", &format!("use \"rest.afp\"\nuse \"other.afp\"\n{main}\n"));
    place.write("itself.afp", &format!("use \"again.afp\"\nuse std\n{rest}\n"));
    symlink(place.path("rest.afp"), place.path("link.afp")).unwrap();
    symlink(place.path("itself.afp"), place.path("again.afp")).unwrap();
    place.afpc("check main.afp").succeeds();
    place.afpc("check itself.afp").fails(1, &["E0507", "the file uses itself"]);
}
