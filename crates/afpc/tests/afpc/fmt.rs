//! `afpc fmt`: files in place, standard input, `--check`, and the exit codes.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

const UGLY: &str = "plan P {\n  start a // first\n  actor a: A {D->a}\n}\n";
const PRETTY: &str = "plan P {\n    start a // first\n    actor a: A { D -> a }\n}\n";
const BROKEN: &str = "plan P { start }\n";

fn fmt(arguments: &[&str], folder: &Path, input: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_afpc"))
        .arg("fmt")
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    child.wait_with_output().unwrap()
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

#[test]
fn files_are_formatted_in_place_and_invalid_files_are_not_changed() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::write(path("ugly.afp"), UGLY).unwrap();
    fs::write(path("broken.afp"), BROKEN).unwrap();
    let output = fmt(&["broken.afp", "missing.afp", "ugly.afp"], folder.path(), "");
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(fs::read_to_string(path("ugly.afp")).unwrap(), PRETTY);
    assert_eq!(fs::read_to_string(path("broken.afp")).unwrap(), BROKEN);
    let errors = text(&output.stderr);
    assert!(errors.contains("broken.afp:1:16"), "{errors}");
    assert!(errors.contains("broken.afp: not formatted"), "{errors}");
    assert!(errors.contains("cannot read the plan 'missing.afp'"), "{errors}");
    assert_eq!(fmt(&["ugly.afp"], folder.path(), "").status.code(), Some(0));
}

#[test]
fn check_shows_the_difference_and_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ugly.afp");
    fs::write(&path, UGLY).unwrap();
    let output = fmt(&["--check", "ugly.afp"], folder.path(), "");
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(fs::read_to_string(&path).unwrap(), UGLY);
    let shown = text(&output.stdout);
    assert!(shown.starts_with("--- ugly.afp\n+++ ugly.afp (formatted)\n@@"), "{shown}");
    assert!(shown.contains("-  actor a: A {D->a}\n"), "{shown}");
    assert!(shown.contains("+    actor a: A { D -> a }\n"), "{shown}");
    fs::write(&path, PRETTY).unwrap();
    let output = fmt(&["--check", "ugly.afp"], folder.path(), "");
    assert_eq!((output.status.code(), text(&output.stdout)), (Some(0), ""));
}

#[test]
fn line_ends_and_byte_order_marks_stay() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.afp");
    let [ugly, pretty] = [UGLY, PRETTY].map(|text| text.replace('\n', "\r\n"));
    for mark in ["", "\u{feff}"] {
        fs::write(&path, format!("{mark}{ugly}")).unwrap();
        assert_eq!(fmt(&["a.afp"], folder.path(), "").status.code(), Some(0));
        assert_eq!(fs::read_to_string(&path).unwrap(), format!("{mark}{pretty}"));
        let output = fmt(&["--check", "a.afp"], folder.path(), "");
        assert_eq!((output.status.code(), text(&output.stdout)), (Some(0), ""));
    }
    fs::write(&path, PRETTY.replacen('\n', "\r\n", 1)).unwrap();
    let output = fmt(&["--check", "a.afp"], folder.path(), "");
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(
        text(&output.stderr),
        "a.afp: mixed line endings: 'afpc fmt' uses the line ending of the first line\n"
    );
    fmt(&["a.afp"], folder.path(), "");
    assert_eq!(fs::read_to_string(&path).unwrap(), pretty);
}

#[test]
fn standard_input_goes_to_standard_output() {
    let folder = tempfile::tempdir().unwrap();
    let output = fmt(&["-"], folder.path(), UGLY);
    assert_eq!((output.status.code(), text(&output.stdout)), (Some(0), PRETTY));
    let output = fmt(&["-"], folder.path(), BROKEN);
    assert_eq!((output.status.code(), text(&output.stdout)), (Some(1), ""));
    assert!(text(&output.stderr).contains("<stdin>: not formatted"));
    assert_eq!(fmt(&["--check", "-"], folder.path(), UGLY).status.code(), Some(1));
    assert_eq!(fmt(&[], folder.path(), "").status.code(), Some(2));
}
