//! `afpc build --target pi`: the tools for cargo, or the missing tools and how to install them.
//!
//! All tools are scripts that imitate the real tools, in the only folder of the path.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::common::{Place, Said, said};

/// The tools, as shell scripts.
const TOOLS: &[(&str, &str)] = &[
    (
        "cargo",
        "echo \"$@\" > called\n\
         echo \"linker=$CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER\" >> called\n\
         echo \"linker32=$CARGO_TARGET_ARMV7_UNKNOWN_LINUX_GNUEABIHF_LINKER\" >> called\n\
         echo \"cc=$CC_aarch64_unknown_linux_gnu\" >> called\n\
         echo '{\"executable\":\"/there/plan\"}'",
    ),
    (
        "rustc",
        "case \"$1\" in\n--print) echo nowhere ;;\n*) echo 'host: x86_64-unknown-linux-gnu' ;;\nesac",
    ),
    (
        "rustc with library",
        "case \"$1\" in\n--print) echo . ;;\n*) echo 'host: x86_64-unknown-linux-gnu' ;;\nesac",
    ),
    (
        "rustc on a pi",
        "case \"$1\" in\n--print) echo . ;;\n*) echo 'host: aarch64-unknown-linux-gnu' ;;\nesac",
    ),
    ("rustup", ""),
    ("apt-get", ""),
    ("sudo", ""),
    ("aarch64-linux-gnu-gcc", "echo /usr/aarch64-linux-gnu/lib/crt1.o"),
    ("aarch64-linux-gnu-gcc without C library", "echo crt1.o"),
    ("arm-linux-gnueabihf-gcc", "echo /usr/arm-linux-gnueabihf/lib/crt1.o"),
    ("zig", "echo 0.15.2"),
    ("python3 without zig", "exit 1"),
    ("python3", "echo 0.15.2"),
];

/// The available tools in addition to cargo, and the expected message.
const MISSING: &[(&[&str], &[&str])] = &[
    (
        &["rustc", "rustup", "apt-get", "sudo"],
        &[
            "cannot build for a 64-bit Raspberry Pi: Rust's standard library for the target and a C compiler and linker for \
             the target are missing",
            "run 'rustup target add aarch64-unknown-linux-gnu && sudo apt-get install -y gcc-aarch64-linux-gnu \
             libc6-dev-arm64-cross', then the same command again",
        ],
    ),
    (
        &["rustc", "rustup", "aarch64-linux-gnu-gcc"],
        &[
            "Rust's standard library for the target is missing",
            "run 'rustup target add aarch64-unknown-linux-gnu', then",
        ],
    ),
    (
        &["rustc", "aarch64-linux-gnu-gcc"],
        &[
            "install Rust from https://rustup.rs, then run 'rustup target add aarch64-unknown-linux-gnu'",
        ],
    ),
    (
        &["rustc with library", "apt-get"],
        &[
            "a C compiler and linker for the target is missing",
            "run 'apt-get install -y gcc-aarch64-linux-gnu libc6-dev-arm64-cross', then",
        ],
    ),
    (
        &["rustc with library", "aarch64-linux-gnu-gcc without C library", "apt-get", "sudo"],
        &["run 'sudo apt-get install -y gcc-aarch64-linux-gnu libc6-dev-arm64-cross', then"],
    ),
    (
        &["rustc with library", "python3 without zig"],
        &["run 'python3 -m pip install ziglang', then"],
    ),
    // The compiler of another machine does not help.
    (&["rustc with library", "arm-linux-gnueabihf-gcc"], &["linker for the target is missing"]),
];

#[test]
fn missing_tools_are_one_message_with_the_command_that_installs_them() {
    let _turn = turn();
    for (tools, texts) in MISSING {
        let place = Place::with_plan();
        let said = build(&place, tools, "pi");
        said.fails(1, texts);
        assert_eq!(said.err.matches("error").count(), 1, "{tools:?}: {}", said.err);
        assert!(!place.exists("called") && !place.exists("target"), "{tools:?}");
    }
}

#[test]
fn cargo_is_called_with_the_available_tools() {
    let _turn = turn();
    let cases: &[(&[&str], &str, &str)] = &[
        (
            &["rustc with library", "aarch64-linux-gnu-gcc", "zig"],
            "pi",
            "linker=aarch64-linux-gnu-gcc",
        ),
        (
            &["rustc with library", "arm-linux-gnueabihf-gcc"],
            "pi32",
            "linker32=arm-linux-gnueabihf-gcc",
        ),
        // No linker is set if the machine's own linker fits.
        (&["rustc on a pi"], "pi", "linker="),
        (
            &["rustc with library", "zig"],
            "pi",
            "/target/afp/build/zig/aarch64-unknown-linux-gnu/cc",
        ),
        (
            &["rustc with library", "python3"],
            "pi",
            "/target/afp/build/zig/aarch64-unknown-linux-gnu/cc",
        ),
    ];
    for (tools, target, wanted) in cases {
        let place = Place::with_plan();
        let said = build(&place, tools, target);
        said.succeeds();
        assert_eq!(said.out, "/there/plan\n");
        let called = place.read("called");
        assert!(called.lines().any(|line| line.ends_with(wanted)), "{tools:?}: {called}");
        let triple = if *target == "pi" {
            "aarch64-unknown-linux-gnu"
        } else {
            "armv7-unknown-linux-gnueabihf"
        };
        assert!(called.contains(&format!("--target {triple}")), "{called}");
    }
}

#[test]
fn zig_is_called_without_arguments_that_it_does_not_understand() {
    let _turn = turn();
    let place = Place::with_plan();
    build(&place, &["rustc with library", "zig"], "pi").succeeds();
    tool(&place, "zig", "printf '%s|' \"$@\"");
    let scripts = "target/afp/build/zig/aarch64-unknown-linux-gnu";
    let call = |script: &str, words: &[&str]| {
        let mut command = std::process::Command::new(place.path(&format!("{scripts}/{script}")));
        said(command.args(words).env("PATH", place.path("bin")).output().unwrap()).out
    };
    let compiled = call("cc", &["-c", "--target=aarch64-unknown-linux-gnu", "a b.c"]);
    assert_eq!(compiled, "cc|-target|aarch64-linux-gnu|-c|a b.c|");
    assert_eq!(call("ar", &["cq", "lib.a"]), "ar|cq|lib.a|");
}

#[test]
fn a_linker_from_the_environment_is_not_changed() {
    let _turn = turn();
    let place = Place::with_plan();
    equip(&place, &["rustc with library", "aarch64-linux-gnu-gcc"]);
    let mut command = place.command();
    command.args(["build", "wall_following.afp", "--target", "pi"]).env("PATH", place.path("bin"));
    command.env_remove("CARGO").env_remove("RUSTC");
    command.env("CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER", "mine");
    said(command.output().unwrap()).succeeds();
    assert!(place.read("called").contains("linker=mine\n"), "{}", place.read("called"));
}

#[test]
fn a_plan_that_needs_a_faster_machine_is_not_built() {
    let _turn = turn();
    let place = Place::with_plan();
    place.write("afp.toml", "[target.pi]\ncapacity = 0.0001\n");
    let said = build(&place, &["rustc with library", "aarch64-linux-gnu-gcc"], "pi");
    said.fails(1, &["error[E0404]", "'pi'"]);
    assert!(!place.exists("called"));
}

/// One test at a time: a script cannot be executed while a forked process still has it open for
/// writing.
fn turn() -> MutexGuard<'static, ()> {
    static TURN: Mutex<()> = Mutex::new(());
    TURN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Builds with only these tools.
fn build(place: &Place, tools: &[&str], target: &str) -> Said {
    equip(place, tools);
    let mut command = place.command();
    command.args(["build", "wall_following.afp", "--target", target]);
    command.env("PATH", place.path("bin")).env_remove("CARGO").env_remove("RUSTC");
    said(command.output().unwrap())
}

fn equip(place: &Place, tools: &[&str]) {
    for name in tools.iter().chain(&["cargo"]) {
        let (_, text) = TOOLS.iter().find(|(known, _)| known == name).unwrap();
        tool(place, name.split(' ').next().unwrap(), text);
    }
}

fn tool(place: &Place, name: &str, text: &str) {
    let path = format!("bin/{name}");
    place.write(&path, &format!("#!/bin/sh\n{text}\n"));
    fs::set_permissions(place.path(&path), fs::Permissions::from_mode(0o755)).unwrap();
}
