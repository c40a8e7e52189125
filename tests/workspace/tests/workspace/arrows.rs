//! Dependencies between crates: the crate map of ARCHITECTURE.md is correct.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use afp_workspace::{built_from, packages, root};

/// The permissions of a row in the map.
#[derive(Debug, PartialEq)]
enum Allowed {
    /// These packages.
    Only(BTreeSet<String>),
    /// Any package.
    All,
}

/// The names in backticks.
fn quoted(cell: &str) -> impl Iterator<Item = &str> {
    cell.split('`').skip(1).step_by(2)
}

/// The rows of the map: a name in the first column, its permitted dependencies in the last.
fn map(page: &str) -> BTreeMap<String, Allowed> {
    let section = page.split("\n## Crates\n").nth(1).unwrap_or_default();
    let section = section.split("\n## ").next().unwrap_or_default();
    let mut map = BTreeMap::new();
    for line in section.lines().filter(|line| line.starts_with("| `")) {
        let cells: Vec<_> = line.trim_matches('|').split('|').map(str::trim).collect();
        let [names, _, needs] = cells.as_slice() else { panic!("three columns: {line}") };
        for name in quoted(names) {
            let allowed = match *needs {
                "what it needs" | "all" => Allowed::All,
                needs => {
                    let names = quoted(needs).filter(|name| name.starts_with("afp"));
                    Allowed::Only(names.map(str::to_owned).collect())
                }
            };
            map.insert(name.trim_end_matches('/').to_owned(), allowed);
        }
    }
    map
}

#[test]
fn every_arrow_is_in_the_crate_map() {
    let map = map(&fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap());
    let packages = packages();
    let mut wrong = Vec::new();
    for (name, package) in packages.iter().filter(|(_, each)| each.folder.starts_with("crates")) {
        match map.get(name) {
            None => wrong.push(format!("'{name}' is not in the map")),
            Some(Allowed::All) => {}
            Some(Allowed::Only(allowed)) => wrong.extend(
                package.needs.difference(allowed).map(|need| format!("'{name}' needs '{need}'")),
            ),
        }
    }
    let rows = map.keys().filter(|name| name.starts_with("afp") && !packages.contains_key(*name));
    wrong.extend(rows.map(|name| format!("there is no '{name}'")));
    assert!(wrong.is_empty(), "ARCHITECTURE.md, \"Crates\", says otherwise: {wrong:#?}");
}

#[test]
fn the_map_is_parsed() {
    let page = "\n## Crates\n\n| crate | what it is | depends on |\n|---|---|---|\n\
        | `afp-a` | of `afp-x` | `afp-b` (feature `load`), `afp-c` |\n| `afp-b`, `b/` | | nothing |\n\
        | `afpc` | | what it needs |\n\n## Next\n| `afp-d` | | all |\n";
    let only = |names: &[&str]| Allowed::Only(names.iter().map(|&name| name.to_owned()).collect());
    let expected = [
        ("afp-a", only(&["afp-b", "afp-c"])),
        ("afp-b", only(&[])),
        ("afpc", Allowed::All),
        ("b", only(&[])),
    ];
    assert_eq!(map(page), expected.map(|(name, row)| (name.to_owned(), row)).into());
}

#[test]
fn only_crates_are_dependencies() {
    let packages = packages();
    for (name, package) in packages.iter().filter(|(_, each)| each.folder.starts_with("crates")) {
        for need in &package.needs {
            let folder = packages.get(need).map(|each| each.folder.as_path());
            let folder = folder.unwrap_or(Path::new("nowhere"));
            assert!(folder.starts_with("crates"), "'{name}' needs '{need}'");
        }
    }
}

/// A change of the former does not rebuild the latter.
#[test]
fn plans_and_robots_are_built_from_no_drawing_editor_or_formatter() {
    let packages = packages();
    for robot in ["afp-macros", "afp-carbot", "afp-std", "afp-navigation", "afp-sim"] {
        let all = built_from(&packages, robot);
        assert!(all.contains("afp-core") || all.contains("afp-dsl"), "{robot}: {all:?}");
        for other in ["afp-draw", "afp-ide", "afp-format"] {
            assert!(packages.contains_key(other), "{other}");
            assert!(!all.contains(other), "'{robot}' is built from '{other}'");
        }
    }
}
