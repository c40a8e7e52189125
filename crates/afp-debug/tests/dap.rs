//! Talks with the adapter, as data: `tests/dap/*.txt` has a plan, what a client says and what it is told.
//!
//! `--> COMMAND ARGUMENTS` is a request, `tick` lets the run go on until it stands still or ends, `tick 40` for so many
//! milliseconds on the wall. The answers, `<--`, are written by the test with `AFP_BLESS=1`.

mod common;

use std::fs;
use std::path::{Path, PathBuf};

use common::{Clients, Texted};

/// A case with the answers that are given now.
fn answered(case: &str) -> String {
    let (plan, talk) = case.split_once("\n---\n").expect("a plan, '---', a talk");
    let mut clients = Clients::new(Box::new(Texted(plan.to_owned())));
    for line in talk.lines().filter(|line| !line.starts_with('<')) {
        clients.told += line;
        clients.told += "\n";
        match line.split_once(' ').unwrap_or((line, "")) {
            ("-->", said) => clients.say(said),
            ("tick", "") => clients.tick(None),
            ("tick", wall) => clients.tick(Some(wall.parse().expect("milliseconds"))),
            ("lose", number) => clients.lose(number.parse().expect("a client")),
            (arrow, said) => {
                let number = arrow.strip_prefix('-').and_then(|rest| rest.strip_suffix('>'));
                if let Some(number) = number.and_then(|number| number.parse().ok()) {
                    clients.say_as(number, said);
                }
            }
        }
    }
    format!("{plan}\n---\n{}", clients.told)
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
