//! Names of templates occur only in their own crates.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use afp_workspace::root;

use crate::sources::rust_files;

/// Implementations and toolbox files.
const HOMES: [&str; 3] = ["afp-std/", "afp-carbot/", "afp-toolboxes/"];

/// Other files that name templates, each with its reason.
const ALLOWED: [(&str, &str); 8] = [
    ("afp-dsl/src/check/bindings/generic.rs", HELP),
    ("afp-dsl/src/check/formula/elsewhere.rs", HELP),
    ("afp-dsl/src/flow/cycles/count.rs", HELP),
    ("afp-run/src/stop.rs", "a Rust type has the same name"),
    (
        "afp-sim/src/simulation/wall.rs",
        "a figure of the simulated Carbot judges one of its own templates",
    ),
    ("afp-syntax/src/habits.rs", HELP),
    ("afp-syntax/src/habits/sentences.rs", HELP),
    ("afp-syntax/src/parser/elsewhere.rs", HELP),
];
const HELP: &str = "a message shows what to write";

/// The templates of the built-in toolboxes.
fn templates() -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for file in fs::read_dir(root().join("crates/afp-toolboxes/toolboxes")).unwrap() {
        let text = fs::read_to_string(file.unwrap().path()).unwrap();
        for line in text.lines() {
            let words: Vec<_> = line.split(' ').collect();
            if let ["actor" | "supervisor" | "computation", name, ..] = words[..] {
                names.insert(name.to_owned());
            }
        }
    }
    names
}

/// Whether code, without comments and tests, has a template's name in quotes.
fn names_one(text: &str, templates: &BTreeSet<String>) -> bool {
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or(text);
    let mut lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
    lines.any(|line| {
        let mut parts = line.split(['"', '\'', '(']).skip(1);
        line.contains(['"', '\'']) && parts.any(|part| templates.contains(part))
    })
}

fn is_test(file: &Path) -> bool {
    file.components().any(|part| matches!(part.as_os_str().to_str(), Some("tests" | "tests.rs")))
}

#[test]
fn templates_are_named_in_their_own_crates() {
    let (crates, templates) = (root().join("crates"), templates());
    assert!(templates.contains("Count") && templates.contains("WallForward"));
    let mut naming = BTreeSet::new();
    for file in rust_files(&crates) {
        let shown = file.strip_prefix(&crates).unwrap().display().to_string();
        let is_home = HOMES.iter().any(|home| shown.starts_with(home));
        let text = fs::read_to_string(&file).unwrap();
        if !is_home && !is_test(Path::new(&shown)) && names_one(&text, &templates) {
            naming.insert(shown);
        }
    }
    let allowed = ALLOWED.iter().map(|(file, _)| (*file).to_owned()).collect();
    assert_eq!(naming, allowed, "declare a fact in the toolbox, or add the file with its reason");
}

#[test]
fn names_in_comments_and_tests_do_not_count() {
    let templates = BTreeSet::from(["Count".to_owned()]);
    assert!(names_one("let x = \"Count\";", &templates));
    assert!(names_one("\"write 'Count' of 'std'\"", &templates));
    assert!(names_one("\"write 'Count(limit = 3)'\"", &templates));
    let text = "/// \"Count\"\nCounter::Count;\n#[cfg(test)]\nmod tests {\n    \"Count\"\n}\n";
    assert!(!names_one(text, &templates));
}
