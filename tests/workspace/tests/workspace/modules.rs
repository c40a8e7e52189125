//! Arrows between the files of a crate point down: no file reaches itself.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;

use afp_workspace::modules::{Arrows, Sources, arrows, circles};
use afp_workspace::root;

use crate::sources::rust_files;

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
fn modules_have_no_circles() {
    let crates = crates();
    assert!(crates.contains_key("afp-core"), "no crates: {:?}", crates.keys());
    let wanted = std::env::var("AFP_CIRCLES").unwrap_or_default();
    let mut found = String::new();
    for (name, arrows) in &crates {
        let circles = shown(name, arrows);
        if wanted == "all" || wanted == *name {
            print!("{circles}");
        }
        if in_circles(arrows) > 0 {
            found += &circles;
        }
    }
    assert!(found.is_empty(), "move what they share into a lower file:\n{found}");
}
