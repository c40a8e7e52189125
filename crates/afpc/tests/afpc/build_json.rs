//! `afpc build --json` and `afpc check --json`: every diagnostic as an object, and the build result
//! last.

use std::fs::{self, File, Permissions};
use std::os::unix::fs::PermissionsExt;
use std::process::{Command, Stdio};

use crate::common::{Place, Said, WALL_FOLLOWING, said};
use serde_json::{Value, json};

/// A plan with a warning: an unused entry.
const PLAN: &str = "use carbot

plan P {
    start go
    var unused: length

    actor go: Forward(distance = 10 cm) {
        ForwardSuccessful -> terminate
    }
}
";

fn place() -> Place {
    let place = Place::new();
    place.write("p.afp", PLAN);
    place
}

/// A call in which cargo is a script.
fn with_cargo(place: &Place, arguments: &str, cargo: &str) -> Said {
    said(calling(place, arguments, cargo).output().unwrap())
}

fn calling(place: &Place, arguments: &str, cargo: &str) -> Command {
    let (path, mut command) = (place.path("bin/cargo"), place.command());
    place.write("bin/cargo", &format!("#!/bin/sh\n{cargo}\n"));
    fs::set_permissions(&path, Permissions::from_mode(0o755)).unwrap();
    command.args(arguments.split_whitespace()).env("CARGO", path);
    command
}

/// The objects of a call, the summary last.
#[track_caller]
fn objects(said: &Said) -> (Vec<Value>, Value) {
    let read = |line| serde_json::from_str::<Value>(line).unwrap();
    let mut all: Vec<_> = said.out.lines().map(read).collect();
    let mut summary = all.pop().unwrap();
    (all, summary["summary"].take())
}

fn at(object: &Value) -> (&str, u64, u64) {
    let place = &object["place"];
    let number = |key: &str| place[key].as_u64().unwrap();
    (place["file"].as_str().unwrap(), number("line"), number("column"))
}

#[test]
fn build_and_check_report_the_same_errors_of_a_plan() {
    let place = place();
    for (text, code) in [
        (WALL_FOLLOWING.replace("walldist:  length = 30 cm", "walldist:  length = 30"), "E0203"),
        ("plan Empty { }".to_owned(), "E0215"),
    ] {
        place.write("a.afp", &text);
        let (checked, said) = (place.afpc("check a.afp --json"), place.afpc("build a.afp --json"));
        said.fails(1, &[]);
        let (all, summary) = objects(&said);
        let told: String = all.iter().map(|object| format!("{object}\n")).collect();
        assert_eq!((&*told, &*said.err), (&*checked.out, ""));
        assert!(all.iter().any(|object| object["code"] == code), "{told}");
        let nothing = json!({ "plan": null, "built": false, "folder": null, "binary": null });
        assert_eq!(summary, nothing);
    }
}

#[test]
fn warnings_come_first_and_a_good_build_names_its_files() {
    let place = place();
    let cargo = "echo '{\"executable\":\"/there/p\"}'; echo compiling >&2";
    let warning = place.afpc("check p.afp --json").out;
    let said = with_cargo(&place, "build p.afp --json", cargo);
    said.succeeds();
    let (all, summary) = objects(&said);
    assert_eq!((all.len(), format!("{}\n", all[0])), (1, warning));
    assert_eq!((&all[0]["severity"], at(&all[0]).0), (&json!("warning"), "p.afp"));
    let folder = place.path("").canonicalize().unwrap().join("target/afp/p");
    let built =
        |binary: Value| json!({ "plan": "P", "built": true, "folder": folder, "binary": binary });
    assert_eq!(summary, built(json!("/there/p")));
    assert_eq!(said.err, "generated target/afp/p\ncompiling\n");
    let library = with_cargo(&place, "build p.afp --lib --json", "true");
    assert_eq!(objects(library.succeeds()).1, built(Value::Null));
    // Without '--json', nothing changes.
    let said = with_cargo(&place, "build p.afp", cargo);
    assert_eq!(said.succeeds().out, "/there/p\n");
    assert!(said.err.contains("warning[E"), "{}", said.err);
}

/// Errors that only a build finds: exit code, part of the message, and the place or the help.
const OF_BUILDS: &[(&str, &str, i32, &str, &str)] = &[
    ("[target.host]\ncapacity = 0.0001\n", "p.afp", 1, "'host'", "p.afp"),
    ("[afp]\npath = \"x\"\nversion = \"1\"\n", "p.afp", 1, "exactly one of", "afp.toml"),
    ("[robot]\ncrate = 1\n", "p.afp", 1, "", "afp.toml"),
    ("", "p.afp --target mcu", 2, "is not available yet", "name 'host'"),
    ("", "missing.afp", 1, "cannot read the plan 'missing.afp'", ""),
    ("", "p.afp -o mine", 2, "'mine' contains a crate that 'afpc' did not generate", "'-o DIR'"),
];

#[test]
fn errors_of_a_build_are_objects() {
    for &(project, arguments, code, message, place_or_help) in OF_BUILDS {
        let place = place();
        place.write("afp.toml", project);
        place.write("mine/Cargo.toml", "[package]\nname = \"mine\"\n");
        let said = with_cargo(&place, &format!("build {arguments} --json"), "exit 1");
        said.fails(code, &[]);
        let (all, summary) = objects(&said);
        let errors: Vec<_> = all.iter().filter(|object| object["severity"] == "error").collect();
        assert_eq!((said.err.as_str(), &summary["built"]), ("", &json!(false)), "{arguments}");
        assert!(errors[0]["message"].as_str().unwrap().contains(message), "{errors:?}");
        let words = match errors[0]["place"].is_null() {
            true => errors[0]["help"].as_str().unwrap(),
            false => at(errors[0]).0,
        };
        assert!(words.contains(place_or_help), "{errors:?}");
    }
}

#[test]
fn a_failed_or_missing_cargo_is_an_error() {
    let place = place();
    let said = with_cargo(&place, "build p.afp --json", "echo 'no network' >&2; exit 101");
    said.fails(1, &["no network"]);
    let (all, summary) = objects(&said);
    assert_eq!(all[1]["message"], "cargo could not build the crate in 'target/afp/p'");
    assert_eq!((&all[1]["code"], &all[1]["place"]), (&Value::Null, &Value::Null));
    assert_eq!((&summary["built"], &summary["binary"]), (&json!(false), &Value::Null));
    assert!(summary["folder"].as_str().unwrap().ends_with("/target/afp/p"), "{summary}");
    let mut command = place.command();
    command.args(["build", "p.afp", "--json"]).env("CARGO", "no-such-cargo");
    let (all, _) = objects(crate::common::said(command.output().unwrap()).fails(1, &[]));
    assert!(all[1]["help"].as_str().unwrap().contains("https://rustup.rs"), "{all:?}");
    // The real cargo, whose own messages are on standard error.
    place.write("afp.toml", "[afp]\npath = \"nowhere\"\n");
    let said = place.afpc("build p.afp --json");
    let (all, _) = objects(said.fails(1, &["nowhere"]));
    assert_eq!(all[1]["help"], "see cargo's messages on standard error");
}

/// A message of cargo about a crate.
fn message(manifest: &str, level: &str, title: &str, spans: &Value) -> String {
    let message = json!({ "level": level, "message": title, "rendered": format!("{level}: {title}"),
        "spans": spans, "children": [] });
    let line =
        json!({ "reason": "compiler-message", "manifest_path": manifest, "message": message });
    format!("cat <<'END'\n{line}\nEND\n")
}

#[test]
fn errors_of_rust_are_at_their_line_of_the_plan() {
    let place = place();
    with_cargo(&place, "build p.afp", "exit 1").fails(1, &[]);
    let rust = place.read("target/afp/p/src/p.rs");
    let line = rust.lines().position(|line| line.contains("distance: ")).unwrap() + 1;
    let manifest = place.path("target/afp/p/Cargo.toml").display().to_string();
    let span = |file: &str, line: usize| {
        json!([{ "is_primary": true, "file_name": file, "line_start": line, "column_start": 3,
            "byte_start": 40, "byte_end": 45, "label": "expected this", "text": [] }])
    };
    let cargo = [
        message(&manifest, "error", "mismatched types", &span("src/p.rs", line)),
        message("/far/Cargo.toml", "error", "it is far", &span("src/lib.rs", 7)),
        message("/far/Cargo.toml", "warning", "of others", &span("src/lib.rs", 7)),
        message(&manifest, "error", "aborting due to 1 previous error", &json!([])),
        "exit 101".to_owned(),
    ];
    let said = with_cargo(&place, "build p.afp --json", &cargo.concat());
    said.fails(1, &["error: mismatched types", "error: it is far"]);
    let (all, _) = objects(&said);
    let [_, ours, far] = &all[..] else { panic!("{all:?}") };
    assert_eq!(ours["message"], "the generated Rust does not compile: mismatched types");
    let plan_line = PLAN.lines().position(|line| line.contains("Forward(")).unwrap() as u64 + 1;
    assert_eq!((at(ours).0, at(ours).1, &ours["code"]), ("p.afp", plan_line, &Value::Null));
    let rust = json!({ "file": "target/afp/p/src/p.rs", "line": line, "column": 3, "start": 40, "end": 45 });
    assert_eq!(ours["notes"], json!([{ "place": rust, "text": "expected this" }]));
    assert_eq!((&far["message"], at(far)), (&json!("it is far"), ("/far/src/lib.rs", 7, 3)));
    assert_eq!(far["notes"], json!([]));
}

#[test]
fn a_message_of_the_linker_is_reported() {
    let place = place();
    let manifest = place.path("target/afp/p/Cargo.toml").display().to_string();
    let cargo = message(&manifest, "error", "linker `cc` not found", &json!([])) + "exit 101";
    let said = with_cargo(&place, "build p.afp", &cargo);
    said.fails(1, &["error: linker `cc` not found", "error: cargo could not build the crate"]);
    let (all, _) = objects(&with_cargo(&place, "build p.afp --json", &cargo));
    assert_eq!(
        (&all[1]["message"], &all[1]["place"]),
        (&json!("linker `cc` not found"), &Value::Null)
    );
    assert_eq!(all.len(), 2, "{all:?}");
}

#[test]
fn a_full_disk_is_reported_and_a_closed_pipe_is_not() {
    let place = place();
    for (arguments, code) in [("build p.afp --json", 0), ("build missing.afp --json", 1)] {
        let mut command = calling(&place, arguments, "true");
        let full = File::options().write(true).open("/dev/full").unwrap();
        let told = said(command.stdout(full).stderr(Stdio::piped()).output().unwrap());
        told.fails(1, &["cannot write to 'standard output'"]);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        said(child.wait_with_output().unwrap()).fails(code, &[]);
    }
}

#[test]
fn check_reports_errors_of_files_and_projects_to_tools() {
    let place = place();
    let said = place.afpc("check missing.afp p.afp --json");
    said.fails(1, &[]);
    let read = |line| serde_json::from_str::<Value>(line).unwrap();
    let all: Vec<_> = said.out.lines().map(read).collect();
    assert_eq!((all.len(), said.err.as_str()), (2, ""), "{all:?}");
    assert!(all[0]["message"].as_str().unwrap().starts_with("cannot read the plan 'missing.afp'"));
    let said = place.afpc("check p.afp --json --target vax");
    said.fails(2, &[]);
    assert!(said.last_json()["help"].as_str().unwrap().contains("[target.vax]"), "{}", said.out);
    place.write("afp.toml", "[toolboxes]\na = 1\nb = 2\n");
    let said = place.afpc("check p.afp --json");
    said.fails(1, &[]);
    let all: Vec<_> = said.out.lines().map(read).collect();
    let places: Vec<_> = all.iter().map(|object| (at(object).0, at(object).1)).collect();
    assert_eq!((places, said.err.as_str()), (vec![("afp.toml", 2), ("afp.toml", 3)], ""));
}
