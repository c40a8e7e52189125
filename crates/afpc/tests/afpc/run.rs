//! `afpc run`: options, output, errors.

mod refused;
#[cfg(unix)]
mod signals;

use crate::common::{Place, WALL_FOLLOWING};
use serde_json::Value;

const QUIET: &str = "--log none --svg none";

#[test]
fn a_run_leaves_a_timeline_a_summary_a_log_and_a_picture() {
    let place = Place::with_plan();
    let said = place.afpc("run wall_following.afp --until 20s");
    said.succeeds();
    assert_eq!(said.err, "");
    assert!(said.out.contains("▶ searchFirstWall  Forward"), "{}", said.out);
    assert!(said.out.contains("TouchSensorPressed → backupCollision"), "{}", said.out);
    assert!(said.out.contains("◆ wallangle: unset → "), "{}", said.out);
    assert!(!said.out.contains('\u{1b}'), "no colours in a pipe");
    let summary = &said.last_json()["summary"];
    assert_eq!(summary["ending"], "interrupted");
    assert_eq!(summary["stopped_by"], "until");
    assert_eq!(summary["time_s"], 20.0);
    assert_eq!(summary["activations"]["backupCollision"], 1);
    assert_eq!(summary["contacts"][0]["obstacle"], "low step");
    assert!(summary["distance_m"].as_f64().unwrap() > 1.0);
    assert!(summary["speed"].as_f64().unwrap() > 1.0);
    let (log, svg) = ("target/afp/runs/wall_following.mcap", "target/afp/runs/wall_following.svg");
    assert_eq!((summary["log"].as_str(), summary["svg"].as_str()), (Some(log), Some(svg)));
    assert_eq!(place.files(), [log, svg, "wall_following.afp"]);
    let picture = place.read(svg);
    assert!(picture.starts_with("<svg") && picture.ends_with("</svg>\n"));
    assert!(picture.contains("TouchSensorPressed") && picture.contains("class=\"low\""));
}

#[test]
fn json_is_the_same_every_time() {
    let place = Place::with_plan();
    let run = format!("run wall_following.afp --json --until 30s --seed 3 {QUIET}");
    let said = place.afpc(&run);
    said.succeeds();
    assert_eq!(said.out, place.afpc(&run).out);
    for line in said.out.lines() {
        let line: Value = serde_json::from_str(line).unwrap();
        assert!(line.get("summary").is_some() || line["t"].is_number(), "{line}");
    }
    let first: Value = serde_json::from_str(said.out.lines().next().unwrap()).unwrap();
    assert_eq!((&first["kind"], &first["entry"]), (&"committed".into(), &"walldist".into()));
    let other = place.afpc(&run.replace("--seed 3", "--seed 4"));
    assert_ne!(said.out, other.out);
}

/// Two elements of a plan that handle one button in different ways.
const REACTIONS: &str = "use carbot
plan Keys {
    start wait
    supervise keys: CheckEscapeButtonClick { EscapeButtonClicked -> terminate }
    actor wait: Hold { on keys { EscapeButtonClicked -> drive } }
    actor drive: Forward { ForwardSuccessful -> drive }
}
";

#[test]
fn an_event_names_the_active_element_and_its_answer() {
    let place = Place::new();
    place.write("keys.afp", REACTIONS);
    let run = format!("run keys.afp --press escape@1s --press escape@2s {QUIET}");
    let said = place.afpc(&run);
    said.succeeds();
    let told = "⚡ keys.EscapeButtonClicked → drive  by 'on' of wait\n";
    assert!(said.out.contains(told), "{}", said.out);
    assert!(said.out.contains("⚡ keys.EscapeButtonClicked → terminate\n"), "{}", said.out);
    let said = place.afpc(&format!("{run} --json"));
    let lines = said.out.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    let events = lines.filter(|line| line["kind"] == "event");
    let answers: Vec<_> = events
        .map(|line| (line["target"].clone(), line["element"].clone(), line["on"].clone()))
        .collect();
    assert_eq!(
        answers,
        [
            ("drive".into(), "wait".into(), true.into()),
            ("terminate".into(), "drive".into(), Value::Null)
        ]
    );
}

#[test]
fn a_run_in_real_time_equals_a_run_at_full_speed() {
    let place = Place::with_plan();
    let run = format!("run wall_following.afp --json --until 3500ms --world random:5 {QUIET}");
    let fast = place.afpc(&run);
    fast.succeeds();
    assert_eq!(place.afpc(&format!("{run} --speed 1x")).out, fast.out);
    let trace = &fast.last_json()["summary"]["trace"];
    assert_eq!(trace.as_str().map(str::len), Some(16), "{trace}");
}

#[test]
fn a_log_does_not_change_the_run() {
    let place = Place::with_plan();
    let run = "run wall_following.afp --json --until 20s --svg none --log";
    let without = place.afpc(&format!("{run} none"));
    let with = place.afpc(&format!("{run} a.mcap"));
    assert_eq!(without.out, with.out);
    assert_eq!(place.files(), ["a.mcap", "wall_following.afp"]);
}

#[test]
fn the_escape_button_ends_the_plan() {
    let place = Place::with_plan();
    let said = place.afpc(&format!("run wall_following.afp --press escape@2s --json {QUIET}"));
    said.succeeds();
    let summary = &said.last_json()["summary"];
    assert_eq!((&summary["ending"], summary.get("stopped_by")), (&"interrupted".into(), None));
    assert!((2.0..2.1).contains(&summary["time_s"].as_f64().unwrap()), "{summary}");
    assert_eq!(summary["outcomes"]["escape.EscapeButtonPressed"], 1);
}

#[test]
fn faults_and_bumps_are_options() {
    let place = Place::with_plan();
    let said =
        place.afpc(&format!("run wall_following.afp --fail odometry.lost@1s --json {QUIET}"));
    said.fails(3, &[]);
    assert_eq!(said.last_json()["summary"]["ending"], "error");
    let said = place.afpc(&format!(
        "run wall_following.afp --fail odometry.lost@1s..1.2s --press touch@2s --until 3s --json {QUIET}"
    ));
    said.succeeds();
    let outcomes = &said.last_json()["summary"]["outcomes"];
    assert_eq!(outcomes["searchFirstWall.touch.TouchSensorPressed"], 1, "{outcomes}");
}

#[test]
fn entries_are_set_with_their_units() {
    let place = Place::with_plan();
    let run =
        |set: &str| place.afpc(&format!("run wall_following.afp --until 1s {set} --json {QUIET}"));
    let said = run("--set walldist=35cm");
    said.succeeds();
    let lines: Vec<Value> =
        said.out.lines().take(2).map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines[0]["request"], "set walldist = 0.35 m");
    let first = &lines[1];
    assert_eq!((&first["new"], &first["unit"]), (&0.35.into(), &"m".into()), "{first}");
    assert_eq!(run("--set walldist=0.35m").out, said.out);
    run("--set walldist=35").fails(2, &["not a length", "help: write the unit", "35cm"]);
    for number in ["nan", "1e999", "inf"] {
        run(&format!("--set walldist={number}")).fails(2, &["a length", "a number and a unit: "]);
    }
    run("--set walldist=35deg").fails(2, &["not a length", "a number and a unit: m, cm, mm"]);
    run("--set walldist=3,5cm").fails(2, &["not a length", "help: write 'walldist=3.5cm'"]);
    run("--set wall=1m").fails(2, &["no entry 'wall'", "can be set: 'walldist' (length)"]);
    run("--set wallangle=1rad").fails(2, &["'wallangle' cannot be set", "'walldist' (length)"]);
    run("--set walldist").fails(2, &["distance=35cm"]);
}

#[test]
fn an_entry_without_a_value_is_requested() {
    let place = Place::new();
    place.write("a.afp", &WALL_FOLLOWING.replace("length = 30 cm", "length"));
    let said = place.afpc("run a.afp --log a.mcap --svg none");
    said.fails(2, &["'walldist' has neither a value nor a default", "--set walldist="]);
    assert_eq!(place.files(), ["a.afp"]);
    place.afpc(&format!("run a.afp --set walldist=30cm --until 1s {QUIET}")).succeeds();
}

#[test]
fn help_lists_the_options_of_this_program() {
    let help = Place::with_plan().afpc("run --help");
    assert_eq!(help.out.contains("--live"), cfg!(feature = "live"), "{}", help.out);
    assert_eq!(help.out.contains("--attach"), cfg!(unix), "{}", help.out);
}

#[test]
fn worlds_are_found_in_their_order() {
    let place = Place::new();
    place.write("project/plans/wall_following.afp", WALL_FOLLOWING);
    let world = |name: &str| {
        format!("version = 1\nname = \"{name}\"\n[robot]\npose_m_deg = [1.0, 1.0, 0.0]\n")
    };
    let name = |options: &str| {
        let run = "run project/plans/wall_following.afp --json --until 100ms";
        let said = place.afpc(&format!("{run} {QUIET} {options}"));
        said.succeeds();
        said.last_json()["summary"]["world"].as_str().unwrap().to_owned()
    };
    assert_eq!(name(""), "Furnished room");
    place.write("project/worlds/wall_following.toml", &world("beside"));
    assert_eq!(name(""), "beside");
    place.write("project/rooms/mine.toml", &world("settings"));
    place.write("project/afp.toml", "[run]\nworld = \"rooms/mine.toml\"\n");
    assert_eq!(name(""), "settings");
    place.write("asked.toml", &world("asked"));
    assert_eq!(name("--world asked.toml"), "asked");
}

#[test]
fn a_world_without_a_name_has_the_name_of_its_file() {
    let place = Place::with_plan();
    place.write("hall.toml", "version = 1\n[robot]\npose_m_deg = [1.0, 1.0, 0.0]\n");
    let run = "run wall_following.afp --world hall.toml --start 2m,2m,0deg --until 100ms";
    let said = place.afpc(&format!("{run} --set world.robot.charge=0.5 --log a.mcap --svg a.svg"));
    assert!(said.succeeds().out.contains("world  hall (hall.toml)\n"), "{}", said.out);
    assert_eq!(said.last_json()["summary"]["world"], "hall");
    let again = place.afpc("run --again a.mcap --log none --svg b.svg");
    assert_eq!(again.succeeds().last_json()["summary"]["world"], "hall");
    place.afpc("log a.mcap --svg c.svg").succeeds();
    for picture in ["a.svg", "b.svg", "c.svg"] {
        assert!(place.read(picture).contains("hall, seed 0"), "{picture}");
    }
}

#[test]
fn a_plan_that_ends_in_error_has_its_own_exit_code() {
    let place = Place::new();
    let plan = "use carbot
plan Fails {
    var n: float = 0
    start go
    actor go: Forward(distance = 1 m / n) { ForwardSuccessful -> terminate }
}";
    place.write("fails.afp", plan);
    let said = place.afpc(&format!("run fails.afp {QUIET}"));
    assert_eq!(said.code, 3, "{said:#?}");
    let summary = &said.last_json()["summary"];
    assert_eq!((&summary["ending"], &summary["fault"]), (&"error".into(), &"arithmetic".into()));
    let why = "'distance' of 'go' is infinite; formula at fails.afp:5:34";
    assert_eq!((&summary["fault_text"], &summary["fault_component"]), (&why.into(), &"go".into()));
    assert!(said.out.contains(&format!("✗ go failed: {why}\n")), "{}", said.out);
    assert!(said.out.contains(&format!("error of go after 0.000 s: {why}\n")), "{}", said.out);
}

#[test]
fn a_fault_names_its_value_and_its_source() {
    let place = Place::new();
    let plan = "use carbot use std
plan Fast {
    in  pace: speed from 0 cm/s to 1 m/s
    var n:    int = 0 from 0 to 1
    start go
    actor go: Forward(speed = 5 * pace) { ForwardSuccessful -> terminate  Error -> one }
    computation one: Count(value = n, limit = 4, next => n) { Again -> two    Done -> terminate }
    computation two: Count(value = n, limit = 4, next => n) { Again -> fail   Done -> terminate }
}";
    place.write("fast.afp", plan);
    place.write(
        "a.afp",
        "use \"fast.afp\" scenario \"a\" for Fast { set pace = 1 m/s expect go active until 1 s }",
    );
    let input = "'speed' of 'go' is 5 m/s, at most 31 cm/s; formula at fast.afp:6:31";
    let output = "'next' of 'two' is 2, at most 1 for 'n'; output at fast.afp:8:58";
    let said = place.afpc("run fast.afp --set pace=1m/s --json --log f.mcap --svg none");
    assert_eq!(said.code, 3, "{said:#?}");
    let faults = said.out.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    let faults: Vec<_> = faults.filter(|event| event["kind"] == "faulted").collect();
    assert_eq!(faults.iter().map(|event| &event["text"]).collect::<Vec<_>>(), [input, output]);
    let log = place.afpc("log f.mcap").out;
    assert!(log.contains(input) && log.contains(output), "{log}");
    let tested = place.afpc("test a.afp").out;
    assert!(tested.contains(&format!("the plan ended in Error: {output}")), "{tested}");
    let refused = place.afpc("run fast.afp --set pace=2m/s");
    refused.fails(2, &["out of the entry's range, from 0 m/s to 1 m/s"]);
}

#[test]
fn the_help_of_a_plan_lists_its_inputs() {
    let place = Place::new();
    let plan = "use carbot
plan Fast {
    /// How fast.
    in pace: speed = 10 cm/s
        from 0 cm/s to 1 m/s
    in goal: length
    var far: length = 1 m
    start go
    actor go: Forward(distance = goal + far, speed = pace) { ForwardSuccessful -> terminate }
}";
    place.write("fast.afp", plan);
    let said = place.afpc("run fast.afp --help").out;
    assert!(said.contains("  pace: speed = 10 cm/s from 0 cm/s to 1 m/s  How fast.\n"), "{said}");
    assert!(said.contains("  goal: length\n") && !said.contains("far: length"), "{said}");
    assert!(!place.afpc("run --help").out.contains("pace"));
}

#[test]
fn a_run_at_the_speed_of_one_is_in_real_time() {
    let place = Place::with_plan();
    let begun = std::time::Instant::now();
    let paced = "run wall_following.afp --speed 1x --until 700ms --json --log none --svg none";
    let said = place.afpc(paced);
    said.succeeds();
    assert!(begun.elapsed().as_secs_f64() >= 0.7);
    assert_eq!(said.out, place.afpc(&paced.replace("--speed 1x", "--speed max")).out);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_failure_and_a_closed_pipe_is_not() {
    use std::fs::OpenOptions;
    use std::process::Stdio;
    let place = Place::with_plan();
    let run = "run wall_following.afp --until 1s --log none --svg none";
    let mut command = place.command();
    command.args(run.split(' ')).stdout(OpenOptions::new().write(true).open("/dev/full").unwrap());
    let full = crate::common::said(command.output().unwrap());
    full.fails(1, &["error: cannot write to 'standard output'"]);
    // A watched run prints its result although the output is incomplete.
    for json in ["", "--json"] {
        let run = format!("run wall_following.afp --until 1s {json} --log none --svg /dev/full");
        let said = place.afpc(&run);
        said.fails(1, &["cannot write the picture '/dev/full'"]);
        let summary = &said.last_json()["summary"];
        assert_eq!((&summary["stopped_by"], summary.get("svg")), (&"until".into(), None));
    }
    let mut command = place.command();
    let mut child = command.args(run.split(' ')).stdout(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    assert!(child.wait().unwrap().success());
}
