//! Toolboxes of projects, with crates outside of this workspace: checked, built, compiled in, run
//! through a runner; and errors in their Rust code at the lines of the toolbox and the plan.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::common::{Place, Said, said};
use serde_json::Value;

const TOOLBOX: &str = include_str!("gestures/gestures.afp");
const RUST: &str = include_str!("gestures/src/lib.rs");
const PLAN: &str = include_str!("gestures/dance.afp");
const SCENARIO: &str = "use \"../dance.afp\"\n
scenario \"turns and goes on\" for Dance {
    expect second -> ahead by enough before 10 s
    until 20 s
}
";
const HOST: &str = include_str!("gestures/host.rs");
const QUIET: &str = "--log none --svg none";

/// The checkout.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// A manifest of a crate outside of any workspace.
fn manifest(name: &str, ours: &[&str], others: &str) -> String {
    let line = |name: &&str| {
        let path = root().join("crates").join(name);
        format!(
            "{name} = {{ path = {:?}, default-features = false }}\n",
            path.display().to_string()
        )
    };
    let ours: String = ours.iter().map(line).collect();
    format!(
        "[package]\nname = \"{name}\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\n\
         [dependencies]\n{ours}{others}\n[workspace]\n"
    )
}

/// A project with a toolbox and its crate, and a plan that uses it.
fn project() -> Place {
    let place = Place::new();
    place.write("afp.toml", "[toolboxes]\ngestures = { path = \"gestures/gestures.afp\" }\n");
    place.write("plans/dance.afp", PLAN);
    place.write("gestures/gestures.afp", TOOLBOX);
    place.write("gestures/src/lib.rs", RUST);
    place.write("gestures/Cargo.toml", &manifest("robot-gestures", &["afp", "afp-carbot"], ""));
    place
}

#[test]
fn unknown_names_are_reported_before_a_build() {
    let place = project();
    place.write("plans/tests/dance.afp", SCENARIO);
    for (arguments, why) in [
        ("run plans/dance.afp --press nothing@1s", "no control 'nothing'"),
        ("run plans/dance.afp --press escpe@1s", "such as 'escape@1s'"),
        ("run plans/dance.afp --fail wheels.slip=2@1s", "'2' is not a share from 0 to 1"),
        ("run plans/dance.afp --fail nothing.lost@1s", "unknown device 'nothing'"),
        ("run plans/dance.afp --set nothing=3", "the plan has no entry 'nothing'"),
        ("run plans/dance.afp --set robot.port=3", "add '--robot hardware'"),
        ("test nothing", "no scenario has 'nothing' in its name"),
    ] {
        let mut command = place.command();
        // A build needs it.
        command.args(arguments.split(' ')).env("CARGO", "/no/such/cargo");
        said(command.output().unwrap()).fails(2, &[why]);
    }
    let mut command = place.command();
    command.args(["run", "plans/dance.afp", "--world", "no.toml"]).env("CARGO", "/no/such/cargo");
    said(command.output().unwrap()).fails(1, &["cannot read the world 'no.toml'"]);
    let mut command = place.command();
    command.args(["run", "plans/dance.afp"]).env("CARGO", "/no/such/cargo");
    let all = said(command.output().unwrap());
    assert!(all.err.contains("cargo"), "{}", all.err);
}

#[test]
fn a_plan_is_checked_against_the_toolbox_of_the_project() {
    let place = project();
    place.afpc("check plans/dance.afp").succeeds();
    place.write("plans/dance.afp", &PLAN.replace("400 ms", "2 min"));
    place.afpc("check plans/dance.afp").fails(1, &["error[E0224]", "plans/dance.afp:10:30"]);
}

#[test]
fn errors_of_a_toolbox_are_at_their_place() {
    let place = project();
    place.write("gestures/gestures.afp", &TOOLBOX.replace("duration      =", "distance ="));
    place.afpc("check plans/dance.afp").fails(1, &["error[E0232]", "gestures/gestures.afp:8:16"]);
    place.write("gestures/gestures.afp", &TOOLBOX.replace("toolbox gestures", "toolbox poses"));
    let wanted = "'gestures/gestures.afp' does not begin with 'toolbox gestures'";
    place.afpc("check plans/dance.afp").fails(1, &[wanted, " afp.toml:2:1"]);
    place.write("afp.toml", "[toolboxes]\ngestures = { path = \"x.afp\", crat = 1 }\nb = 2\n");
    let said = place.afpc("run plans/dance.afp");
    said.fails(
        1,
        &["a toolbox has no 'crat'", " afp.toml:2:30", " afp.toml:3:5", "'b' is a table"],
    );
}

#[test]
fn a_toolbox_without_a_crate_can_be_checked_but_not_run() {
    let place = project();
    std::fs::remove_file(place.path("gestures/Cargo.toml")).unwrap();
    place.afpc("check plans/dance.afp").succeeds();
    for command in ["run", "build"] {
        let said = place.afpc(&format!("{command} plans/dance.afp"));
        said.fails(1, &["has a Cargo.toml", " afp.toml:2:1", "help: 'crate = { path"]);
    }
}

#[test]
fn without_cargo_a_run_explains_how_to_install_it() {
    let place = project();
    let mut command = place.command();
    command.args(["run", "plans/dance.afp"]).env("PATH", "").env("CARGO", "no-such-cargo");
    let said = said(command.output().unwrap());
    let texts = ["the toolbox 'gestures'", "is not installed", "https://rustup.rs"];
    said.fails(1, &texts);
    assert!(said.out.is_empty());
}

/// A second toolbox, with its own crate.
fn with_waves(place: &Place) {
    let named = |text: &str| text.replace("gestures", "waves").replace("Dance", "Wave");
    place.write("waves/waves.afp", &named(TOOLBOX));
    place.write("waves/src/lib.rs", &named(RUST));
    place.write("waves/Cargo.toml", &manifest("robot-waves", &["afp", "afp-carbot"], ""));
    place.write("plans/wave.afp", &named(PLAN));
    place.write("plans/plain.afp", crate::common::WALL_FOLLOWING);
    place.write(
        "afp.toml",
        "[toolboxes]\ngestures = { path = \"gestures/gestures.afp\" }\n\
         waves = { path = \"waves/waves.afp\" }\n",
    );
    let scenario = |name: &str, plan: &str| {
        format!("scenario \"{name}\" for {plan} {{ never collision until 3 s }}\n")
    };
    let both = "use \"../plain.afp\"\nuse \"../dance.afp\"\n\n";
    let plain = scenario("plain", "WallFollowing");
    place.write("plans/tests/a.afp", &format!("{both}{plain}{}", scenario("danced", "Dance")));
    let wave = scenario("waved", "Wave");
    place.write("plans/tests/b.afp", &format!("use \"../wave.afp\"\n\n{wave}"));
}

#[test]
fn one_runner_has_the_toolboxes_of_all_scenarios() {
    let place = project();
    with_waves(&place);
    let without_cargo = |arguments: &[&str]| {
        let mut command = place.command();
        command.args(arguments).env("PATH", "").env("CARGO", "no-such-cargo");
        said(command.output().unwrap())
    };
    let both = ["the toolboxes 'gestures' and 'waves'", "is not installed"];
    without_cargo(&["test"]).fails(1, &both);
    without_cargo(&["test", "plans/tests/b.afp", "plans/tests/a.afp"]).fails(1, &both);
    without_cargo(&["test", "--generate", "plans/wave.afp", "plans/dance.afp"]).fails(1, &both);
    without_cargo(&["test", "plans/tests/b.afp"]).fails(1, &["the toolbox 'waves'"]);
    without_cargo(&["sweep", "plans/wave.afp"]).fails(1, &["the toolbox 'waves'"]);
    without_cargo(&["run", "plans/plain.afp", "--until", "1s"]).succeeds();
}

#[test]
fn two_toolboxes_of_one_name_do_not_go_into_one_runner() {
    let place = project();
    for file in ["afp.toml", "plans/dance.afp", "gestures/gestures.afp", "gestures/Cargo.toml"] {
        place.write(&format!("other/{file}"), &place.read(file));
    }
    let scenario = "use \"dance.afp\"\n\nscenario \"x\" for Dance { never collision until 1 s }\n";
    place.write("plans/a.afp", scenario);
    place.write("other/plans/a.afp", scenario);
    let said = place.afpc("test plans/a.afp other/plans/a.afp");
    said.fails(2, &["are two toolboxes with the name 'gestures'", "run their plans separately"]);
}

/// A call in the project, with the build folder of all slow tests and little optimisation.
fn build_with(mut command: Command, arguments: &str) -> Said {
    command.args(arguments.split_whitespace());
    said(crate::common::quickly_built(&mut command).output().unwrap())
}

fn afpc(place: &Place, arguments: &str) -> Said {
    build_with(place.command(), arguments)
}

#[test]
#[ignore = "builds the simulator and the command line; `cargo xtask nightly` runs it"]
fn project_toolboxes_run_everywhere_and_their_errors_have_places() {
    let place = project();
    let interpreted = through_a_runner(&place);
    let binary = built(&place, &interpreted);
    assert!(binary.is_file());
    compiled_in(&place, &interpreted);
    errors_of_the_toolbox_crate(&place);
    errors_of_the_generated_crate(&place);
    let place = project();
    with_waves(&place);
    let tested = afpc(&place, "test");
    tested.succeeds();
    assert!(tested.err.contains("the toolboxes 'gestures' and 'waves' (once)"), "{}", tested.err);
    assert!(tested.out.contains("3 passed, 0 failed"), "{}", tested.out);
}

/// The runner is built once and reused, even without cargo. A changed source rebuilds it.
fn through_a_runner(place: &Place) -> String {
    let run = format!("run plans/dance.afp --json {QUIET}");
    let first = afpc(place, &run);
    first.succeeds();
    let says = "building a runner for the toolbox 'gestures' (once)";
    assert!(first.err.contains(says), "{}", first.err);
    assert_eq!(first.last_json()["summary"]["ending"], "ok", "{}", first.out);

    let mut without_cargo = place.command();
    without_cargo.env("PATH", "").env("CARGO", "no-such-cargo");
    let again = build_with(without_cargo, &run);
    again.succeeds();
    assert_eq!((&*again.out, &*again.err), (&*first.out, ""));

    place.write("plans/tests/dance.afp", SCENARIO);
    let tested = afpc(place, "test");
    tested.succeeds();
    assert!(tested.out.contains("1 passed, 0 failed"), "{}{}", tested.out, tested.err);
    let swept = afpc(place, "sweep plans/dance.afp --seeds 0..2 --json");
    swept.succeeds();
    let trace = first.last_json()["summary"]["trace"].to_string();
    assert!(swept.out.lines().next().unwrap().contains(&trace), "{}", swept.out);

    // Exit codes and messages come from the runner.
    afpc(place, &format!("{run} --set spent=1s")).fails(2, &["cannot be set from outside"]);
    let quick = RUST.replace("Speed::from_si(0.0), self.speed", "Speed::from_si(0.1), self.speed");
    place.write("gestures/src/lib.rs", &quick);
    let other = afpc(place, &run);
    other.succeeds();
    assert!(other.err.contains(says) && other.out != first.out);
    place.write("gestures/src/lib.rs", RUST);
    first.out
}

fn built(place: &Place, interpreted: &str) -> PathBuf {
    let built = afpc(place, "build plans/dance.afp");
    built.succeeds();
    let binary = PathBuf::from(built.out.lines().last().unwrap());
    assert_eq!(program(place, &binary), interpreted);
    let manifest = place.read("target/afp/dance/Cargo.toml");
    assert!(manifest.contains("robot-gestures = { path = "), "{manifest}");
    opens_elsewhere(place, &binary);
    binary
}

/// The program says what it is, and its log needs neither its project nor its toolbox.
fn opens_elsewhere(place: &Place, binary: &Path) {
    let run = |arguments: &str, folder: &Place| {
        let mut command = Command::new(binary);
        command.args(arguments.split(' ')).current_dir(folder.path(""));
        let said = said(command.output().unwrap());
        said.succeeds();
        said.out
    };
    let version = run("--version", place);
    for part in ["\nplan     plans/dance.afp\n", "\ntoolbox  gestures ", "\nafp      0."] {
        assert!(version.contains(part), "{version}");
    }
    assert!(run("--self-check", place).starts_with("trace "));
    run("--log dance.mcap --svg none", place);
    let elsewhere = Place::new();
    std::fs::copy(place.path("dance.mcap"), elsewhere.path("dance.mcap")).unwrap();
    run(&format!("--again dance.mcap {QUIET}"), &elsewhere);
    let again = elsewhere.afpc(&format!("run --again dance.mcap {QUIET}"));
    again.fails(2, &["used the toolbox 'gestures', whose Rust code is not here"]);
    let launch =
        r#"{"seq":1,"type":"request","command":"launch","arguments":{"log":"dance.mcap"}}"#;
    elsewhere.write("launch", &format!("Content-Length: {}\r\n\r\n{launch}", launch.len()));
    let mut debugger = elsewhere.command();
    debugger.arg("dap").stdin(std::fs::File::open(elsewhere.path("launch")).unwrap());
    let shown = said(debugger.output().unwrap());
    assert!(shown.out.contains(r#""command":"launch","success":true"#), "{shown:?}");
}

/// The output of a program with the options of a run.
fn program(place: &Place, binary: &Path) -> String {
    let mut command = Command::new(binary);
    command.arg("--json").args(QUIET.split(' ')).current_dir(place.path(""));
    let said = said(command.stderr(Stdio::inherit()).output().unwrap());
    said.succeeds();
    said.out
}

/// `plan!` finds the toolbox through `afp.toml`.
fn compiled_in(place: &Place, interpreted: &str) {
    place.write("host/src/main.rs", HOST);
    let ours = ["afp", "afp-carbot", "afp-run", "afp-sim"];
    let toolbox = "robot-gestures = { path = \"../gestures\" }\n";
    place.write("host/Cargo.toml", &manifest("host", &ours, toolbox));
    place.write("host/Cargo.lock", &std::fs::read_to_string(root().join("Cargo.lock")).unwrap());
    let mut cargo = Command::new(env!("CARGO"));
    cargo.current_dir(place.path("host"));
    build_with(cargo, "build --release").succeeds();
    let binary = concat!(env!("CARGO_TARGET_TMPDIR"), "/built-plans/release/host");
    assert_eq!(program(place, Path::new(binary)), interpreted);
}

/// Each mismatch between a toolbox and its Rust code is reported at the line of the toolbox.
fn errors_of_the_toolbox_crate(place: &Place) {
    let ways = [
        // A missing implementation.
        ("pub struct CheckTurned", "pub struct CheckTurnedAround", "supervisor CheckTurned"),
        // An output with a different type.
        ("Time::from_si(spent.as_secs_f64())", "spent.as_secs_f64()", "    out spent: duration"),
        // An undeclared state.
        ("State::Spun {", "State::Dizzy {", "actor Spin {"),
    ];
    for (from, to, line) in ways {
        assert!(RUST.contains(from));
        place.write("gestures/src/lib.rs", &RUST.replace(from, to));
        let number = TOOLBOX.lines().position(|text| text.starts_with(line)).unwrap() + 1;
        let place_text = format!("--> gestures/gestures.afp:{number}:");
        for command in ["run", "build"] {
            let said = afpc(place, &format!("{command} plans/dance.afp"));
            said.fails(1, &["the Rust of the toolbox 'gestures' does not compile", &place_text]);
            said.fails(1, &["gestures/src/lib.rs:", "error[E0"]);
        }
    }
    place.write("gestures/src/lib.rs", RUST);
}

/// A crate that was compiled with a different toolbox file.
fn errors_of_the_generated_crate(place: &Place) {
    place.write(
        "newer.afp",
        &TOOLBOX.replace("in  time:  duration      = 500 ms from 0 s to 1 min", "in time: float"),
    );
    place.write(
        "afp.toml",
        "[toolboxes]\ngestures = { path = \"newer.afp\", crate = { path = \"gestures\" } }\n",
    );
    place.write("plans/dance.afp", &PLAN.replace("400 ms", "0.5").replace("10 s", "10"));
    let said = afpc(place, "build plans/dance.afp");
    let texts = [
        "the generated Rust does not compile: mismatched types",
        "--> plans/dance.afp:10:30",
        "--> plans/dance.afp:14:31",
        "= in target/afp/dance/src/dance.rs:",
        "error[E0308]",
    ];
    said.fails(1, &texts);
    let told = afpc(place, "build plans/dance.afp --json");
    told.fails(1, &["error[E0308]"]);
    let objects = told.out.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    let objects: Vec<_> = objects.collect();
    for (line, column) in [(10, 30), (14, 31)] {
        let is_here = |object: &&Value| {
            let place = &object["place"];
            place["file"] == "plans/dance.afp" && place["line"] == line && place["column"] == column
        };
        let found = objects.iter().find(is_here).unwrap_or_else(|| panic!("{}", told.out));
        assert_eq!(found["notes"][0]["place"]["file"], "target/afp/dance/src/dance.rs");
    }
    assert_eq!(told.last_json()["summary"]["built"], false);
}
