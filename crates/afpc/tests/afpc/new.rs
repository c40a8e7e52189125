//! `afpc new`: new projects work without changes. `afpc templates`: the list.

use std::process::Command;

use crate::common::{Place, Said, said};

#[test]
fn a_plan_can_be_run_and_tested_at_once() {
    let place = Place::new();
    let made = place.afpc("new patrol");
    made.succeeds();
    assert!(made.out.contains("patrol/plans/patrol.afp\n"), "{}", made.out);
    // The printed next commands.
    let next = made.out.split_once("Next:\n").map_or("", |(_, next)| next);
    assert_eq!(next, "  cd patrol\n  afpc run plans/patrol.afp\n  afpc test\n");
    let inside = |arguments: &str| in_folder(&place, "patrol", arguments);
    let ran = inside("run plans/patrol.afp --until 3min");
    ran.succeeds();
    assert!(ran.out.contains("world  Room (worlds/patrol.toml)"), "{}", ran.out);
    let tested = inside("test");
    tested.succeeds();
    assert!(tested.out.contains("3 passed, 0 failed"), "{}", tested.out);
    inside("check plans/patrol.afp plans/tests/patrol.afp").succeeds();
    inside("fmt --check plans/patrol.afp plans/tests/patrol.afp").succeeds();
}

fn in_folder(place: &Place, folder: &str, arguments: &str) -> Said {
    let mut command = place.command();
    command.current_dir(place.path(folder)).args(arguments.split_whitespace());
    said(command.output().unwrap())
}

#[test]
fn projects_with_rust_are_valid_and_name_the_needs_of_a_run() {
    let place = Place::new();
    for (name, option, needs) in [
        ("greeter", "--toolbox", "the toolbox 'greeter'"),
        ("my-rover", "--robot", "the robot 'my_rover::MyRover' with the toolbox 'my_rover'"),
    ] {
        place.afpc(&format!("new {name} {option}")).succeeds();
        let plan = format!("plans/{name}_plan.afp");
        in_folder(&place, name, &format!("check {plan}")).succeeds();
        let mut command = place.command();
        command.current_dir(place.path(name)).args(["run", &plan]);
        let said = said(command.env("PATH", "").env("CARGO", "no-such-cargo").output().unwrap());
        said.fails(1, &[needs, "is not installed"]);
    }
}

#[test]
#[ignore = "builds the simulator and the command line; `cargo xtask nightly` runs it"]
fn projects_with_rust_run_and_pass_their_tests_unchanged() {
    let place = Place::new();
    for (name, option) in [("greeter", "--toolbox"), ("my-rover", "--robot")] {
        place.afpc(&format!("new {name} {option}")).succeeds();
        let slow = |mut command: Command| {
            command.current_dir(place.path(name));
            said(crate::common::quickly_built(&mut command).output().unwrap())
        };
        let afpc = |arguments: &str| {
            let mut command = place.command();
            command.args(arguments.split_whitespace());
            slow(command)
        };
        afpc(&format!("run plans/{name}_plan.afp --until 20s")).succeeds();
        let tested = afpc("test");
        tested.succeeds();
        assert!(tested.out.contains(" 0 failed"), "{}", tested.out);
        afpc(&format!("build plans/{name}_plan.afp")).succeeds();
        let mut cargo = Command::new(env!("CARGO"));
        cargo.arg("test");
        slow(cargo).succeeds();
    }
}

#[test]
fn existing_files_are_kept_and_names_are_checked() {
    let place = Place::new();
    place.afpc("new patrol").succeeds();
    place.afpc("new patrol").fails(2, &["'patrol' already exists"]);
    place.afpc("new Patrol").fails(2, &["cannot be the name", "'my-rover'"]);
    place.afpc("new turn").fails(2, &["the name 'turn' is taken", "'my-turn'"]);
    place.afpc("new x --toolbox --robot").fails(2, &["--robot"]);
    assert!(place.files().iter().all(|name| name.starts_with("patrol/")), "{:?}", place.files());
}

#[test]
fn an_empty_folder_becomes_a_project_of_its_name() {
    let place = Place::new();
    std::fs::create_dir(place.path("rover")).unwrap();
    let made = in_folder(&place, "rover", "new .");
    assert!(made.succeeds().out.contains("plans/rover.afp\n"), "{}", made.out);
    in_folder(&place, "rover", "check plans/rover.afp").succeeds();
    in_folder(&place, "rover", "new .").fails(2, &["'.' already exists and is not empty"]);
}

#[cfg(unix)]
#[test]
fn an_incomplete_project_leaves_no_files() {
    let place = Place::new();
    let mut shell = Command::new("sh");
    // The file size is limited; without the signal, writing fails like on a full disk.
    shell.args(["-c", "trap '' XFSZ; ulimit -f 0; exec \"$AFPC\" new patrol"]);
    let full = shell.env("AFPC", env!("CARGO_BIN_EXE_afpc")).current_dir(place.path(""));
    said(full.output().unwrap()).fails(1, &["cannot write 'patrol/", "File too large"]);
    assert!(!place.path("patrol").exists());
    std::os::unix::fs::symlink("nowhere", place.path("link")).unwrap();
    place.afpc("new link").fails(2, &["'link' already exists"]);
    place.afpc("new patrol").succeeds();
}

#[test]
fn a_plan_without_a_command_is_explained() {
    let place = Place::with_plan();
    for name in ["wall_following.afp", "./wall_following.afp", "wall_following.afp:WallFollowing"] {
        let said = place.afpc(name);
        said.fails(
            2,
            &[&format!("'{name}' is a plan, not a command"), &format!("afpc run {name}")],
        );
    }
    place.afpc("runn").fails(2, &["runn"]);
}

#[test]
fn templates_are_listed_and_described() {
    let place = Place::new();
    let all = place.afpc("templates");
    all.succeeds();
    for line in
        ["std: Templates for every robot", "  actor Forward", "  supervisor CheckTouchSensor"]
    {
        assert!(all.out.contains(line), "{}", all.out);
    }
    assert!(!place.afpc("templates std").out.contains("Forward"));
    for name in ["Forward", "forward", "carbot.Forward"] {
        let one = place.afpc(&format!("templates {name}"));
        one.succeeds();
        assert!(one.out.starts_with("actor Forward of 'carbot'\n"), "{}", one.out);
        assert!(one.out.contains("in distance: length = 100 cm from -1000 m"), "{}", one.out);
        assert!(one.out.contains("uses navigator, needs odometry, every 10 ms, "), "{}", one.out);
    }
    for (name, help) in [
        ("Fly", "help: 'afpc templates' lists"),
        ("Trun", "help: write 'Turn'; 'afpc templates' lists"),
        ("std.Wiat", "help: write 'Wait'"),
        ("carbto", "help: write 'carbot'"),
    ] {
        let said = place.afpc(&format!("templates {name}"));
        said.fails(2, &["there is no toolbox or template '", help]);
    }
    place.afpc("new greeter --toolbox").succeeds();
    let own = in_folder(&place, "greeter", "templates");
    assert!(own.out.contains("greeter: ") && own.out.contains("actor Wag"), "{}", own.out);
    let row = place.afpc("templates Row").out;
    assert!(row.contains("  in table: (a table)  The name of the table."), "{row}");
}
