//! `afpc run --again`: a log repeats its run.

use crate::common::Place;
use serde_json::Value;

const QUIET: &str = "--log none --svg none --json";

/// A run with every kind of external input.
const RUN: &str = "run wall_following.afp --seed 4 --until 12s --set walldist=35cm --set world.robot.charge=0.5 \
                   --start 2m,1m,10deg --press touch@2s --fail wheels.slip=0.3@3s..5s --fail odometry.delayed=100ms@6s \
                   --press escape@50s --measure wall --svg none";

#[test]
fn a_log_repeats_its_run_byte_for_byte() {
    let place = Place::with_plan();
    let first = place.afpc(&format!("{RUN} --json --log a.mcap"));
    first.succeeds();
    // All inputs of the run are in the log.
    place.write("wall_following.afp", "plan Broken {");
    std::fs::remove_file(place.path("wall_following.afp")).unwrap();
    let again = place.afpc(&format!("run --again a.mcap {QUIET}"));
    assert_eq!((again.succeeds().out.as_str(), again.err.as_str()), (first.out.as_str(), ""));
    // The log of the second run repeats the run, too.
    let second = place.afpc("run --again a.mcap --log b.mcap --svg none");
    assert!(second.succeeds().out.contains(", equal to the log's\n"), "{}", second.out);
    assert_eq!(place.afpc(&format!("run --again b.mcap {QUIET}")).out, first.out);
}

#[test]
fn timeline_summary_and_log_have_the_external_inputs() {
    let place = Place::with_plan();
    let said = place.afpc(&format!("{RUN} --log a.mcap"));
    said.succeeds();
    let logged = place.afpc("log a.mcap").out;
    for line in [
        "     0.000  ● set walldist = 35 cm  from outside",
        "     2.000  ● press touch.touch  from outside",
        "     2.200  ● release touch.touch  from outside",
        "     3.000  ● fail wheels.slip = 0.3 for 2 s  from outside",
        "     6.000  ● fail odometry.delayed = 100 ms  from outside",
    ] {
        assert!(said.out.contains(line), "{line:?} in {}", said.out);
        assert!(logged.contains(line), "{line:?} in {logged}");
    }
    assert!(logged.contains("! not reached: press buttons.escape at 50 s"), "{logged}");
    let summary = "from outside  set walldist = 35 cm at 0 s\n";
    assert!(said.out.contains(summary), "{}", said.out);
    let late = "press buttons.escape at 50 s: the run was over before\n";
    assert!(said.out.contains(late), "{}", said.out);
    let requests = &said.last_json()["summary"]["requests"];
    assert_eq!(requests[3]["request"], "fail wheels.slip = 0.3 for 2 s");
    assert_eq!((&requests[3]["at_s"], &requests[3]["done"]), (&3.0.into(), &true.into()));
    assert_eq!(requests.as_array().unwrap().last().unwrap()["done"], Value::Bool(false));
}

#[test]
fn a_log_has_every_file_that_its_plan_uses() {
    let place = Place::new();
    std::fs::create_dir_all(place.path("toolbox")).unwrap();
    std::fs::create_dir_all(place.path("tests")).unwrap();
    // A file in a folder with the name that logs use for toolboxes, a file without a plan, and
    // scenarios in another folder.
    place.write("toolbox/lib.afp", "enum Side { left right }\n");
    place.write(
        "p.afp",
        "use std\nuse \"toolbox/lib.afp\"\nplan P {\n    start a\n    in side: Side = Side.left\n\
         \x20   actor a: Wait(duration = 1 s) { Elapsed -> terminate }\n}\n",
    );
    place.write(
        "tests/s.afp",
        "use \"../toolbox/lib.afp\"\nuse \"../p.afp\"\nscenario \"fails\" for P {\n    set side = Side.right\n    never end\n}\n",
    );
    place.afpc("run p.afp --log r.mcap --svg none").succeeds();
    let failed = place.afpc("test tests/s.afp");
    let log = failed.out.lines().find_map(|line| line.trim().strip_prefix("log: "));
    let log = log.unwrap_or_else(|| panic!("{failed:?}"));
    for file in ["toolbox/lib.afp", "p.afp", "tests/s.afp"] {
        std::fs::remove_file(place.path(file)).unwrap();
    }
    for (log, side) in [("r.mcap", "left"), (log, "right")] {
        let again = place.afpc(&format!("run --again {log} --log none --svg none"));
        assert!(again.succeeds().out.contains("P ended"), "{}", again.out);
        if side == "right" {
            assert!(again.out.contains("set side = Side.right"), "{}", again.out);
        }
    }
}

#[test]
fn a_log_is_enough_in_an_empty_folder() {
    let place = Place::new();
    place.write("project/afp.toml", "[run]\nmeasures = [\"wall\"]\n");
    place.write("project/lib.afp", "enum Side { left right }\n");
    place.write(
        "project/p.afp",
        "use std\nuse \"lib.afp\"\nplan P {\n    start a\n    in side: Side = Side.left\n\
         \x20   actor a: Wait(duration = 1 s) { Elapsed -> terminate }\n}\n",
    );
    let first = place.afpc("run project/p.afp --log r.mcap --svg none --json");
    first.succeeds();
    let elsewhere = Place::new();
    std::fs::copy(place.path("r.mcap"), elsewhere.path("r.mcap")).unwrap();
    let again = elsewhere.afpc(&format!("run --again r.mcap {QUIET}"));
    assert_eq!(again.succeeds().out, first.out);
}

#[test]
fn programs_print_their_version_and_check_themselves() {
    let place = Place::with_plan();
    let version = place.afpc("--version");
    for part in [concat!("afpc ", env!("CARGO_PKG_VERSION")), " for ", "\nrobot    Carbot\n"] {
        assert!(version.succeeds().out.contains(part), "{}", version.out);
    }
    let check = |values: &str| place.afpc(&format!("run wall_following.afp --self-check {values}"));
    let (first, second) = (check(""), check("--set walldist=1m --seed 3"));
    assert!(first.succeeds().out.starts_with("trace "), "{}", first.out);
    assert_ne!(first.out, second.succeeds().out);
    assert_eq!(first.out, check("").out);
    assert_eq!(place.files(), ["wall_following.afp"], "it writes nothing");
    check("--world random:1").fails(2, &["--world"]);
    let stop = place.afpc("run wall_following.afp --stop-only");
    stop.fails(2, &["'--stop-only' stops the real robot", "add '--robot hardware'"]);
}

#[test]
fn another_plan_can_be_tried_in_the_run_of_a_log() {
    let place = Place::with_plan();
    place.afpc(&format!("{RUN} --log a.mcap")).succeeds();
    let plan = place.read("wall_following.afp");
    place.write("changed.afp", &plan.replace("-60 deg", "-70 deg"));
    let said = place.afpc(&format!("run changed.afp --again a.mcap {QUIET}"));
    said.succeeds();
    assert!(said.err.contains("the log has another text of the plan"), "{}", said.err);
    for until in ["2s", "20s"] {
        let said = place.afpc(&format!("run --again a.mcap --until {until} {QUIET}"));
        assert!(said.err.contains("the log has another end\n"), "{}", said.err);
    }
}

#[test]
fn runs_that_cannot_be_repeated_are_refused() {
    let place = Place::with_plan();
    place.afpc(&format!("{RUN} --log a.mcap")).succeeds();
    place.afpc("run --again a.mcap --seed 3").fails(2, &["--again", "--seed"]);
    place.afpc("run --again gone.mcap").fails(1, &["cannot read the log 'gone.mcap'"]);
    place.afpc("run").fails(2, &["FILE[:PLAN]"]);
    place.write("small.afp", "use std\nplan Small {\n    start a\n    actor a: Wait(duration = 1 s) { Elapsed -> terminate }\n}\n");
    let said = place.afpc(&format!("run small.afp --again a.mcap {QUIET}"));
    said.fails(2, &["'set walldist = 0.35 m' at 0 s: the plan has no such entry 'walldist'"]);
}

#[test]
fn a_plan_with_the_name_of_another_part_of_its_log_is_in_it() {
    let place = Place::with_plan();
    for name in ["world", "toolbox/std"] {
        place.write(name, crate::common::WALL_FOLLOWING);
        let run = format!("run {name} --until 2s --svg none --json --log a.mcap");
        let first = place.afpc(&run);
        first.succeeds();
        std::fs::remove_file(place.path(name)).unwrap();
        let again = place.afpc(&format!("run --again a.mcap {QUIET}"));
        assert_eq!((again.succeeds().out.as_str(), again.err.as_str()), (first.out.as_str(), ""));
    }
}

#[test]
fn the_log_of_a_failed_scenario_repeats_until_its_plan_ends() {
    let place = Place::new();
    place.write(
        "p.afp",
        "use std\nplan P {\n    start a\n    actor a: Wait(duration = 400 ms) { Elapsed -> b }\n\
         \x20   actor b: Wait(duration = 600 ms) { Elapsed -> a }\n}\n\n\
         scenario \"fails\" for P {\n    expect end within 1 s\n    until 3 s\n}\n",
    );
    let failed = place.afpc("test p.afp");
    let log = failed.out.lines().find_map(|line| line.trim().strip_prefix("log: "));
    let log = log.unwrap_or_else(|| panic!("{failed:?}"));
    let again = place.afpc(&format!("run --again {log} --log none --svg none"));
    again.succeeds();
    assert!(!again.err.contains("trace"), "{}", again.err);
    assert!(again.out.contains("     3.000  ■ P ended: Interrupted"), "{}", again.out);
}
