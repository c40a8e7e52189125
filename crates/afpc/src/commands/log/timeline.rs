//! `afpc log FILE`: the timeline, then deadlines, interruptions and coverage.

use std::fmt::Write;

use afp_log::LogData;
use afp_log::statistics::{ElementStatistics, Statistics, SupervisorStatistics, statistics};

/// The whole text.
pub(super) fn text(log: &LogData) -> String {
    let mut text = String::new();
    for line in afp_run::timeline(log) {
        let _ = writeln!(text, "{line}");
    }
    let all = statistics(log);
    elements(&mut text, &all);
    supervisors(&mut text, &all);
    coverage(&mut text, &all);
    text
}

fn elements(text: &mut String, all: &Statistics) {
    // What failed to start was never active.
    let used = |element: &&ElementStatistics| element.activations + element.faults > 0;
    let ran: Vec<_> = all.elements.iter().filter(used).collect();
    let width = ran.iter().map(|element| element.path.len()).max().unwrap_or(0).max(7);
    let _ = writeln!(text, "\n{:<width$}  activations  interruptions  faults  active", "element");
    for element in ran {
        let _ = writeln!(
            text,
            "{:<width$}  {:>11}  {:>13}  {:>6}  {:.3} s",
            element.path,
            element.activations,
            element.interruptions,
            element.faults,
            element.active.as_secs_f64()
        );
    }
}

fn supervisors(text: &mut String, all: &Statistics) {
    let used = |each: &&SupervisorStatistics| each.activations + each.faults > 0;
    let ran: Vec<_> = all.supervisors.iter().filter(used).collect();
    if ran.is_empty() {
        return;
    }
    let width = ran.iter().map(|each| each.path.len()).max().unwrap_or(0).max(10);
    let _ = writeln!(
        text,
        "\n{:<width$}    polls  events  faults  missed late/long  skipped  worst",
        "supervisor"
    );
    for each in ran {
        let _ = writeln!(
            text,
            "{:<width$}  {:>7}  {:>6}  {:>6}  {:>11}/{:<4}  {:>7}  {:.3} ms",
            each.path,
            each.polls,
            each.events,
            each.faults,
            each.late_releases,
            each.long_polls,
            each.skipped,
            each.worst_lateness.as_secs_f64() * 1e3
        );
    }
}

fn coverage(text: &mut String, all: &Statistics) {
    let whole = all.covered + all.uncovered.len() as u64;
    let _ = writeln!(text, "\nstates and events: {} of {whole} came", all.covered);
    for outcome in &all.uncovered {
        let _ = writeln!(text, "  never: {outcome}");
    }
    if all.lost > 0 {
        let _ = writeln!(text, "records lost while the log was written: {}", all.lost);
    }
}
