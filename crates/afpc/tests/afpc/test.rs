//! `afpc test`: finds scenarios, runs them, reports failures.

use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};

use crate::common::Place;

const SCENARIOS: &str = r#"use "../wall_following.afp"

scenario "a bump leads back" for WallFollowing {
    at 1 s: press touch
    expect searchFirstWall -> backupCollision by touch within 1 ms after 1 s
    until 2 s
}

scenario "nothing is ever touched" for WallFollowing {
    never collision
    until 20 s
}
"#;

fn place() -> Place {
    let place = Place::with_plan();
    place.write("tests/room.afp", SCENARIOS);
    place
}

#[test]
fn scenarios_are_found_run_and_judged() {
    let place = place();
    let said = place.afpc("test");
    assert_eq!(said.code, 3, "{said:#?}");
    for text in [
        "ok    2.000 s  a bump leads back  tests/room.afp:3",
        "FAILED",
        "  never collision\n",
        "broken here",
        "1 passed, 1 failed",
        "log: target/afp/tests/room.nothing_is_ever_touched.",
    ] {
        assert!(said.out.contains(text), "no {text:?} in {}", said.out);
    }
    let log = said.out.lines().find_map(|line| line.trim().strip_prefix("log: ")).unwrap();
    let log = place.afpc(&format!("log {log} info"));
    log.succeeds();
    for fact in
        ["nothing is ever touched", "plan_hash  ", "world_hash  ", "physics_step_ns  5000000"]
    {
        assert!(log.out.contains(fact), "no {fact:?} in {}", log.out);
    }
}

#[test]
fn words_and_files_select_scenarios() {
    let place = place();
    let said = place.afpc("test bump --json --coverage");
    said.succeeds();
    assert_eq!(said.out.lines().count(), 2, "{}", said.out);
    let coverage = said.last_json();
    assert_eq!(coverage["coverage"], "WallFollowing");
    let part = |name: &str| {
        let parts = coverage["parts"].as_array().unwrap();
        parts.iter().find(|part| part["name"] == name).unwrap()["count"].as_u64().unwrap()
    };
    assert_eq!(part("searchFirstWall.touch.TouchSensorPressed"), 1);
    assert_eq!(part("followWall"), 0);
    place.afpc("run wall_following.afp --until 60s --log a.mcap --svg none").succeeds();
    let more = place.afpc("test bump --json --coverage --add-log a.mcap").last_json();
    let parts = more["parts"].as_array().unwrap();
    let follow = parts.iter().find(|part| part["name"] == "followWall").unwrap();
    assert!(follow["count"].as_u64().unwrap() > 0, "{follow}");
    place.afpc("test bump --coverage -o cover").succeeds();
    let drawing = place.read("cover/WallFollowing.svg");
    assert!(drawing.contains("TouchSensorPressed  ×1"), "{drawing}");
    assert!(drawing.contains("WallForward · never"), "{drawing}");
    let gif = place.afpc("test bump --coverage -o cover.gif");
    gif.fails(2, &["'cover.gif' is neither an SVG nor a PNG"]);
    place.afpc("test tests/room.afp bump").succeeds();
    place.afpc("test nonsense").fails(2, &["no scenario has 'nonsense' in its name"]);
    place.afpc("test wall_following.afp").fails(2, &["has no scenarios"]);
}

#[test]
fn scenarios_are_generated_and_pass() {
    let place = Place::with_plan();
    let said = place.afpc("test --generate wall_following.afp");
    said.succeeds();
    assert!(said.out.starts_with("tests/wall_following_generated.afp: "), "{}", said.out);
    place.afpc("fmt --check tests/wall_following_generated.afp").succeeds();
    place.afpc("test").succeeds();
    place.afpc("test --generate").fails(2, &["needs the file of a plan"]);
}

#[test]
fn a_failing_plan_has_passing_scenarios_and_a_plan_without_events_has_none() {
    let place = Place::new();
    let parts = "actor go: Forward(distance = 50 cm) { ForwardSuccessful -> terminate }";
    let fails = "supervise battery: CheckBattery { BatteryLow -> rest }
        actor rest: Signal(times = 3) { Signalled -> fail \"battery\" }";
    place.write("m.afp", &format!("use carbot\nplan M {{ start go\n{parts}\n{fails} }}\n"));
    place.write("square.afp", &format!("use carbot\nplan Square {{ start go\n{parts} }}\n"));
    let said = place.afpc("test --generate square.afp");
    said.succeeds();
    let told = "square.afp: no scenarios; nothing is written\n  left out: no event interrupts anything in 'Square'\n";
    assert_eq!(said.out, told);
    assert_eq!(place.files(), ["m.afp", "square.afp"]);
    place.afpc("test --generate m.afp").succeeds();
    assert!(place.read("tests/m_generated.afp").contains("expect end by Error\n"));
    place.afpc("test tests").succeeds();
}

#[test]
fn generated_scenarios_find_their_plan_from_their_folder() {
    let place = Place::with_plan();
    let said = place.afpc("test --generate wall_following.afp -o checks/deep/walls.afp");
    said.succeeds();
    assert!(said.out.starts_with("checks/deep/walls.afp: "), "{}", said.out);
    place.afpc("check checks/deep/walls.afp").succeeds();
    place.afpc("test wall_following.afp -o walls.svg").fails(2, &["--coverage", "--generate"]);
}

#[test]
fn other_scenarios_are_not_replaced() {
    let place = place();
    let said = place.afpc("test --generate wall_following.afp -o tests/room.afp");
    said.fails(2, &["'afpc test --generate' did not write 'tests/room.afp'", "with '-o FILE'"]);
    assert_eq!(place.read("tests/room.afp"), SCENARIOS);
    let said = place.afpc("test --generate tests/room.afp");
    said.fails(2, &["'tests/room.afp' does not declare a plan", "plan: 'wall_following.afp'"]);
    assert_eq!(place.files(), ["tests/room.afp", "wall_following.afp"]);
    place.write("tests/new.afp", "\n");
    for _ in 0..2 {
        place.afpc("test --generate wall_following.afp -o tests/new.afp").succeeds();
    }
}

#[test]
fn a_file_that_is_given_twice_runs_once() {
    let said = place().afpc("test tests tests/room.afp ./tests/room.afp bump");
    assert!(said.succeeds().out.contains("1 passed"), "{}", said.out);
}

#[test]
fn a_wrong_scenario_does_not_hide_the_others() {
    let place = place();
    place.write("tests/wrong.afp", "use \"../wall_following.afp\"\n\nscenario \"x\" for WallFollowing { expect nobody active }\n");
    let said = place.afpc("test");
    assert_eq!(said.code, 3, "{}", said.out);
    assert!(said.out.contains("ok    ") && said.out.contains("a bump leads back"), "{}", said.out);
    assert!(said.out.contains("FAILED    0.000 s  x  tests/wrong.afp:3"), "{}", said.out);
    assert!(said.out.contains("error[E0602]: 'WallFollowing' has no element"), "{}", said.out);
    place.afpc("test bump").succeeds();
    // An error outside of the scenarios hides them.
    place.write("tests/wrong.afp", "use \"../wall_following.afp\"\nuse nothing\n\nscenario \"x\" for WallFollowing { expect running }\n");
    place.afpc("test bump").fails(1, &["E0238", "tests/wrong.afp:2"]);
}

#[test]
fn scenarios_hidden_by_an_error_are_reported() {
    let place = place();
    place.write(
        "tests/open.afp",
        "/* a comment that nobody ends\nscenario \"x\" for P { until 1 s }\n",
    );
    let said = place.afpc("test bump");
    said.fails(1, &["E0105", "tests/open.afp:1"]);
    assert!(said.out.contains("1 passed"), "{said:#?}");
    std::fs::remove_file(place.path("tests/open.afp")).unwrap();
    // A file in the place of a folder.
    place.write("scenarios", "");
    place.afpc("test bump").fails(1, &["cannot read the folder 'scenarios'"]);
}

const SHORT: &str = r#"use carbot

plan Short {
    start go
    supervise escape: CheckEscapeButton { EscapeButtonPressed -> terminate }
    actor go: Forward(distance = 20 cm) { ForwardSuccessful -> back }
    actor back: Forward(distance = -10 cm) { ForwardSuccessful -> terminate }
}
"#;

#[test]
fn a_file_that_is_not_utf8_does_not_hide_the_others() {
    let place = place();
    std::fs::write(place.path("tests/bytes.afp"), [0xff, 0xfe]).unwrap();
    let said = place.afpc("test bump");
    assert_eq!(said.code, 1, "{said:#?}");
    assert!(said.err.contains("bytes.afp': it is not UTF-8 text"), "{said:#?}");
    assert!(said.out.contains("1 passed"), "{said:#?}");
}

#[test]
fn unnoticed_mutants_are_reported() {
    let place = Place::new();
    place.write("short.afp", SHORT);
    let scenarios = "use \"../short.afp\"\n\nscenario \"ends\" for Short { expect go -> back  expect end by back before 20 s }\n";
    place.write("tests/short.afp", scenarios);
    let said = place.afpc("test --mutate");
    said.succeeds();
    for text in [
        "short.afp: ",
        "sign      20 cm becomes -20 cm",
        "NOBODY noticed",
        "-> back becomes -> ",
        "noticed by 'ends'",
        " mutants that change a run are noticed (",
    ] {
        assert!(said.out.contains(text), "no {text:?} in {}", said.out);
    }
    assert_eq!(
        said.out,
        place.afpc("test --mutate --seed 0").out,
        "the same seed, the same mutants"
    );
    let few = place.afpc("test --mutate --at-least 99");
    few.fails(3, &["short.afp: ", " % of the mutants are noticed; '--at-least' requires 99 %"]);
    for percent in ["nan", "inf", "101", "-1"] {
        let said = place.afpc(&format!("test --mutate --at-least {percent}"));
        said.fails(2, &["expected a number from 0 to 100"]);
    }
    let json = place.afpc("test --mutate --json").last_json();
    assert_eq!(json["mutated"], "short.afp");
    let share = json["share"].as_f64().unwrap();
    assert!(share > 0.2 && share < 0.99, "{json}");
    // A scenario that checks the final position notices the signs, too.
    let told = scenarios.replace(
        "before 20 s",
        "before 20 s  never robot.pose.x < 2.39 m  expect robot.pose.x > 2.55 m",
    );
    place.write(
        "tests/short.afp",
        &told.replace("for Short {", "for Short { robot at (2.4 m, 2.4 m) heading 0 deg "),
    );
    let better = place.afpc("test --mutate --json").last_json()["share"].as_f64().unwrap();
    assert!(better > share, "{better}");
    place.afpc("test --mutate nothing").fails(2, &["takes files", "no file 'nothing'"]);
}

#[test]
fn errors_are_reported_in_addition_to_mutants() {
    let place = Place::new();
    place.write("short.afp", SHORT);
    let scenarios = "use \"../short.afp\"\n\nscenario \"ends\" for Short { expect go -> back }\n";
    place.write("tests/short.afp", scenarios);
    let with_missing = place.afpc("test --mutate tests/short.afp tests/gone.afp");
    with_missing.fails(1, &["gone.afp"]);
    assert!(with_missing.out.contains(" mutants that change a run"), "{}", with_missing.out);
    let wrong = format!("{scenarios}scenario \"x\" for Short {{ expect nobody active }}\n");
    place.write("tests/short.afp", &wrong);
    let said = place.afpc("test --mutate");
    assert_eq!(said.code, 3, "{}", said.out);
    assert!(said.err.contains("E0602") || said.out.contains("E0602"), "{said:?}");
    // The only scenario.
    place.write(
        "tests/short.afp",
        "use \"../short.afp\"\nscenario \"x\" for Short { expect nobody active }\n",
    );
    let said = place.afpc("test --mutate");
    assert!(!said.fails(3, &["E0602"]).err.contains("there are no scenarios"), "{}", said.err);
}

#[test]
fn scenarios_that_all_fail_judge_no_mutant() {
    let place = Place::new();
    place.write("short.afp", SHORT);
    let scenario = "use \"../short.afp\"\nscenario \"x\" for Short { expect end before 1 ms }\n";
    place.write("tests/short.afp", scenario);
    let said = place.afpc("test --mutate");
    said.fails(3, &["short.afp: all scenarios fail on the unchanged plan: fix them first"]);
    assert_eq!(said.out, "");
}

#[test]
fn failures_before_a_stop_are_reported() {
    let place = Place::new();
    place.write(
        "p.afp",
        r#"use std
plan P forever {
    start w
    actor w: Wait(duration = 100 us) { Elapsed -> w }
}
scenario "breaks" for P { never w active  until 10 ms }
scenario "lasts" for P { never end  until 1 h }
"#,
    );
    let mut command = place.command();
    command.args(["test", "p.afp"]).stdout(Stdio::piped()).stderr(Stdio::piped());
    // Both run at once, even on one core.
    let mut child = command.env("RAYON_NUM_THREADS", "2").spawn().unwrap();
    let mut out = BufReader::new(child.stdout.take().unwrap());
    let mut text = String::new();
    out.read_line(&mut text).unwrap();
    let kill = ["-s", "INT", &child.id().to_string()].map(str::to_owned);
    assert!(Command::new("kill").args(kill).status().unwrap().success());
    out.read_to_string(&mut text).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{text}");
    for told in ["─── broken here", "  log: ", "0 passed, 1 failed; 1 of 2, stopped"] {
        assert!(text.contains(told), "no {told:?} in {text}");
    }
}
