//! The crates of the control thread take no lock: another thread could have it.

use std::fs;

use afp_workspace::root;

use crate::sources::rust_files;

/// The crates whose code runs on the control thread of a real robot.
const CRATES: [&str; 9] = [
    "afp-carbot",
    "afp-core",
    "afp-drive",
    "afp-pi",
    "afp-platform",
    "afp-session",
    "afp-std",
    "afp-types",
    "afp-wire",
];
const LOCKS: [&str; 4] = ["Mutex", "RwLock", "Condvar", "mpsc"];

/// Names a sample that is wrong, which ends the run.
const ALLOWED: [&str; 1] = ["crates/afp-session/src/sampling.rs"];

#[test]
fn the_control_thread_takes_no_lock() {
    let root = root();
    let mut found = Vec::new();
    for path in
        CRATES.iter().flat_map(|name| rust_files(&root.join("crates").join(name).join("src")))
    {
        let text = fs::read_to_string(&path).unwrap();
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        let name = path.strip_prefix(&root).unwrap().display().to_string();
        if LOCKS.iter().any(|lock| code.contains(lock)) && !name.ends_with("tests.rs") {
            found.push(name);
        }
    }
    assert_eq!(found, ALLOWED);
}
