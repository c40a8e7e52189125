//! Chores of the project: `cargo xtask test`, `bench`, `gate`, `nightly`, `lint`, `book`.
//!
//! Each says what it runs, how long it took, and how to run just what failed.

mod book;
mod gate;
mod image;
mod install;
mod python;
mod shell;
mod suites;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use shell::{Failure, cargo};

/// Chores of the project.
#[derive(Parser)]
#[command(name = "cargo xtask")]
struct Options {
    #[command(subcommand)]
    chore: Chore,
}

#[derive(Subcommand)]
enum Chore {
    /// Runs every suite, or those named, and installs what they need under target/.
    Test {
        /// Suites by name; all without any.
        suites: Vec<String>,
    },
    /// Measures against peers; options go on to the benchmark (--json, --check, FILTER).
    Bench {
        /// Options of the benchmark.
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        options: Vec<String>,
    },
    /// Builds a plan for a microcontroller and refuses any panic in the image.
    Gate,
    /// Runs the long suites: hundreds of random plans, long runs, benchmarks with their limits.
    Nightly,
    /// Checks formatting and lints.
    Lint,
    /// Renders the book of docs/ with mdBook.
    Book,
}

fn main() -> ExitCode {
    let done = match Options::parse().chore {
        Chore::Test { suites } => suites::run(suites::TEST, &suites),
        Chore::Bench { options } => bench(&options),
        Chore::Gate => gate::run(),
        Chore::Nightly => suites::run(suites::NIGHTLY, &[]),
        Chore::Lint => suites::run(suites::LINT, &[]),
        Chore::Book => book::run(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure(text)) => {
            eprintln!("{text}");
            ExitCode::FAILURE
        }
    }
}

/// Builds and runs the benchmark.
fn bench(options: &[String]) -> Result<(), Failure> {
    let build = ["run", "--quiet", "--profile", "bench", "--package", "afp-bench", "--"];
    shell::run(cargo().args(build).args(options))
}
