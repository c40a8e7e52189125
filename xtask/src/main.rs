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

/// Run the tasks of the project.
#[derive(Parser)]
#[command(name = "cargo xtask")]
struct Options {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Run the tests, and install their packages under target/; skip a suite if its program is
    /// missing.
    Test {
        /// Names of suites [default: all]
        suites: Vec<String>,
        /// Fail if a program is missing, like CI=true
        #[arg(long)]
        all: bool,
    },
    /// Run the benchmarks; pass options to them (--json, --check, FILTER).
    Bench {
        /// Options of the benchmarks
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        options: Vec<String>,
    },
    /// Run the fuzz targets; needs a C++ compiler.
    Fuzz {
        /// Names of targets [default: all]
        targets: Vec<String>,
        /// Seconds for each target
        #[arg(long, default_value_t = 60)]
        seconds: u32,
    },
    /// Test builds for other targets: a microcontroller, the web, a Raspberry Pi, installed
    /// programs.
    Gate {
        /// Names of suites [default: all]
        suites: Vec<String>,
    },
    /// Run the long suites: random plans, long runs, fuzzing, benchmarks with limits.
    Nightly {
        /// Names of suites [default: all]
        suites: Vec<String>,
    },
    /// Check formatting, lints and the links of doc comments.
    Lint {
        /// Names of suites [default: all]
        suites: Vec<String>,
    },
    /// Count each crate's lines of code, without blank lines, comments and tests.
    Lines,
    /// Build the book of docs/ with mdBook.
    Book,
    /// Pack the Visual Studio Code extension and the tree-sitter grammar.
    Editors,
    /// Draw, run and sweep the shipped plans for the book's gallery.
    Gallery {
        /// Names of plans [default: all]
        plans: Vec<String>,
    },
    /// Build the Python wheels and the source distribution into target/wheels.
    Wheels {
        /// Machines, x86_64 or aarch64 [default: all]
        machines: Vec<String>,
    },
    /// Build and open the studio; pass arguments to 'afpc studio'.
    Studio {
        /// Build only the page
        #[arg(long)]
        page: bool,
        /// Arguments of 'afpc studio'
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<String>,
    },
}

fn main() -> ExitCode {
    let done = match Options::parse().task {
        Task::Test { suites, all } => suites::run(suites::TEST, &suites, all),
        Task::Bench { options } => bench(&options),
        Task::Fuzz { targets, seconds } => fuzz::run(&targets, seconds),
        Task::Gate { suites } => suites::run(suites::GATE, &suites, true),
        Task::Nightly { suites } => suites::run(suites::NIGHTLY, &suites, true),
        Task::Lint { suites } => suites::run(suites::LINT, &suites, true),
        Task::Lines => lines::print(),
        Task::Book => book::run(),
        Task::Editors => editors::pack(),
        Task::Gallery { plans } => gallery::run(&plans),
        Task::Wheels { machines } => wheels::run(&machines),
        Task::Studio { page: true, .. } => studio::page(),
        Task::Studio { arguments, .. } => studio::open(&arguments),
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
