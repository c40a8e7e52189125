//! Fuzzes the readers, guided by coverage.

use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::{fs, thread};

use crate::shell::{Failure, cargo, program, root, run as run_command, target};

/// The tool that builds fuzzers, as cargo names it.
const TOOL: &str = "cargo-fuzz@0.13.2";

/// Seed texts, in addition to the corpus of each target.
const SEEDS: &[(&str, &[&str])] = &[
    ("parser", PLANS),
    ("checker", PLANS),
    ("formatter", PLANS),
    ("edits", PLANS),
    ("settings", &[]),
    ("layout", &[]),
    ("world", &["worlds"]),
    ("map", &[]),
    ("scenario", &["plans/tests"]),
    ("messages", &[]),
    ("debugger", &[]),
    ("controller", &[]),
    ("ugv", &[]),
    ("deploy", &[]),
    ("frames", &[]),
];

const PLANS: &[&str] = &[
    "plans",
    "crates/afp-toolboxes/toolboxes",
    "crates/afp-dsl/tests/errors",
    "crates/afp-dsl/tests/graph",
    "crates/afp-dsl/tests/language",
];

/// Longest input, in bytes; longer inputs find nothing more.
const LONGEST: usize = 16_384;

/// Fuzzes the named targets, or all, for this many seconds each, one per core.
///
/// # Errors
/// An unknown target, no C++ compiler, or a finding; the message names its file.
pub fn run(names: &[String], seconds: u32) -> Result<(), Failure> {
    if let Some(name) = names.iter().find(|name| !SEEDS.iter().any(|(known, _)| known == name)) {
        let known: Vec<_> = SEEDS.iter().map(|(known, _)| *known).collect();
        return Err(format!("no target '{name}'; there are: {}", known.join(", ")).into());
    }
    let wanted: Vec<_> = SEEDS
        .iter()
        .filter(|(name, _)| names.is_empty() || names.iter().any(|n| n == name))
        .collect();
    let tool = tool()?;
    for (name, _) in &wanted {
        run_command(cargo_fuzz(&tool, "build").arg(name))?;
    }
    let next = AtomicUsize::new(0);
    let findings = Mutex::new(Vec::new());
    let work = || {
        while let Some((name, seeds)) = wanted.get(next.fetch_add(1, Ordering::Relaxed)) {
            if let Err(Failure(why)) = search(&tool, name, seeds, seconds) {
                findings.lock().unwrap_or_else(|broken| broken.into_inner()).push(why);
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(work);
        }
    });
    let findings = findings.into_inner().unwrap_or_else(|broken| broken.into_inner());
    if findings.is_empty() { Ok(()) } else { Err(Failure(findings.join("\n"))) }
}

/// Runs one fuzzer; its corpus is kept under target/, its findings under fuzz/artifacts/.
fn search(tool: &PathBuf, name: &str, seeds: &[&str], seconds: u32) -> Result<(), Failure> {
    let learnt = target().join("xtask/fuzz").join(name);
    fs::create_dir_all(&learnt)?;
    let mut command = cargo_fuzz(tool, "run");
    command.arg(name).arg(&learnt).arg(root().join("fuzz/corpus").join(name));
    command.args(seeds.iter().map(|seed| root().join(seed)));
    command.args([
        "--",
        "-timeout=10",
        "-rss_limit_mb=4096",
        "-print_final_stats=1",
        "-verbosity=0",
    ]);
    command.arg(format!("-max_total_time={seconds}")).arg(format!("-max_len={LONGEST}"));
    command.arg(format!("-dict={}", root().join("fuzz/afp.dict").display()));
    run_command(&mut command).map_err(|Failure(why)| {
        Failure(format!(
            "{why}\nhelp: fix the error in fuzz/artifacts/{name}/, and keep the file in fuzz/corpus/{name}/"
        ))
    })
}

/// A subcommand of the tool, with the common options.
///
/// It runs without a sanitizer, and thus with the stable compiler: there is no unsafe code.
fn cargo_fuzz(tool: &PathBuf, what: &str) -> std::process::Command {
    let mut command = program(tool);
    command.args(["fuzz", what, "--fuzz-dir", "fuzz", "--features", "engine"]);
    command.args(["--sanitizer", "none"]);
    // Builds in a third of the time and runs nearly as fast.
    command
        .env("CARGO_PROFILE_RELEASE_LTO", "off")
        .env("CARGO_PROFILE_RELEASE_CODEGEN_UNITS", "16");
    command
}

fn tool() -> Result<PathBuf, Failure> {
    let home = target().join("xtask/tools");
    let install = ["install", "--quiet", "--locked", TOOL, "--root"];
    run_command(cargo().args(install).arg(&home))?;
    Ok(home.join("bin/cargo-fuzz"))
}
