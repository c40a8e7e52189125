//! `afpc test --mutate`: changes plans a little and reports which scenarios notice it.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::io::{IsTerminal, Write as _};
use std::sync::atomic::{AtomicUsize, Ordering};

use afp_dsl::files::{Disk, Files};
use afp_run::{EXIT_OK, EXIT_PLAN_ERROR, RunError, StopFlag, say};
use afp_test::mutate::{Bench, Judged, Mutant, MutantStatus, Suite, Tally, mutants};
use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};
use serde_json::json;

use super::Arguments;
use crate::Linked;
use crate::commands::{EXIT_STOPPED, print};
use crate::no_plan::NoPlan;
use crate::plan_file::PlanFile;

/// The maximum number of scenarios in a line of the table.
const NAMED: usize = 3;

/// The result for a plan's mutants.
enum Came {
    /// The share of noticed mutants.
    Share(f64),
    /// No scenario passes on the unchanged plan.
    NoJudge,
    /// The command was stopped before all mutants were judged.
    Stopped,
}

/// Mutates the plans of some files' scenarios. Returns the exit code, `code` if all is well.
///
/// # Errors
/// There are no scenarios although all files are valid, a scenario cannot run, a table cannot be
/// printed.
pub(super) fn run(
    files: &[PlanFile],
    code: u8,
    wanted: &Arguments,
    linked: &Linked<'_>,
) -> Result<u8, NoPlan> {
    let stop =
        StopFlag::on_signals().map_err(RunError::file("cannot handle", "signals".as_ref()))?;
    let mut plans: BTreeMap<&str, Vec<&PlanFile>> = BTreeMap::new();
    for file in files {
        for scenario in &file.compiled.scenarios {
            let known = plans.entry(&scenario.plan_file).or_default();
            if !known.iter().any(|known| std::ptr::eq(*known, file)) {
                known.push(file);
            }
        }
    }
    let invalid = tell_invalid(files);
    if plans.is_empty() && !invalid && code == EXIT_OK {
        let help = "write scenarios first, for example with 'afpc test --generate'";
        return Err(RunError::usage("there are no scenarios", help).into());
    }
    let mut code = if invalid { EXIT_PLAN_ERROR } else { code };
    for (plan, suites) in plans {
        match one_plan(plan, &suites, wanted, linked, &stop)? {
            Came::Share(share) => {
                if let Some(least) = wanted.at_least.filter(|least| share * 100.0 < *least) {
                    say(too_few(plan, share * 100.0, least));
                    code = EXIT_PLAN_ERROR;
                }
            }
            Came::NoJudge => code = EXIT_PLAN_ERROR,
            Came::Stopped => return Ok(stop.exit_code().unwrap_or(EXIT_STOPPED)),
        }
    }
    Ok(code)
}

/// Reports invalid scenarios and returns whether there are any.
fn tell_invalid(files: &[PlanFile]) -> bool {
    let mut any = false;
    for file in files {
        for invalid in &file.compiled.invalid {
            say(invalid.errors.render(&file.compiled.sources, true));
            any = true;
        }
    }
    any
}

/// The message for too few noticed mutants, with enough digits to distinguish both percentages.
fn too_few(plan: &str, percent: f64, least: f64) -> String {
    let digits = (2..17).find(|digits| {
        let shown = format!("{percent:.digits$}");
        shown.parse::<f64>().is_ok_and(|shown| shown < least)
    });
    let digits = digits.unwrap_or(17);
    format!(
        "{plan}: {percent:.digits$} % of the mutants are noticed; '--at-least' requires {least} %"
    )
}

fn one_plan(
    plan: &str,
    files: &[&PlanFile],
    wanted: &Arguments,
    linked: &Linked<'_>,
    stop: &StopFlag,
) -> Result<Came, NoPlan> {
    let Some(first) = files.first() else { return Ok(Came::Stopped) };
    let toolboxes = first.own.with_built_in()?;
    let mut sources = files.iter().flat_map(|file| file.compiled.plan_sources());
    let Some(source) = sources.find(|source| source.name == plan) else {
        return Ok(Came::Stopped);
    };
    let suites = files.iter().filter_map(|file| {
        let source = file.compiled.plan_sources().next()?.clone();
        Some(Suite { file: file.path.clone(), source })
    });
    let mut go_on = || !stop.is_raised();
    let disk = Disk::default();
    let with = (&toolboxes, &disk as &(dyn Files + Sync));
    let Some(bench) = Bench::new(plan, suites.collect(), with, linked.robot, &mut go_on)? else {
        return Ok(Came::Stopped);
    };
    if bench.judges() == 0 && !bench.failing.is_empty() {
        say(format_args!(
            "{plan}: all scenarios fail on the unchanged plan: fix them first ('afpc test' shows why)"
        ));
        return Ok(Came::NoJudge);
    }
    let mutants = mutants(&source.text, wanted.seed);
    let all = mutants.len();
    let judged = judge_all(&bench, mutants, stop);
    let tally = Tally::of(&judged);
    let text = match wanted.json {
        true => judged.iter().map(|each| format!("{}\n", object(plan, each))).collect(),
        false => table(plan, &bench, &judged),
    };
    print(&format!("{text}{}", sum(plan, &tally, wanted.json)))?;
    if judged.len() < all {
        say(format_args!("{plan}: stopped; {} of {all} mutants were judged", judged.len()));
        return Ok(Came::Stopped);
    }
    Ok(Came::Share(tally.share()))
}

/// Judges mutants on all cores, until the time is over or the command is stopped.
fn judge_all(bench: &Bench<'_>, mutants: Vec<Mutant>, stop: &StopFlag) -> Vec<Judged> {
    let (all, done) = (mutants.len(), AtomicUsize::new(0));
    let shown = std::io::stderr().is_terminal();
    let judge = |mutant| {
        if stop.is_raised() {
            return None;
        }
        let judged = bench.judge(mutant, &mut || !stop.is_raised());
        let number = done.fetch_add(1, Ordering::Relaxed) + 1;
        if shown {
            // Progress is optional: without a terminal, nothing is lost.
            let _ = write!(std::io::stderr(), "\r\x1b[K{number} of {all} mutants");
        }
        judged
    };
    let judged = mutants.into_par_iter().with_max_len(1).filter_map(judge).collect();
    if shown {
        let _ = write!(std::io::stderr(), "\r\x1b[K");
    }
    judged
}

/// The result of each mutant; unnoticed mutants come first.
fn table(plan: &str, bench: &Bench<'_>, judged: &[Judged]) -> String {
    let mut text = format!("{plan}: {} mutants, {} scenarios\n", judged.len(), bench.judges());
    for name in &bench.failing {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "  '{name}' fails anyway and judges nothing");
    }
    let change = |mutant: &Mutant| format!("{} becomes {}", mutant.was, mutant.is);
    let widest = judged.iter().map(|each| change(&each.mutant).chars().count()).max().unwrap_or(0);
    let mut sorted: Vec<_> = judged.iter().collect();
    sorted.sort_by_key(|each| order(&each.status));
    for Judged { mutant, status } in sorted {
        let place = format!("{}:{}", mutant.line, mutant.column);
        let (kind, change) = (mutant.kind.to_string(), change(mutant));
        let _ = writeln!(text, "{place:>8}  {kind:<8}  {change:<widest$}  {}", word(status));
    }
    text
}

fn order(status: &MutantStatus) -> u8 {
    match status {
        MutantStatus::Missed { changed: true } => 0,
        MutantStatus::Missed { changed: false } => 1,
        MutantStatus::Noticed(_) => 2,
        MutantStatus::Refused => 3,
    }
}

fn word(status: &MutantStatus) -> String {
    match status {
        MutantStatus::Refused => "does not compile".to_owned(),
        MutantStatus::Missed { changed: true } => "NOBODY noticed".to_owned(),
        MutantStatus::Missed { changed: false } => "changes no run".to_owned(),
        MutantStatus::Noticed(names) => {
            let named: Vec<_> = names.iter().take(NAMED).map(|name| format!("'{name}'")).collect();
            let more = match names.len().saturating_sub(NAMED) {
                0 => String::new(),
                more => format!(" and {more} more"),
            };
            format!("noticed by {}{more}", named.join(", "))
        }
    }
}

fn sum(plan: &str, tally: &Tally, json: bool) -> String {
    let Tally { noticed, missed, unchanged, refused } = *tally;
    let percent = tally.share() * 100.0;
    if json {
        let line = json!({
            "mutated": plan, "noticed": noticed, "missed": missed, "unchanged": unchanged,
            "refused": refused, "share": tally.share(),
        });
        return format!("{line}\n");
    }
    let all = noticed + missed;
    format!(
        "{noticed} of {all} mutants that change a run are noticed ({percent:.1} %); {unchanged} change none, {refused} do not compile\n"
    )
}

fn object(plan: &str, judged: &Judged) -> serde_json::Value {
    let Judged { mutant, status } = judged;
    let (word, by) = match status {
        MutantStatus::Refused => ("refused", &[][..]),
        MutantStatus::Missed { changed: true } => ("missed", &[][..]),
        MutantStatus::Missed { changed: false } => ("unchanged", &[][..]),
        MutantStatus::Noticed(names) => ("noticed", names.as_slice()),
    };
    json!({
        "file": plan, "line": mutant.line, "column": mutant.column, "kind": mutant.kind.to_string(),
        "was": mutant.was, "is": mutant.is, "status": word, "noticed_by": by,
    })
}
