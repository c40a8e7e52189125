//! Runs that are stopped or killed.

use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};

use crate::common::{Place, said};

/// Starts a run in real time, acts on it, and returns its exit code and the rest of its output.
fn interrupted(place: &Place, act: impl FnOnce(u32)) -> (Option<i32>, String) {
    let run = ["run", "wall_following.afp", "--speed", "1x", "--json"];
    let outputs = ["--log", "a.mcap", "--svg", "a.svg"];
    let mut command = place.command();
    command.args(run).args(outputs).stdin(Stdio::null()).stdout(Stdio::piped());
    let mut child = command.spawn().unwrap();
    let mut out = BufReader::new(child.stdout.take().unwrap());
    let mut text = String::new();
    out.read_line(&mut text).unwrap();
    // The log needs some content.
    std::thread::sleep(std::time::Duration::from_millis(800));
    act(child.id());
    out.read_to_string(&mut text).unwrap();
    (child.wait().unwrap().code(), text)
}

fn signal(name: &str, process: u32) {
    let sent = Command::new("kill").args(["-s", name, &process.to_string()]).status();
    assert!(sent.unwrap().success());
}

#[test]
fn the_log_of_a_killed_run_is_kept() {
    let place = Place::with_plan();
    interrupted(&place, |process| signal("KILL", process));
    place.afpc("log a.mcap").fails(1, &["use the unfinished log 'a.mcap.part'"]);
    let said = place.afpc("run wall_following.afp --until 100ms --log a.mcap --svg none");
    assert!(said.succeeds().err.contains("'afpc log a.2.mcap.part recover'"), "{}", said.err);
    assert_eq!(place.files(), ["a.2.mcap.part", "a.mcap", "wall_following.afp"]);
    let saved = place.afpc("log a.2.mcap.part recover");
    assert!(saved.succeeds().out.ends_with("a.2.recovered.mcap\n"), "{}", saved.out);
    assert_eq!(place.afpc("log a.2.recovered.mcap doctor").succeeds().out, "sound\n");
}

/// The system's limit of the size of files stops the run, not the process.
#[test]
fn a_limit_of_the_size_of_files_ends_a_run_in_order() {
    let place = Place::with_plan();
    let mut shell = Command::new("sh");
    shell.args([
        "-c",
        "ulimit -f 20; exec \"$AFPC\" run wall_following.afp --until 20s --log a.mcap --svg none",
    ]);
    shell.env("AFPC", env!("CARGO_BIN_EXE_afpc")).current_dir(place.path(""));
    let said = said(shell.output().unwrap());
    said.fails(1, &["cannot write the log 'a.mcap': File too large"]);
    assert_eq!(said.last_json()["summary"]["stopped_by"], "signal");
}

#[test]
fn signals_end_a_run_cleanly() {
    for (name, exit) in [("INT", 0), ("TERM", 143), ("HUP", 129), ("XFSZ", 153), ("VTALRM", 154)] {
        let place = Place::with_plan();
        let (code, out) = interrupted(&place, |process| signal(name, process));
        assert_eq!(code, Some(exit), "{out}");
        assert!(out.contains("\"kind\":\"stop_requested\""), "{out}");
        assert!(out.contains("\"component\":\"searchFirstWall\""), "{out}");
        let last: serde_json::Value = serde_json::from_str(out.lines().last().unwrap()).unwrap();
        assert_eq!(last["summary"]["stopped_by"], "signal");
        assert_eq!(place.files(), ["a.mcap", "a.svg", "wall_following.afp"]);
        assert_eq!(place.afpc("log a.mcap doctor").succeeds().out, "sound\n");
        // The repeated run stops at the same time.
        let again = place.afpc("run --again a.mcap --json --log none --svg none");
        assert_eq!(again.succeeds().last_json()["summary"]["trace"], last["summary"]["trace"]);
    }
}
