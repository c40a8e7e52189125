//! Measures the cost of a step, compared with other libraries for the same work.
//!
//! All cases of a group take turns within one process, so that their ratios are meaningful on a
//! busy machine. Limits apply only to ratios.

mod allocations;
mod big_plan;
mod board;
mod check;
mod clocks;
mod copper;
mod debugger;
mod drawing;
mod editor;
mod measure;
mod page;
mod plans;
mod report;
mod simulation;
mod step;
mod steps;
mod sweep;
mod transition;
mod web;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;

use report::Report;

/// Measure the scheduler, the interpreter and the simulator against other libraries.
#[derive(Parser)]
struct Options {
    /// Run only groups whose name contains this.
    filter: Option<String>,
    /// Print one JSON array instead of the table.
    #[arg(long)]
    json: bool,
    /// Exit with 1 if a limit is exceeded.
    #[arg(long)]
    check: bool,
    /// Write the results as a page of the book.
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = page::PATH)]
    page: Option<PathBuf>,
    /// Turns per group; more give steadier results.
    #[arg(long, default_value_t = 500)]
    rounds: u32,
    /// Only do arithmetic for a while: the baseline of the sweep.
    #[arg(long, hide = true)]
    arithmetic: bool,
    /// Only repeat a step: the work whose instructions are counted.
    #[arg(long, hide = true)]
    steps: Option<u64>,
    /// Repeat the step of the plan with `suspend`.
    #[arg(long, hide = true)]
    suspending: bool,
}

fn main() -> ExitCode {
    let options = Options::parse();
    if options.arithmetic {
        sweep::work();
        return ExitCode::SUCCESS;
    }
    if let Some(steps) = options.steps {
        step::repeat(steps, options.suspending);
        return ExitCode::SUCCESS;
    }
    let machine = page::Machine::now();
    let mut report = Report::default();
    for (name, run) in GROUPS {
        if options.filter.as_ref().is_none_or(|filter| name.contains(filter.as_str())) {
            run(options.rounds, &mut report);
        }
    }
    if let Some(path) = &options.page
        && let Err(why) = std::fs::write(path, page::text(&machine, &report))
    {
        eprintln!("error: cannot write '{}': {why}", path.display());
        return ExitCode::FAILURE;
    }
    if options.json {
        println!("{}", report.json());
    } else {
        print!("{}", report.table());
    }
    if options.check && !report.passed() { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

/// Measures a group in that many turns.
type Group = fn(u32, &mut Report);

const GROUPS: &[(&str, Group)] = &[
    ("step", step::run),
    ("copper", copper::run),
    ("transition", transition::run),
    ("simulation", simulation::run),
    ("sweep", sweep::run),
    ("check", check::run),
    ("drawing", drawing::run),
    ("editor", editor::run),
    ("debugger", debugger::run),
    ("allocations", allocations::run),
    ("web", web::run),
];
