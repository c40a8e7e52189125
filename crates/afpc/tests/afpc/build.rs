//! `afpc build`: the generated files, the errors, and the binary.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::common::{Place, said};

#[test]
fn without_cargo_the_crate_is_written_and_the_error_is_clear() {
    let place = Place::with_plan();
    let mut command = place.command();
    command.args(["build", "wall_following.afp"]).env("PATH", "").env("CARGO", "no-such-cargo");
    let said = said(command.output().unwrap());
    said.fails(1, &["is not installed", "help: install Rust"]);
    let folder = "target/afp/wall_following";
    for name in ["Cargo.toml", "Cargo.lock", "src/main.rs", "src/lib.rs"] {
        assert!(place.exists(&format!("{folder}/{name}")), "{name}");
    }
    let manifest = place.read(&format!("{folder}/Cargo.toml"));
    assert!(!manifest.contains("afp-dsl"), "{manifest}");
}

#[test]
fn a_folder_without_a_generated_crate_is_not_changed() {
    let place = Place::with_plan();
    place.write("mine/Cargo.toml", "[package]\nname = \"mine\"\n");
    let said = place.afpc("build wall_following.afp -o mine");
    said.fails(2, &["'mine' contains a crate that 'afpc' did not generate", "'-o DIR'"]);
    assert_eq!(place.files(), ["mine/Cargo.toml", "wall_following.afp"]);
}

#[test]
fn other_files_are_not_changed_if_there_is_no_crate() {
    let place = Place::with_plan();
    for name in ["src/main.rs", "wall_following.afp"] {
        let path = format!("mine/{name}");
        place.write(&path, "mine");
        let said = place.afpc("build wall_following.afp -o mine");
        said.fails(2, &[&format!("'{path}' exists, and 'afpc' did not generate it"), "'-o DIR'"]);
        assert_eq!(place.read(&path), "mine");
        assert_eq!(place.files(), [&path, "wall_following.afp"]);
        std::fs::remove_file(place.path(&path)).unwrap();
    }
    // The plan itself is in the place of its copy.
    let mut command = place.command();
    command.args(["build", "wall_following.afp", "-o", "."]).env("CARGO", "no-such-cargo");
    said(command.output().unwrap()).fails(1, &["is not installed"]);
}

#[test]
fn a_build_of_an_earlier_release_is_replaced() {
    let place = Place::with_plan();
    let old = "target/afp/wall_following";
    place.write(&format!("{old}/Cargo.toml"), "# Made by another release.\n");
    place.write(&format!("{old}/src/lib.rs"), "//! The plan.\n");
    place.write(&format!("{old}/src/gone.rs"), "");
    let mut command = place.command();
    command.args(["build", "wall_following.afp"]).env("CARGO", "no-such-cargo");
    said(command.output().unwrap()).fails(1, &["is not installed"]);
    assert!(place.read(&format!("{old}/src/lib.rs")).contains("WallFollowing"));
    assert!(!place.exists(&format!("{old}/src/gone.rs")));
}

#[test]
fn targets_of_later_releases_and_wrong_project_files_are_refused() {
    let place = Place::with_plan();
    let mcu = place.afpc("build wall_following.afp --target mcu");
    mcu.fails(2, &["'--target mcu' is not available yet", "name 'host', 'pi' or 'pi32'"]);
    place.write("afp.toml", "[afp]\npath = \"x\"\nversion = \"1\"\n");
    place.afpc("build wall_following.afp").fails(1, &["exactly one of", "afp.toml:1:2"]);
}

/// The build folder of this file's tests, so that the physics engine is built once.
fn shared_target() -> &'static Path {
    Path::new(concat!(env!("CARGO_TARGET_TMPDIR"), "/built-plans"))
}

/// A program built with `--live` can be watched; another program explains how to build it.
fn others_watch(place: &Place, deaf: &str) {
    let options = ["--live=0", "--speed", "max", "--until", "1s", "--log", "none", "--svg", "none"];
    let run = |binary: &str| {
        said(Command::new(binary).args(options).current_dir(place.path("")).output().unwrap())
    };
    run(deaf).fails(2, &["this program has no '--live'", "'afpc build --live'"]);
    let mut command = place.command();
    command.args(["build", "wall_following.afp", "--live", "-o", "watched"]);
    let built = said(command.env("CARGO_TARGET_DIR", shared_target()).output().unwrap());
    built.succeeds();
    let watched = run(built.out.lines().last().unwrap());
    watched.succeeds();
    assert!(watched.err.contains("live: ws://127.0.0.1:"), "{watched:?}");
}

#[test]
#[ignore = "builds the physics engine in release mode; `cargo xtask gate install` runs it"]
fn binary_and_interpreter_agree_over_twenty_seeds() {
    let place = Place::with_plan();
    let mut command = place.command();
    command.args(["build", "wall_following.afp"]).env("CARGO_TARGET_DIR", shared_target());
    let built = said(command.stderr(Stdio::inherit()).output().unwrap());
    built.succeeds();
    let binary = built.out.lines().last().unwrap();
    assert!(Path::new(binary).is_absolute() && Path::new(binary).is_file(), "{binary}");
    for seed in 0..20 {
        let options = ["--json", "--log", "none", "--svg", "none", "--seed", &seed.to_string()];
        let run = |command: &mut Command| {
            let output = command.args(options).current_dir(place.path("")).output().unwrap();
            let said = said(output);
            said.succeeds();
            said.out
        };
        let ours = run(place.command().args(["run", "wall_following.afp"]));
        assert_eq!(run(&mut Command::new(binary)), ours, "seed {seed}");
    }
    others_watch(&place, binary);
    let symbols = std::fs::read(binary).unwrap();
    let contains = |text: &str| symbols.windows(text.len()).any(|part| part == text.as_bytes());
    for stranger in ["afp_dsl", "LoadedPlan", "global_supervisors"] {
        assert!(!contains(stranger), "'{stranger}' is in the binary");
    }
}
