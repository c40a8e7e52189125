//! Arrows between the files of a crate point down: no file reaches itself.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;

use afp_workspace::modules::{Arrows, Sources, arrows, circles};
use afp_workspace::root;

use crate::sources::rust_files;

/// The numbers of files in circles. Each may only fall; a crate that is not in the table has none.
const IN_CIRCLES: &[(&str, usize)] = &[];

/// The crates that must stay without circles.
const WITHOUT: [&str; 5] = ["afp-core", "afp-draw", "afp-dsl", "afp-session", "afp-syntax"];

/// The arrows of each crate.
fn crates() -> BTreeMap<String, Arrows> {
    let folders = fs::read_dir(root().join("crates")).unwrap().map(|entry| entry.unwrap().path());
    let graph = |folder: std::path::PathBuf| {
        let name = folder.file_name().unwrap().to_str().unwrap().to_owned();
        let src = folder.join("src");
        let source = |path: std::path::PathBuf| {
            let below = path.strip_prefix(&src).unwrap().to_str().unwrap().replace('\\', "/");
            (below, fs::read_to_string(&path).unwrap())
        };
        let sources: Sources = rust_files(&src).into_iter().map(source).collect();
        (name, arrows(&sources))
    };
    folders.filter(|folder| folder.join("src/lib.rs").exists()).map(graph).collect()
}

fn in_circles(arrows: &Arrows) -> usize {
    circles(arrows).iter().map(|circle| circle.len()).sum()
}

/// The circles of a crate with the names along their arrows.
fn shown(name: &str, arrows: &Arrows) -> String {
    let mut text = format!("{name}: {} files in circles\n", in_circles(arrows));
    for circle in circles(arrows) {
        writeln!(text, "  a circle of {} files:", circle.len()).unwrap();
        let is_inside =
            |(from, to): &(String, String)| circle.contains(&**from) && circle.contains(&**to);
        for ((from, to), names) in arrows.iter().filter(|(arrow, _)| is_inside(arrow)) {
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            writeln!(text, "    {from} -> {to}: {}", names.join(", ")).unwrap();
        }
    }
    text
}

#[test]
fn modules_have_no_more_circles_than_before() {
    let crates = crates();
    let show = std::env::var("AFP_CIRCLES").unwrap_or_default();
    for (name, arrows) in crates.iter().filter(|(name, _)| show == "all" || show == **name) {
        print!("{}", shown(name, arrows));
    }
    let table: BTreeMap<_, _> = IN_CIRCLES.iter().copied().collect();
    let mut wrong = String::new();
    for (name, arrows) in &crates {
        let (now, most) = (in_circles(arrows), table.get(&**name).copied().unwrap_or(0));
        if now > most {
            write!(wrong, "at most {most} are allowed\n{}", shown(name, arrows)).unwrap();
        } else if now < most {
            writeln!(wrong, "{name}: write {now} instead of {most}").unwrap();
        }
    }
    assert!(wrong.is_empty(), "the table 'IN_CIRCLES' differs:\n{wrong}");
}

#[test]
fn these_crates_stay_without_circles() {
    for name in WITHOUT {
        assert!(root().join("crates").join(name).exists(), "there is no '{name}'");
        assert!(IN_CIRCLES.iter().all(|(other, _)| *other != name), "'{name}' must have none");
    }
}
