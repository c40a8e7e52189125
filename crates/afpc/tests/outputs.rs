//! Where output goes: through links, into devices, two at once.

#![cfg(unix)]

mod common;

use std::fs::{self, File, Permissions};
use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
use std::process::Stdio;

use common::{Place, said};

const SCENARIO: &str = "use \"p.afp\"\nscenario \"ends\" for P { expect end by OK before 2 s }\n";
const PLAN: &str =
    "use std\nplan P {\n  start w\n  actor w: Wait(duration=1s) {Elapsed->terminate}\n}\n";

fn place() -> Place {
    let place = Place::new();
    place.write("p.afp", PLAN);
    place.afpc("run p.afp --log p.mcap --svg none").succeeds();
    place
}

/// Every command that writes a file, with its output at the end.
const WRITERS: [&str; 7] = [
    "run p.afp --log none --svg",
    "run p.afp --svg none --log",
    "graph p.afp -o",
    "log p.mcap recover -o",
    "log p.mcap --svg",
    "log p.mcap --coverage",
    "test --generate p.afp -o",
];

#[test]
fn links_are_followed() {
    let place = place();
    for writer in WRITERS {
        place.write("far", "old");
        symlink("far", place.path("near")).unwrap();
        place.afpc(&format!("{writer} near")).succeeds();
        assert!(fs::symlink_metadata(place.path("near")).unwrap().is_symlink(), "{writer}");
        assert_ne!(place.bytes("far"), b"old", "{writer}");
        for name in ["near", "far"] {
            fs::remove_file(place.path(name)).unwrap();
        }
        assert_eq!(place.files(), ["p.afp", "p.mcap"], "{writer}");
    }
}

#[test]
fn devices_stay_devices() {
    let place = place();
    for writer in WRITERS {
        place.afpc(&format!("{writer} /dev/null")).succeeds();
        assert!(!fs::metadata("/dev/null").unwrap().is_file(), "{writer}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_told() {
    let place = place();
    for writer in WRITERS {
        place.afpc(&format!("{writer} /dev/full")).fails(1, &["No space left on device"]);
    }
}

#[test]
fn a_formatted_file_keeps_its_names_and_permissions() {
    let place = place();
    fs::set_permissions(place.path("p.afp"), Permissions::from_mode(0o755)).unwrap();
    symlink("p.afp", place.path("link.afp")).unwrap();
    place.afpc("fmt link.afp").succeeds();
    assert!(fs::symlink_metadata(place.path("link.afp")).unwrap().is_symlink());
    let formatted = place.read("p.afp");
    assert!(formatted.contains("    actor w: Wait(duration = 1 s)"), "{formatted}");
    assert_eq!(fs::metadata(place.path("p.afp")).unwrap().mode() & 0o777, 0o755);
    place.write("p.afp", PLAN);
    fs::hard_link(place.path("p.afp"), place.path("hard.afp")).unwrap();
    place.afpc("fmt hard.afp").succeeds();
    assert_eq!((place.read("p.afp"), place.read("hard.afp")), (formatted.clone(), formatted));
}

#[test]
fn two_runs_at_once_each_write_a_whole_log() {
    let place = place();
    let run = ["run", "p.afp", "--svg", "none", "--log", "both.mcap", "--speed", "4x"];
    let runs = [(), ()].map(|()| {
        place.command().args(run).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
    });
    for run in runs {
        said(run.wait_with_output().unwrap()).succeeds();
        place.afpc("log both.mcap doctor").succeeds();
    }
    assert_eq!(place.files(), ["both.mcap", "p.afp", "p.mcap"]);
}

#[test]
#[cfg(target_os = "linux")]
fn what_cannot_be_printed_is_told() {
    let place = place();
    place.write("tests.afp", SCENARIO);
    for command in ["test tests.afp", "test tests.afp --json", "graph p.afp", "log p.mcap"] {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = place.command().args(command.split(' ')).stdout(full).output().unwrap();
        said(output).fails(1, &["cannot write to 'standard output': No space left on device"]);
    }
}

#[test]
fn a_picture_is_what_its_name_says() {
    let place = place();
    for writer in ["run p.afp --log none --svg", "log p.mcap --svg", "graph p.afp -o"] {
        place.afpc(&format!("{writer} a.svg")).succeeds();
        assert!(place.read("a.svg").starts_with("<svg"), "{writer}");
        place.afpc(&format!("{writer} a.PNG")).succeeds();
        assert!(place.bytes("a.PNG").starts_with(b"\x89PNG"), "{writer}");
    }
    place.afpc("run p.afp --svg a.gif").fails(2, &["neither an SVG nor a PNG"]);
}

#[test]
fn nothing_to_do_takes_no_time() {
    let place = Place::new();
    place.write("tests.afp", "use \"p.afp\"\nscenario \"s\" for P { until 1 s }\n");
    let said = place.afpc("test tests.afp");
    said.fails(1, &["p.afp"]);
    assert!(said.out.contains(" 0.0 s simulated"), "{}", said.out);
}
