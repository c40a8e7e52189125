//! `afpc check --timing`: the table, targets of `afp.toml`, and what the exit codes say.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

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

fn check(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_afpc"))
        .args(["check", "p.afp"])
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

fn project(toml: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("p.afp"), PLAN).unwrap();
    if !toml.is_empty() {
        fs::write(folder.path().join("afp.toml"), toml).unwrap();
    }
    folder
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

#[test]
fn the_table_says_what_a_bound_is_made_of() {
    let folder = project("");
    let output = check(folder.path(), &["--timing"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let table = text(&output.stdout);
    assert!(table.contains("no target: ticks and capacity are not checked"), "{table}");
    let sum = "301.12 ms proved  period 1 ms + response 70 us + interrupt 50 us + stop 300 ms";
    assert!(table.contains(sum), "{table}");
}

#[test]
fn json_has_the_same_for_tools() {
    let folder = project("");
    let output = check(folder.path(), &["--timing", "--json", "--target", "pi"]);
    let line: Value = serde_json::from_str(text(&output.stdout).trim()).unwrap();
    assert_eq!(line["target"], "pi");
    let row = &line["timing"]["supervisors"][0];
    assert_eq!(row["supervisor"], "go.touch");
    assert_eq!(row["response"]["total_ns"], 170_000);
    assert_eq!(row["interruption"]["trust"], "proved");
    assert_eq!(row["interruption"]["total_ns"], 301_220_000);
}

#[test]
fn targets_of_the_project_are_checked_without_being_named() {
    let folder = project("[target.slow]\ntick = \"2 ms\"\ncapacity = 0.01\n");
    let output = check(folder.path(), &[]);
    assert_eq!(output.status.code(), Some(1));
    let errors = text(&output.stderr);
    assert!(errors.contains("error[E0403]") && errors.contains("error[E0404]"), "{errors}");
    let named = check(folder.path(), &["--target", "mcu"]);
    assert_eq!(named.status.code(), Some(0), "{}", text(&named.stderr));
}

#[test]
fn what_is_wrong_with_a_target_is_said_at_its_place() {
    let folder = project("[target.slow]\ntock = 3\n");
    let output = check(folder.path(), &[]);
    assert_eq!(output.status.code(), Some(1));
    let errors = text(&output.stderr);
    assert!(errors.contains("afp.toml:2:1") && errors.contains("tock"), "{errors}");
    let folder = project("");
    let output = check(folder.path(), &["--target", "moon"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("there is no target 'moon'"));
}
