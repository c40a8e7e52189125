//! Talks with the adapter, as data: `tests/dap/*.txt` has a plan, what a client says and what it is told.
//!
//! `--> COMMAND ARGUMENTS` is a request, `tick` lets the run go on until it stands still or ends, `tick 40` for so many
//! milliseconds on the wall. The answers, `<--`, are written by the test with `AFP_BLESS=1`.

mod common;

use std::fs;
use std::path::{Path, PathBuf};

use common::{Client, Texted};

/// A case with the answers that are given now.
fn answered(case: &str) -> String {
    let (plan, talk) = case.split_once("\n---\n").expect("a plan, '---', a talk");
    let mut client = Client::new(Box::new(Texted(plan.to_owned())));
    for line in talk.lines().filter(|line| !line.starts_with("<--")) {
        client.told += line;
        client.told += "\n";
        match line.split_once(' ').unwrap_or((line, "")) {
            ("-->", said) => client.say(said),
            ("tick", "") => client.tick(None),
            ("tick", wall) => client.tick(Some(wall.parse().expect("milliseconds"))),
            _ => {}
        }
    }
    format!("{plan}\n---\n{}", client.told)
}

fn cases() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/dap");
    let files = fs::read_dir(folder).expect("the folder is there");
    let mut paths: Vec<_> = files.map(|file| file.expect("a file").path()).collect();
    paths.sort();
    paths
}

#[test]
fn clients_are_told_what_they_were() {
    let mut wrong = Vec::new();
    for path in cases() {
        let case = fs::read_to_string(&path).expect("a text");
        let now = answered(&case);
        if now == case {
            continue;
        }
        if std::env::var_os("AFP_BLESS").is_some() {
            fs::write(&path, now).expect("it can be written");
        } else {
            let lines = case.lines().zip(now.lines()).find(|(was, is)| was != is);
            wrong.push(format!("{}: {lines:?}", path.display()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
