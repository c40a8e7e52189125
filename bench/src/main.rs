//! Measures what a step costs, beside peers that do the same work.
//!
//! All cases of a group run in turns within one process, so that their ratios mean something on a
//! machine that is busy with other things; the limits are on ratios alone.

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
mod plans;
mod report;
mod simulation;
mod step;
mod steps;
mod sweep;
mod transition;
mod web;

use std::process::ExitCode;

use clap::Parser;

use report::Report;

/// Measures the scheduler, the interpreter and the simulator against peers.
#[derive(Parser)]
struct Options {
    /// Run only groups whose name contains this.
    filter: Option<String>,
    /// Print one JSON array instead of the table.
    #[arg(long)]
    json: bool,
    /// Exit with 1 when a limit does not hold.
    #[arg(long)]
    check: bool,
    /// Turns per group; more are steadier.
    #[arg(long, default_value_t = 500)]
    rounds: u32,
    /// Do arithmetic for a while and nothing else: what the sweep is measured against.
    #[arg(long, hide = true)]
    arithmetic: bool,
}

fn main() -> ExitCode {
    let options = Options::parse();
    if options.arithmetic {
        sweep::work();
        return ExitCode::SUCCESS;
    }
    let mut report = Report::default();
    for (name, run) in GROUPS {
        if options.filter.as_ref().is_none_or(|filter| name.contains(filter.as_str())) {
            run(options.rounds, &mut report);
        }
    }
    if options.json {
        println!("{}", report.json());
    } else {
        print!("{}", report.table());
    }
    if options.check && !report.passed() { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

/// Measures something in so many turns.
type Group = fn(u32, &mut Report);

/// What there is to measure, by the name that a filter picks.
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
