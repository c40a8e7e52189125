//! Tasks of the project: `cargo xtask test`, `bench`, `book`, `editors`, `fuzz`, `gallery`, `gate`,
//! `nightly`, `lint`, `wheels`.
//!
//! Each prints its steps and their times, and how to repeat only a failed step.

mod arm;
mod book;
mod dap;
mod deploy;
mod editors;
mod emulated;
mod engine;
mod fuzz;
mod gallery;
mod gate;
mod image;
mod install;
mod lines;
mod live;
mod needs;
mod npm;
mod opencv;
mod pi;
mod profiles;
mod python;
mod scxml;
mod shell;
mod studio;
mod suites;
mod systems;
mod vacuum;
mod wasm;
mod wheels;

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
    /// Runs every suite, or those named, and installs what they need under target/. A suite whose program is missing is
    /// named and left out.
    Test {
        /// Suites by name; all without any.
        suites: Vec<String>,
        /// Fails on a missing program; so does CI=true.
        #[arg(long)]
        all: bool,
    },
    /// Measures against peers; options go on to the benchmark (--json, --check, FILTER).
    Bench {
        /// Options of the benchmark.
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        options: Vec<String>,
    },
    /// Looks for texts that break a reader; needs a C++ compiler.
    Fuzz {
        /// Targets by name; all without any.
        targets: Vec<String>,
        /// How long each is searched for.
        #[arg(long, default_value_t = 60)]
        seconds: u32,
    },
    /// Tries what leaves the checkout: a plan on a microcontroller, in whose image any panic is refused; what an editor needs,
    /// for the web; an installed afpc; projects of their own; a Raspberry Pi.
    Gate {
        /// Suites by name; all without any.
        suites: Vec<String>,
    },
    /// Runs the long suites: hundreds of random plans, long runs, fuzzing, benchmarks with limits.
    Nightly {
        /// Suites by name; all without any.
        suites: Vec<String>,
    },
    /// Checks formatting, lints, and the links of doc comments.
    Lint {
        /// Suites by name; all without any.
        suites: Vec<String>,
    },
    /// Counts the lines of code of each crate, without blanks, comments and tests.
    Lines,
    /// Renders the book of docs/ with mdBook.
    Book,
    /// Packs the extension for Visual Studio Code and the grammar for tree-sitter.
    Editors,
    /// Draws, runs and sweeps the shipped plans for the gallery of the book.
    Gallery {
        /// Plans by name; all without any.
        plans: Vec<String>,
    },
    /// Builds the Python package's wheels, with the command line inside, and its source distribution, into target/wheels.
    Wheels {
        /// Machines by name (x86_64, aarch64); all without any.
        machines: Vec<String>,
    },
    /// Makes the studio's page and opens the studio; arguments go on to 'afpc studio'.
    Studio {
        /// Makes the page, nothing else.
        #[arg(long)]
        page: bool,
        /// Arguments of 'afpc studio'.
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<String>,
    },
}

fn main() -> ExitCode {
    let done = match Options::parse().chore {
        Chore::Test { suites, all } => suites::run(suites::TEST, &suites, all),
        Chore::Bench { options } => bench(&options),
        Chore::Fuzz { targets, seconds } => fuzz::run(&targets, seconds),
        Chore::Gate { suites } => suites::run(suites::GATE, &suites, true),
        Chore::Nightly { suites } => suites::run(suites::NIGHTLY, &suites, true),
        Chore::Lint { suites } => suites::run(suites::LINT, &suites, true),
        Chore::Lines => lines::print(),
        Chore::Book => book::run(),
        Chore::Editors => editors::pack(),
        Chore::Gallery { plans } => gallery::run(&plans),
        Chore::Wheels { machines } => wheels::run(&machines),
        Chore::Studio { page: true, .. } => studio::page(),
        Chore::Studio { arguments, .. } => studio::open(&arguments),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure(text)) => {
            eprintln!("{text}");
            ExitCode::FAILURE
        }
    }
}

fn bench(options: &[String]) -> Result<(), Failure> {
    let build = ["run", "--quiet", "--profile", "bench", "--package", "afp-bench", "--"];
    shell::run(cargo().args(build).args(options))
}
