//! `afpc log FILE`: the timeline, then deadlines, interruptions and coverage.

use std::fmt::Write;

use afp_log::LogData;
use afp_log::statistics::{Statistics, statistics};
use afp_session::Usage;

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

/// The components that ran, and the width of their path column under a heading. Components that
/// failed to start were never active and are left out.
fn ran<'a>(all: &'a [(String, Usage)], heading: &str) -> (Vec<&'a (String, Usage)>, usize) {
    let ran: Vec<_> = all.iter().filter(|(_, usage)| usage.starts + usage.faults > 0).collect();
    let width = ran.iter().map(|(path, _)| path.len()).max().unwrap_or(0);
    (ran, width.max(heading.len()))
}

fn elements(text: &mut String, all: &Statistics) {
    let (ran, width) = ran(&all.elements, "element");
    let _ = writeln!(text, "\n{:<width$}  activations  interruptions  faults  active", "element");
    for (path, usage) in ran {
        let Usage { starts, interruptions, faults, active, .. } = usage;
        let active = active.as_secs_f64();
        let _ = writeln!(
            text,
            "{path:<width$}  {starts:>11}  {interruptions:>13}  {faults:>6}  {active:.3} s"
        );
    }
}

fn supervisors(text: &mut String, all: &Statistics) {
    let (ran, width) = ran(&all.supervisors, "supervisor");
    if ran.is_empty() {
        return;
    }
    let _ = writeln!(
        text,
        "\n{:<width$}    polls  events  faults  missed late/long  skipped  worst",
        "supervisor"
    );
    for (path, usage) in ran {
        let Usage { polls, faults, late_releases, long_polls, skipped, .. } = usage;
        let (events, worst) = (usage.events(), usage.worst_lateness.as_secs_f64() * 1e3);
        let _ = writeln!(
            text,
            "{path:<width$}  {polls:>7}  {events:>6}  {faults:>6}  {late_releases:>11}/{long_polls:<4}  {skipped:>7}  {worst:.3} ms"
        );
    }
}

fn coverage(text: &mut String, all: &Statistics) {
    let whole = all.covered + all.uncovered.len() as u64;
    let _ = writeln!(text, "\nstates and events: {} of {whole} occurred", all.covered);
    for outcome in &all.uncovered {
        let _ = writeln!(text, "  never: {outcome}");
    }
    if all.lost > 0 {
        let _ = writeln!(text, "records lost while the log was written: {}", all.lost);
    }
}
