//! `afpc check`, `explain`, `graph`, `completions`, and commands of later releases.

use crate::common::{Place, WALL_FOLLOWING};

#[test]
fn a_valid_plan_has_no_errors() {
    let place = Place::with_plan();
    let said = place.afpc("check wall_following.afp");
    said.succeeds();
    assert_eq!((&*said.out, &*said.err), ("wall_following.afp: no errors\n", ""));
}

#[test]
#[cfg(unix)]
fn a_file_may_be_a_pipe() {
    use std::io::Write;
    use std::process::Stdio;
    let place = Place::with_plan();
    for (text, code) in [(WALL_FOLLOWING, 0), ("toolbox lamp\n", 0), ("plan P {", 1)] {
        for options in ["", "--json", "--timing"] {
            let mut command = place.command();
            command.arg("check").args(options.split_whitespace()).arg("/dev/stdin");
            command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
            let mut child = command.spawn().unwrap();
            child.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
            let said = crate::common::said(child.wait_with_output().unwrap());
            assert_eq!(said.code, code, "{options} {said:#?}");
        }
    }
}

#[test]
fn all_errors_of_all_files_come_at_once() {
    let place = Place::new();
    let wrong = WALL_FOLLOWING
        .replace("walldist:  length = 30 cm", "walldist:  length = 30")
        .replace("-> followWall", "-> followWal");
    place.write("a.afp", &wrong);
    place.write("b.afp", "plan Empty { }");
    let said = place.afpc("check a.afp missing.afp b.afp");
    said.fails(1, &["expected a length", "30 cm", "followWal'", "--> a.afp:", "--> b.afp:"]);
    assert!(said.err.contains("error: cannot read the plan 'missing.afp'"), "{}", said.err);
    assert_eq!(said.out, "");
}

#[test]
fn a_toolbox_is_checked_by_itself() {
    let place = Place::new();
    let toolbox =
        "/// A lamp.\ntoolbox lamp version \"1.0\"\nactor Blink { in often: int = 3 state Done }\n";
    place.write("lamp.afp", toolbox);
    let said = place.afpc("check lamp.afp");
    said.succeeds();
    assert_eq!((&*said.out, &*said.err), ("lamp.afp: no errors\n", ""));

    place.write("wrong.afp", &toolbox.replace("often: int", "often: lenght").replace("= 3", ""));
    let said = place.afpc("check wrong.afp");
    said.fails(1, &["error[E0232]", "lenght", "--> wrong.afp:3:"]);
    assert!(!said.err.contains("E0503"), "it needs no plan: {}", said.err);
    let said = place.afpc("check wrong.afp --json");
    said.fails(1, &[]);
    let line: serde_json::Value = serde_json::from_str(said.out.lines().next().unwrap()).unwrap();
    assert_eq!(line["code"], "E0232", "{line}");
}

#[test]
fn diagnostics_can_be_json() {
    let place = Place::new();
    place.write("a.afp", &WALL_FOLLOWING.replace("start searchFirstWall", "start searchFirst"));
    let said = place.afpc("check a.afp --json");
    said.fails(1, &[]);
    let line: serde_json::Value = serde_json::from_str(said.out.lines().next().unwrap()).unwrap();
    assert_eq!(line["severity"], "error", "{line}");
    assert!(line["code"].as_str().unwrap().starts_with("E02"), "{line}");
}

#[test]
fn a_plan_is_chosen_by_name() {
    let place = Place::new();
    let two = format!("{WALL_FOLLOWING}\nplan Other {{ start w  actor w: Wait(duration = 1 s) {{ Elapsed -> terminate }} }}")
        .replace("use carbot", "use carbot\nuse std");
    place.write("two.afp", &two);
    let said = place.afpc("run two.afp:Other --log none --svg none --json");
    said.succeeds();
    assert_eq!(said.last_json()["summary"]["plan"], "Other");
    assert_eq!(said.last_json()["summary"]["ending"], "ok");
    place.afpc("check two.afp:Third").fails(1, &["Third"]);
}

#[test]
fn codes_are_explained() {
    let place = Place::new();
    let said = place.afpc("explain e0101");
    said.succeeds();
    assert!(said.out.contains("E0101"), "{}", said.out);
    place.afpc("explain E9999").fails(2, &["there is no error code 'E9999'", "help: "]);
}

#[test]
fn an_unknown_template_is_reported_by_its_full_name() {
    let place = Place::new();
    for name in ["carbot.Forwrad", "plan.afp", "carbot."] {
        let message = format!("there is no toolbox or template '{name}'");
        place.afpc(&format!("templates {name}")).fails(2, &[&message, "help: "]);
    }
}

#[test]
fn plans_are_drawn_in_every_format() {
    let place = Place::with_plan();
    place.afpc("graph wall_following.afp -o plan.svg").succeeds();
    assert!(place.read("plan.svg").starts_with("<svg"));
    let said = place.afpc("graph wall_following.afp --format json");
    let graph: serde_json::Value = serde_json::from_str(&said.out).unwrap();
    assert_eq!(graph["first"], "searchFirstWall");
    let said = place.afpc("graph wall_following.afp -o plan.dot");
    said.succeeds();
    assert!(place.read("plan.dot").contains("digraph"));
    place.afpc("graph wall_following.afp -o plan.scxml").succeeds();
    assert!(place.read("plan.scxml").contains("<final id=\"WallFollowing-OK\"/>"));
    let nowhere = place.afpc("graph wall_following.afp -o no/such/plan.svg");
    nowhere.fails(1, &["error: cannot write the drawing 'no/such/plan.svg'"]);
    assert_eq!(place.files(), ["plan.dot", "plan.scxml", "plan.svg", "wall_following.afp"]);
}

#[test]
fn positions_come_from_the_side_file_and_broken_lines_are_warnings() {
    let place = Place::with_plan();
    let automatic = place.afpc("graph wall_following.afp").out;
    let lines =
        "WallFollowing.followWall 900 0\nP.x 1 far\nnonsense\nWallFolowing.followWall 1 2\n";
    place.write("wall_following.afp.layout", lines);
    let said = place.afpc("graph wall_following.afp");
    said.succeeds();
    assert_ne!(said.out, automatic);
    for warning in [
        "2:7: expected a whole number, found 'far'",
        "3:1: expected a line such as 'Plan.element 300 120', found 'nonsense'",
        "4:1: unknown item 'WallFolowing.followWall': write 'WallFollowing.followWall'",
    ] {
        let warning = format!("warning: wall_following.afp.layout:{warning}\n");
        assert!(said.err.contains(&warning), "{}", said.err);
    }
    let said = place.afpc("graph wall_following.afp --format json");
    assert!(said.out.contains("\"position\": ["), "{}", said.out);
}

#[test]
fn options_of_other_formats_are_refused() {
    let place = Place::with_plan();
    for (options, said) in [
        ("--scale 2", "'--scale' has no effect on '--format svg'"),
        ("--format json --no-data", "'--no-data' has no effect on '--format json'"),
        ("--format scxml --fold", "'--fold' has no effect on '--format scxml'"),
        ("--format dot --theme dark", "'--theme' has no effect on '--format dot'"),
        ("-o x.png --scale 11", "expected a number from 0.1 to 10"),
    ] {
        place.afpc(&format!("graph wall_following.afp {options}")).fails(2, &[said]);
    }
}

#[cfg(feature = "png")]
#[test]
fn pictures_have_the_requested_size_and_colours() {
    let place = Place::with_plan();
    let drawn = |options: &str| {
        place.afpc(&format!("graph wall_following.afp -o plan.png {options}")).succeeds();
        let picture = place.bytes("plan.png");
        let number = |at: usize| u32::from_be_bytes(picture[at..at + 4].try_into().unwrap());
        assert_eq!(&picture[..8], b"\x89PNG\r\n\x1a\n");
        ((number(16), number(20)), picture)
    };
    let (once, _) = drawn("--scale 1");
    let (twice, light) = drawn("");
    let (same, dark) = drawn("--theme dark");
    assert_eq!((2 * once.0, 2 * once.1), twice);
    assert_eq!(twice, same);
    assert_ne!(light, dark);
}

#[test]
fn an_invalid_plan_is_not_charted_run_or_built() {
    let place = Place::new();
    place.write("a.afp", "plan A { start b }");
    for command in ["graph a.afp -o a.scxml", "run a.afp", "build a.afp"] {
        place.afpc(command).fails(1, &["error[E02", "--> a.afp:1:"]);
    }
    assert_eq!(place.files(), ["a.afp"]);
}

#[test]
fn commands_of_later_releases_and_other_builds_are_explained() {
    let place = Place::new();
    let said = place.afpc("replay some --option");
    said.fails(2, &["'afpc replay' is not in release", "it comes with", "  help: 'afpc "]);
    assert!(!place.afpc("--help").out.contains("\n  replay "));
    for name in [
        #[cfg(not(feature = "dap"))]
        "dap",
        #[cfg(not(feature = "lsp"))]
        "lsp",
    ] {
        let built = format!("built without '{name}'");
        place.afpc(name).fails(2, &[&built, "--features full"]);
    }
    #[cfg(not(feature = "studio"))]
    place.afpc("studio").fails(2, &["built without 'studio'", "cargo studio"]);
    place.afpc("fly").fails(2, &["unrecognized subcommand 'fly'"]);
    place.afpc("check").fails(2, &["FILE"]);
}

#[test]
fn help_has_examples_and_shells_have_completions() {
    let place = Place::new();
    for command in ["", "check ", "graph ", "run ", "build ", "log "] {
        let said = place.afpc(&format!("{command}--help"));
        said.succeeds();
        assert!(said.out.contains("Examples:"), "{}", said.out);
    }
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let said = place.afpc(&format!("completions {shell}"));
        said.succeeds();
        for there in ["afpc", "explain", "until", "at-least"] {
            assert!(said.out.contains(there), "{shell}: no {there}");
        }
        for later in ["replay", "listen"] {
            assert!(!said.out.contains(later), "{shell}: {later}");
        }
    }
}
