//! The tests that the page on safety names exist.

use std::fs;

use crate::docs;

/// The files with these tests.
const FILES: [&str; 12] = [
    "crates/afp-pi/tests/control_thread.rs",
    "crates/afp-platform/src/device.rs",
    "crates/afp-run/src/run/armed.rs",
    "crates/afp-run/src/stop.rs",
    "crates/afp-run/tests/ways_out.rs",
    "crates/afp-session/tests/control_thread.rs",
    "crates/afp-session/tests/session/broken.rs",
    "crates/afpc/tests/afpc/deploy/failures.rs",
    "crates/afpc/tests/afpc/ways_out.rs",
    "crates/afpc/tests/afpc/wired.rs",
    "examples/vacuum/board/src/line.rs",
    "examples/vacuum/board/tests/board.rs",
];

#[test]
fn every_way_to_stop_has_a_test() {
    let page = fs::read_to_string(docs().join("safety.md")).unwrap();
    let read = |file| fs::read_to_string(docs().join("..").join(file)).unwrap();
    let tests = FILES.map(read).concat();
    let (_, stops) = page.split_once("\n## ").unwrap();
    let (stops, _) = stops.split_once("## Not stopped").unwrap();
    for point in stops.split("\n- **").skip(1) {
        let words = point.split_once("Test").unwrap_or_else(|| panic!("no test shows: {point}")).1;
        let mut names = words.split('`').skip(1).step_by(2).peekable();
        assert!(names.peek().is_some(), "no test shows: {point}");
        for name in names {
            assert!(tests.contains(&format!("fn {name}(")), "there is no test '{name}'");
        }
    }
}
