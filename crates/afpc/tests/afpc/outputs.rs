//! Names of output files, and files that are written again.

use std::fs::{self, Permissions};
use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};

use crate::common::Place;

const PLAN: &str =
    "use std\nplan P {\n  start w\n  actor w: Wait(duration=1s) {Elapsed->terminate}\n}\n";

fn place() -> Place {
    let place = Place::new();
    place.write("p.afp", PLAN);
    place.afpc("run p.afp --log p.mcap --svg none").succeeds();
    place
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
fn the_extension_selects_the_format_of_a_picture() {
    let place = place();
    for writer in ["run p.afp --log none --svg", "log p.mcap --svg", "graph p.afp -o"] {
        place.afpc(&format!("{writer} a.svg")).succeeds();
        assert!(place.read("a.svg").starts_with("<svg"), "{writer}");
        place.afpc(&format!("{writer} a.PNG")).succeeds();
        assert!(place.bytes("a.PNG").starts_with(b"\x89PNG"), "{writer}");
    }
    place.afpc("run p.afp --svg a.gif").fails(2, &["neither an SVG nor a PNG"]);
    place.afpc("graph p.afp -o a.gif").fails(2, &["unsupported format '.gif'", "'.svg'"]);
    place.afpc("graph p.afp -o a.gif --format png").succeeds();
    assert!(place.bytes("a.gif").starts_with(b"\x89PNG"));
}

#[test]
fn an_empty_task_takes_no_time() {
    let place = Place::new();
    place.write("tests.afp", "use \"p.afp\"\nscenario \"s\" for P { until 1 s }\n");
    let said = place.afpc("test tests.afp");
    said.fails(1, &["p.afp"]);
    assert!(said.out.contains(" 0.0 s simulated"), "{}", said.out);
}

#[test]
fn no_output_replaces_an_input_or_another_output() {
    let place = place();
    place.write("part.afp", &place.read("p.afp"));
    let uses = "use \"part.afp\"\nplan Uses { start all subplan all: P { OK -> terminate } }\n";
    place.write("uses.afp", uses);
    let before = ["p.afp", "p.mcap", "part.afp"].map(|name| place.bytes(name));
    let files = place.files();
    for command in [
        "graph p.afp -o ./p.afp --format svg",
        "test --generate p.afp -o p.afp",
        "run p.afp --svg none --log p.afp",
        "run uses.afp --svg none --log ./part.afp",
        "run --again p.mcap --svg none --log ./p.mcap",
        "run p.afp --log both.svg --svg ./both.svg",
        "log p.mcap recover -o ./p.mcap",
        "log p.mcap --svg both.svg --coverage both.svg",
    ] {
        place.afpc(command).fails(2, &["help: give "]);
        let now = ["p.afp", "p.mcap", "part.afp"].map(|name| place.bytes(name));
        assert_eq!(now, before, "{command}");
        assert_eq!(place.files(), files, "{command}");
    }
}

#[test]
fn a_repeated_log_is_kept_in_the_folder_of_logs() {
    let place = place();
    place.afpc("run p.afp --svg none").succeeds();
    let (log, again) = ("target/afp/runs/p.mcap", "target/afp/runs/p.again.mcap");
    let first = place.bytes(log);
    let said = place.afpc(&format!("run --again {log} --svg none"));
    said.succeeds();
    assert_eq!(place.bytes(log), first);
    assert!(place.exists(again) && said.out.contains(again), "{}", said.out);
}
