//! `afpc sweep`: repeatable rows, tables, and sweeps that are killed and continued.

use std::process::Stdio;
use std::thread;
use std::time::Duration;

use crate::common::{Place, Said};
use serde_json::Value;

/// The columns of a table, without the durations of the runs.
fn rows(place: &Place, name: &str) -> Vec<String> {
    let text = place.read(name);
    text.lines().map(|line| line.rsplit_once(',').unwrap().0.to_owned()).collect()
}

fn objects(said: &Said) -> Vec<Value> {
    said.out.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn every_row_is_a_repeatable_run() {
    let place = Place::with_plan();
    let grid = "--seeds 3..5 --vary walldist=20cm..40cm:20cm --vary world.robot.charge=0.5,1";
    let sweep = format!("sweep wall_following.afp {grid} --world random:4..6 --until 8s");
    let said = place.afpc(&format!("{sweep} --json -o all/"));
    said.succeeds();
    assert_eq!(said.err, "");
    let all = objects(&said);
    let (summary, runs) = all.split_last().unwrap();
    assert_eq!((runs.len(), &summary["summary"]["runs"]), (16, &16.into()));
    for run in [0, 5, 15] {
        let command = runs[run]["command"].as_str().unwrap().strip_prefix("afpc ").unwrap();
        let again = place.afpc(&format!("{command} --json --log none --svg none"));
        let summary = &again.last_json()["summary"];
        for key in ["trace", "time_s", "distance_m"] {
            assert_eq!(summary[key], runs[run][key], "{command}");
        }
    }
    let table = rows(&place, "all/outcomes.csv");
    assert!(table[0].starts_with("run,world,seed,walldist,walldist_si,world.robot.charge,"));
    assert!(table[16].starts_with("15,random:5,4,40cm,0.4,1,1.0,"), "{}", table[16]);
    #[cfg(feature = "parquet")]
    assert!(place.bytes("all/outcomes.parquet").starts_with(b"PAR1"));
    let alone = place.afpc(&format!("{sweep} --json --jobs 1 -o one.csv"));
    assert_eq!((alone.out, rows(&place, "one.csv")), (said.out, table));
}

#[test]
fn a_plan_that_looks_like_an_option_can_run_again() {
    let place = Place::new();
    place.write("-n.afp", crate::common::WALL_FOLLOWING);
    let said = place.afpc("sweep --until 100ms --json -- -n.afp");
    let command = objects(said.succeeds())[0]["command"].as_str().unwrap().to_owned();
    let again =
        place.afpc(&format!("{} --log none --svg none", command.strip_prefix("afpc ").unwrap()));
    again.succeeds();
}

#[test]
fn strings_may_be_quoted() {
    let place = Place::new();
    let text = r#"use std
plan P {
    in mode: string = "z"
    start say
    computation say: Log(value = mode) { Done -> terminate }
}
"#;
    place.write("p.afp", text);
    let said = place.afpc(r#"sweep p.afp --vary mode="x,y","","z" --json -o p.csv"#);
    let runs = objects(said.succeeds());
    assert_eq!(runs.len(), 4, "{}", said.out);
    for (run, text) in ["x,y", "", "z"].into_iter().enumerate() {
        assert_eq!(runs[run]["values"]["mode"]["text"], text);
        // Parsed like in a shell.
        let command = runs[run]["command"].as_str().unwrap().replace('\'', "");
        let command = command.strip_prefix("afpc ").unwrap();
        let again = place.afpc(&format!("{command} --log none --svg none"));
        let told = format!("say: value = {text:?}");
        assert!(again.succeeds().out.contains(&told), "no {told} in {}", again.out);
    }
}

#[test]
fn equal_values_in_a_different_notation_are_the_same_sweep() {
    let place = Place::with_plan();
    let sweep = |values: &str| {
        place
            .afpc(&format!("sweep wall_following.afp --vary walldist={values} --until 1s -o a.csv"))
    };
    sweep("30cm,0.4m").succeeds();
    let said = sweep("0.3m,400mm");
    assert!(said.succeeds().err.contains("all 2 runs are done"), "{}", said.err);
    sweep("0.3m,401mm").fails(2, &["walldist = 0.3 0.4; this is", "walldist = 0.3 0.401"]);
}

#[test]
fn runs_that_never_started_have_no_measures() {
    let place = Place::with_plan();
    let axis = "--vary world.robot.pose_m_deg.0=2.1m,3m --until 1s";
    let said = place.afpc(&format!("sweep wall_following.afp {axis} --json -o a.csv"));
    let runs = objects(&said);
    assert_eq!(runs[1]["ending"], "not_started", "{}", said.out);
    for measure in ["time_s", "distance_m", "collisions", "interruptions", "deadline_misses"] {
        assert!(runs[0][measure].is_number() && runs[1][measure].is_null(), "{}", said.out);
    }
    let table = rows(&place, "a.csv");
    let names: Vec<_> = table[0].split(',').collect();
    let cells: Vec<_> = table[2].split(',').collect();
    let time = names.iter().position(|name| *name == "time_s").unwrap();
    assert_eq!(cells[time..time + 6], [""; 6], "{}", table[2]);
}

#[test]
fn a_sweep_presses_and_breaks_like_a_run() {
    let place = Place::with_plan();
    let asked = "--press touch@2s --fail wheels.slip=0.3@3s..5s";
    let said =
        place.afpc(&format!("sweep wall_following.afp --seeds 2..4 {asked} --until 6s --json"));
    let runs = objects(said.succeeds());
    let command = runs[1]["command"].as_str().unwrap().strip_prefix("afpc ").unwrap();
    assert!(command.contains(asked), "{command}");
    let again = place.afpc(&format!("{command} --json --log none --svg none")).last_json();
    assert_eq!(again["summary"]["trace"], runs[1]["trace"]);
    assert_eq!(again["summary"]["requests"][0]["request"], "press touch.touch");
    place
        .afpc("sweep wall_following.afp --fail wheels.gone@1s")
        .fails(2, &["'wheels' cannot be 'gone'; it can be slip"]);
}

#[test]
#[cfg(target_os = "linux")]
fn an_unwritable_table_does_not_hide_the_summary() {
    let place = Place::with_plan();
    std::os::unix::fs::symlink("/dev/full", place.path("t.csv")).unwrap();
    let sweep = "sweep wall_following.afp --until 100ms -o t.csv";
    let full = "cannot write the table 't.csv'";
    let said = place.afpc(&format!("{sweep} --json"));
    said.fails(1, &[full]);
    assert_eq!(said.last_json()["summary"]["runs"], 1);
    let said = place.afpc(sweep);
    assert!(said.fails(1, &[full]).out.contains("1 of 1 runs"), "{}", said.out);
    assert!(!said.out.contains("table:"), "{}", said.out);
}

#[test]
fn duplicate_values_are_refused() {
    let place = Place::with_plan();
    place.write("w.toml", "version = 1\n[robot]\npose_m_deg = [1, 1, 0]\n");
    for (twice, what) in [
        ("--seeds 1,1", "the seed 1 is given twice"),
        ("--vary walldist=20cm,30cm,20cm", "'walldist=20cm' is given twice"),
        ("--vary walldist=20cm,0.2m", "'walldist=0.2m' is given twice"),
        ("--vary world.robot.charge=0.5,0.50", "'world.robot.charge=0.50' is given twice"),
        ("--world random:1 --world random:0..3", "the world 'random:1' is given twice"),
        ("--world w.toml --world ./w.toml", "the world './w.toml' is given twice"),
    ] {
        place.afpc(&format!("sweep wall_following.afp --until 1s {twice}")).fails(2, &[what]);
    }
    // Numbers that differ only as integers.
    place.write("count.afp", "use std\nplan Count {\n    in n: int = 1\n    in seed: int = 1\n    start a\n    actor a: Wait(duration = 1 ms) { Elapsed -> terminate }\n}\n");
    let large = "--vary n=9007199254740992,9007199254740993 --vary seed=5";
    place.afpc(&format!("sweep count.afp {large} --output all.csv")).succeeds();
    let rows = rows(&place, "all.csv");
    assert!(rows[0].contains(",seed,n,n_si,in.seed,in.seed_si,"), "{rows:?}");
    assert!(rows[2].contains(",0,9007199254740993,"), "{rows:?}");
}

#[test]
fn values_of_the_world_count_together() {
    let place = Place::with_plan();
    // Only the second value puts the robot into the sofa.
    let vary = "--vary world.robot.pose_m_deg.1=4.5m --vary world.robot.pose_m_deg.0=5m";
    place.afpc(&format!("sweep wall_following.afp {vary} --until 1s")).succeeds();
    let alone = "--vary world.robot.pose_m_deg.1=4.5m";
    let said = place.afpc(&format!("sweep wall_following.afp {alone} --until 1s"));
    said.fails(1, &["the robot starts inside of 'sofa'"]);
}

#[test]
fn a_killed_sweep_continues() {
    let place = Place::with_plan();
    let sweep = "sweep wall_following.afp --seeds 0..40 --vary walldist=20cm,30cm --until 10s -o";
    place.afpc(&format!("{sweep} whole.csv")).succeeds();
    let journal = "killed.csv.journal";
    let kept = || if place.exists(journal) { place.read(journal).lines().count() } else { 0 };
    let mut kills = 0;
    for _ in 0..6 {
        let enough = kept() + 5;
        let mut command = place.command();
        command.args(sweep.split_whitespace()).arg("killed.csv");
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        while kept() < enough && child.try_wait().unwrap().is_none() {
            thread::sleep(Duration::from_millis(2));
        }
        kills += u32::from(child.try_wait().unwrap().is_none());
        child.kill().unwrap();
        child.wait().unwrap();
    }
    assert!(kills > 0, "the machine is too fast for this test");
    // The last line did not reach the file.
    let text = place.read(journal);
    place.write(journal, &text[..text.len() - 5]);
    let said = place.afpc(&format!("{sweep} killed.csv"));
    said.succeeds();
    assert_eq!(rows(&place, "killed.csv"), rows(&place, "whole.csv"));
    assert_eq!(kept(), 81, "a header and every run once");
    let again = place.afpc(&format!("{sweep} killed.csv"));
    again.succeeds();
    assert_eq!(again.out, said.out);
    assert!(again.err.contains("all 80 runs are done"), "{}", again.err);
}

#[test]
#[cfg(unix)]
fn a_stopped_sweep_keeps_its_results() {
    let place = Place::with_plan();
    let sweep = "sweep wall_following.afp --seeds 0..60 --until 10s --jobs 1 -o stopped.csv";
    let mut command = place.command();
    command.args(sweep.split_whitespace()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = command.spawn().unwrap();
    while !place.exists("stopped.csv.journal") || rows(&place, "stopped.csv.journal").len() < 3 {
        thread::sleep(Duration::from_millis(5));
    }
    let pid = child.id().to_string();
    assert!(std::process::Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
    let said = crate::common::said(child.wait_with_output().unwrap());
    said.fails(130, &[]);
    assert!(said.out.contains("of 60 runs, 0 failed, stopped; the same command continues"));
    let done = rows(&place, "stopped.csv").len() - 1;
    assert!((2..60).contains(&done), "{done}");
    let more = place.afpc(&sweep.replace("--jobs 1", "--json"));
    more.succeeds();
    assert!(more.err.contains(&format!("continuing: {done} of 60 runs are done")), "{}", more.err);
    assert_eq!(objects(&more).len(), 61);
}

#[test]
fn a_journal_of_another_sweep_is_not_changed() {
    let place = Place::with_plan();
    let sweep = "sweep wall_following.afp --until 1s -o a.csv";
    place.afpc(&format!("{sweep} --seeds 0..2")).succeeds();
    let told = ["'a.csv.journal' belongs to another sweep", "started with seeds 0..2", "--restart"];
    place.afpc(&format!("{sweep} --seeds 0..3")).fails(2, &told);
    place.afpc(&format!("{sweep} --seeds 0..3 --restart")).succeeds();
    assert_eq!(rows(&place, "a.csv").len(), 4);
    place.write("wall_following.afp", &crate::common::WALL_FOLLOWING.replace("30 cm", "31 cm"));
    let told = ["the plan has changed since"];
    place.afpc(&format!("{sweep} --seeds 0..3")).fails(2, &told);
}

#[test]
fn each_failure_has_a_command() {
    let place = Place::with_plan();
    let said = place.afpc(
        "sweep wall_following.afp --until 1s --vary world.robot.pose_m_deg.0=2.1m,2.9m,3m -o a.csv",
    );
    said.fails(3, &[]);
    for text in [
        "1 time was up in searchFirstWall",
        "2 not started: the robot starts inside of 'low step'",
        "again: afpc run wall_following.afp --seed 0 --set world.robot.pose_m_deg.0=2.9m --until 1s",
        "3 of 3 runs, 2 failed",
        "table: a.csv",
    ] {
        assert!(said.out.contains(text), "no {text:?} in {}", said.out);
    }
}

#[test]
fn unknown_names_to_vary_are_reported_before_the_runs() {
    let place = Place::with_plan();
    for (arguments, texts) in [
        ("--vary nope=1", ["no entry 'nope'", "'walldist' (length)"]),
        ("--vary walldist=20deg..40deg", ["not a length", "a number and a unit"]),
        ("--vary walldist=1m --vary walldist=2m", ["varied twice", "vary it once"]),
        ("--vary world.robot.charg=1", ["has no 'charg'", "write 'charge'"]),
        ("--vary walldist=20cm..1m", ["same unit", "--vary"]),
        ("--seeds 0..99999999999", ["runs, not 99999999999", "give fewer seeds"]),
        ("--seeds 5..5", ["'5..5' has no seeds", "--seeds"]),
        ("-o a.txt", ["unsupported format '.txt'", "'.csv' or '.parquet'"]),
        #[cfg(not(feature = "parquet"))]
        ("-o a.parquet", ["built without Parquet", "--features parquet"]),
    ] {
        let said = place.afpc(&format!("sweep wall_following.afp {arguments}"));
        assert!(matches!(said.code, 1 | 2), "{said:#?}");
        said.fails(said.code, &texts);
    }
    assert_eq!(place.files(), ["wall_following.afp"]);
}
