//! The output of `afpc sweep`: progress, results, and failures with their causes.

use std::cell::Cell;
use std::fmt::Write;

use afp_run::say;
use afp_sweep::{Ending, Findings, Group, Measure, Outcome, OutputFiles, Spread, Sweep, Touched};
use indicatif::{ProgressBar, ProgressState, ProgressStyle};
use serde_json::{Value, json};

use crate::commands::{BAD, GOOD, QUIET, print};
use crate::no_plan::NoPlan;

/// The maximum number of printed groups; the table has all of them.
const GROUPS: usize = 12;
/// The bar with its estimate.
const BAR: &str = "{bar:32} {pos} of {len} runs, {rate}, {eta} left{msg}";

/// Reports the progress.
pub(super) struct Reporter<'a> {
    sweep: &'a Sweep,
    json: bool,
}

/// The progress bar on standard error, only in a terminal.
pub(super) struct Bar {
    bar: ProgressBar,
    failed: Cell<u64>,
}

impl<'a> Reporter<'a> {
    pub fn new(sweep: &'a Sweep, json: bool) -> Self {
        Reporter { sweep, json }
    }

    /// Prints that a sweep continues, and how to restart it.
    pub fn head(&self, output: &OutputFiles, done: usize) {
        let (all, journal) = (self.sweep.len(), output.journal.display());
        if done as u64 == all {
            say(format_args!("all {all} runs are done ({journal}); '--restart' repeats them"));
        } else if done > 0 {
            say(format_args!(
                "continuing: {done} of {all} runs are done ({journal}); '--restart' starts over"
            ));
        }
    }

    /// A bar for the remaining runs.
    pub fn bar(&self, left: u64) -> Bar {
        let bar = ProgressBar::new(left);
        // With an invalid template, the bar keeps its default style.
        if let Ok(style) = ProgressStyle::with_template(BAR) {
            let rate = |state: &ProgressState, to: &mut dyn Write| {
                let _ = write!(to, "{:.1} a second", state.per_sec());
            };
            bar.set_style(style.with_key("rate", rate));
        }
        Bar { bar, failed: Cell::new(0) }
    }

    /// Prints the results, or the partial results of a stopped sweep.
    pub fn end(
        &self,
        outcomes: &[Outcome],
        findings: &Findings,
        written: Option<&OutputFiles>,
    ) -> Result<(), NoPlan> {
        match self.json {
            true => print(&self.lines(outcomes, findings))?,
            false => print(&self.summary(outcomes, findings, written))?,
        };
        Ok(())
    }

    fn lines(&self, outcomes: &[Outcome], findings: &Findings) -> String {
        let runs = outcomes.iter().map(|outcome| self.object(outcome));
        let mut text: String = runs.map(|run| format!("{run}\n")).collect();
        let endings =
            findings.endings.iter().map(|(it, count)| (it.name().to_owned(), json!(count)));
        let measures = findings.measures.iter().map(|(measure, spread)| {
            let Spread { min, median, max } = spread;
            (measure.name().to_owned(), json!({ "min": min, "median": median, "max": max }))
        });
        let summary = json!({
            "runs": outcomes.len(), "of": self.sweep.len(),
            "endings": endings.collect::<serde_json::Map<_, _>>(),
            "measures": measures.collect::<serde_json::Map<_, _>>(),
            "touched": findings.touched.iter().map(|it| self.touched_object(it)).collect::<Vec<_>>(),
            "groups": findings.groups.iter().map(|group| self.group_object(group)).collect::<Vec<_>>(),
        });
        text += &format!("{}\n", json!({ "summary": summary }));
        text
    }

    /// A run, without machine-dependent values.
    fn object(&self, outcome: &Outcome) -> Value {
        let row = self.sweep.row(outcome.run);
        let mut object = json!(outcome);
        if let Some(map) = object.as_object_mut() {
            map.remove("took_s");
            // A run that never started has no measures.
            let nothing = Measure::ALL.into_iter().filter(|it| it.of(outcome).is_none());
            map.extend(nothing.map(|measure| (measure.name().to_owned(), Value::Null)));
            map.insert("world".to_owned(), json!(row.world.name()));
            map.insert("seed".to_owned(), json!(row.seed));
            let values = row.values.iter().map(|(name, point)| {
                ((*name).to_owned(), json!({ "text": point.text, "si": point.si }))
            });
            map.insert("values".to_owned(), values.collect());
            map.insert("command".to_owned(), json!(self.sweep.command(&row)));
        }
        object
    }

    fn touched_object(&self, touched: &Touched) -> Value {
        let Touched { name, runs, lasted_s, longest } = touched;
        let command = self.sweep.command(&self.sweep.row(*longest));
        json!({ "name": name, "runs": runs, "lasted_s": lasted_s, "command": command })
    }

    fn group_object(&self, group: &Group) -> Value {
        let Group { ending, place, why, count, run } = group;
        let command = self.sweep.command(&self.sweep.row(*run));
        json!({
            "ending": ending, "where": place, "why": why, "count": count, "command": command,
        })
    }

    fn summary(
        &self,
        outcomes: &[Outcome],
        findings: &Findings,
        written: Option<&OutputFiles>,
    ) -> String {
        let mut text = String::new();
        // Writing to a string cannot fail.
        for group in findings.groups.iter().filter(|it| !it.ending.is_failure()).take(GROUPS) {
            let _ = writeln!(text, "{}", line(group));
        }
        for group in findings.groups.iter().filter(|it| it.ending.is_failure()).take(GROUPS) {
            let command = self.sweep.command(&self.sweep.row(group.run));
            let _ = writeln!(text, "{}\n        {QUIET}again:{QUIET:#} {command}", line(group));
        }
        text += &self.touched(&findings.touched);
        if !findings.measures.is_empty() {
            let _ =
                writeln!(text, "\n{QUIET}{:>31} {:>10} {:>10}{QUIET:#}", "min", "median", "max");
        }
        for (measure, Spread { min, median, max }) in &findings.measures {
            let (name, digits) = shown(measure);
            let values = [min, median, max].map(|value| format!("{value:.digits$}"));
            let [min, median, max] = values;
            let _ = writeln!(text, "{name:>20} {min:>10} {median:>10} {max:>10}");
        }
        let _ = writeln!(text, "\n{}", self.last_line(outcomes, findings));
        for (path, _) in written.iter().flat_map(|output| &output.tables) {
            let _ = writeln!(text, "{QUIET}table:{QUIET:#} {}", path.display());
        }
        text
    }

    /// The touched objects, with durations and numbers of runs.
    fn touched(&self, touched: &[Touched]) -> String {
        let mut text = String::new();
        if !touched.is_empty() {
            text += &format!("\n{QUIET}{:>31} {:>10}{QUIET:#}\n", "runs", "time, s");
        }
        for Touched { name, runs, lasted_s, .. } in touched.iter().take(GROUPS) {
            let name = format!("touched {name}");
            text += &format!("{name:>20} {runs:>10} {lasted_s:>10.1}\n");
        }
        // The worst run, for a closer look.
        if let Some(first) = touched.first() {
            let command = self.sweep.command(&self.sweep.row(first.longest));
            text += &format!("        {QUIET}longest:{QUIET:#} {command}\n");
        }
        text
    }

    fn last_line(&self, outcomes: &[Outcome], findings: &Findings) -> String {
        let failed = findings.endings.iter().filter(|(ending, _)| ending.is_failure());
        let failed: u64 = failed.map(|(_, count)| count).sum();
        let (done, all) = (outcomes.len(), self.sweep.len());
        let style = if failed == 0 { GOOD } else { BAD };
        let simulated: f64 = outcomes.iter().map(|outcome| outcome.time_s).sum();
        let rest = match done as u64 == all {
            true => String::new(),
            false => ", stopped; the same command continues".to_owned(),
        };
        format!(
            "{style}{done} of {all} runs, {failed} failed{style:#}{rest}  \
             {QUIET}{simulated:.0} s simulated{QUIET:#}"
        )
    }
}

impl Bar {
    pub fn done(&self, outcome: &Outcome) {
        if outcome.ending.is_failure() {
            self.failed.set(self.failed.get() + 1);
            self.bar.set_message(format!(", {} failed", self.failed.get()));
        }
        self.bar.inc(1);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// A line for runs that ended alike.
fn line(group: &Group) -> String {
    let Group { ending, place, why, count, .. } = group;
    let style = if ending.is_failure() { BAD } else { GOOD };
    let how = match ending {
        Ending::TimeLimit => "time was up",
        Ending::NotStarted => "not started",
        other => other.name(),
    };
    let place = if place.is_empty() { String::new() } else { format!(" in {place}") };
    let why = match ending {
        Ending::TimeLimit => String::new(),
        _ => format!(": {why}"),
    };
    format!("{count:>7} {style}{how}{style:#}{place}{why}")
}

/// The printed form of a measure: its name and its number of digits.
fn shown(measure: &Measure) -> (String, usize) {
    match measure {
        Measure::Time => ("time, s".to_owned(), 2),
        Measure::Distance => ("distance, m".to_owned(), 2),
        Measure::Collisions => ("collisions".to_owned(), 1),
        Measure::Interruptions => ("interruptions".to_owned(), 1),
        Measure::Misses => ("missed".to_owned(), 1),
        // The last part of a column's name is the unit.
        Measure::Figure(name) => match name.rsplit_once('_') {
            Some((name, unit @ ("m" | "s"))) => (format!("{}, {unit}", name.replace('_', " ")), 3),
            _ => (name.replace('_', " "), 3),
        },
    }
}
