//! The output of `afpc test`: a line for each scenario, the failures, a sum.

use std::fmt::Write;
use std::io::{IsTerminal, Write as _};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use afp_core::Ending;
use afp_run::say;
use afp_test::Verdict;
use anstream::adapter::strip_str;
use serde_json::json;

use super::{Case, Done, Failure, Used};
use crate::commands::{BAD, GOOD, QUIET, print};
use crate::no_plan::NoPlan;

/// Reports the progress.
pub(super) struct Reporter {
    all: usize,
    done: AtomicUsize,
    json: bool,
    progress: bool,
    /// The reason why a line could not be printed.
    failure: Mutex<Option<NoPlan>>,
}

/// Shows the progress; without a terminal, nothing is lost.
fn show(text: &str) {
    let _ = anstream::stderr().write_all(text.as_bytes());
}

impl Reporter {
    pub fn new(all: usize, json: bool) -> Self {
        let progress = std::io::stderr().is_terminal();
        Reporter { all, done: AtomicUsize::new(0), json, progress, failure: Mutex::default() }
    }

    /// Reports a finished scenario; all threads call it.
    pub fn done(&self, case: &Case<'_>, done: &Done) {
        let number = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        if self.progress {
            show("\r\x1b[K");
        }
        if !self.json
            && let Err(failure) = print(&format!("{}\n", line(case, done)))
            && let Ok(mut first) = self.failure.lock()
        {
            first.get_or_insert(failure);
        }
        if self.progress && number < self.all {
            show(&format!("{QUIET}{number} of {}{QUIET:#}", self.all));
        }
    }

    /// Reports the failures in the order of the files, after the last case or after a stop.
    ///
    /// # Errors
    /// Something could not be printed, now or earlier.
    pub fn end(&self, done: &[(&Case<'_>, Done)], seconds: f64) -> Result<(), NoPlan> {
        if let Some(failure) = self.failure.lock().ok().and_then(|mut first| first.take()) {
            return Err(failure);
        }
        if self.progress {
            show("\r\x1b[K");
        }
        let mut text = String::new();
        for (case, done) in done {
            if self.json {
                let _ = writeln!(text, "{}", object(case, done));
            } else if !done.passed() {
                let _ = writeln!(text, "\n{}", broken(case, done));
            }
        }
        if !self.json {
            text += &self.last_line(done, seconds);
        }
        print(&text)?;
        if self.json && done.len() < self.all {
            say(format_args!("stopped; {} of {} scenarios were run", done.len(), self.all));
        }
        Ok(())
    }

    fn last_line(&self, done: &[(&Case<'_>, Done)], seconds: f64) -> String {
        let failed = done.iter().filter(|(_, done)| !done.passed()).count();
        let verdicts = done.iter().filter_map(|(_, done)| done.verdict.as_ref().ok());
        let simulated = verdicts.fold(0.0, |sum, it| sum + it.length().as_secs_f64());
        let style = if failed == 0 { GOOD } else { BAD };
        let stopped = match done.len() < self.all {
            true => format!("; {} of {}, stopped", done.len(), self.all),
            false => String::new(),
        };
        format!(
            "\n{style}{} passed, {failed} failed{style:#}{stopped}  \
             {QUIET}{simulated:.1} s simulated in {seconds:.2} s{QUIET:#}\n",
            done.len() - failed
        )
    }
}

/// The usage of each plan.
pub(super) fn coverage(plans: &[Used<'_>], json: bool) -> Result<(), NoPlan> {
    for plan in plans.iter().map(|used| &used.coverage) {
        if !json {
            print(&format!("\n{}", plan.text()))?;
            continue;
        }
        let parts = plan.parts.iter().map(
            |part| json!({ "kind": part.kind.plural(), "name": part.name, "count": part.count }),
        );
        let line = json!({ "coverage": plan.plan, "parts": parts.collect::<Vec<_>>() });
        print(&format!("{line}\n"))?;
    }
    Ok(())
}

fn line(case: &Case<'_>, done: &Done) -> String {
    let (Case { file, line, .. }, name) = (case, case.name());
    let (style, word) = if done.passed() { (GOOD, "ok") } else { (BAD, "FAILED") };
    let length = done.verdict.as_ref().map_or(0.0, |verdict| verdict.length().as_secs_f64());
    format!(
        "{style}{word:>6}{style:#} {length:>8.3} s  {name}  {QUIET}{}:{line}{QUIET:#}",
        file.display()
    )
}

fn broken(case: &Case<'_>, done: &Done) -> String {
    let (Case { file, line, .. }, name) = (case, case.name());
    let mut text = format!("{BAD}{name}{BAD:#}\n  --> {}:{line}\n", file.display());
    match &done.verdict {
        Ok(verdict) => text += &verdict.report(),
        Err(Failure::Invalid(said)) => text += said,
        Err(Failure::Run(error)) => text += &format!("{}\n", error.styled()),
    }
    if let Some(log) = &done.log {
        let _ = writeln!(text, "  log: {}", log.display());
    }
    text
}

fn object(case: &Case<'_>, done: &Done) -> serde_json::Value {
    let Case { file, line, .. } = case;
    let (name, plan) = (case.name(), case.plan());
    let head = json!({
        "file": file.display().to_string(), "line": line, "scenario": name, "plan": plan,
        "passed": done.passed(), "log": done.log.as_ref().map(|log| log.display().to_string()),
    });
    let more = match &done.verdict {
        Ok(verdict) => verdict_object(verdict),
        Err(Failure::Invalid(said)) => json!({ "error": strip_str(said).to_string() }),
        Err(Failure::Run(error)) => json!({ "error": error.to_string() }),
    };
    merged(head, more)
}

fn verdict_object(verdict: &Verdict) -> serde_json::Value {
    let ending = verdict.ending.map(|ending| match ending {
        Ending::Ok => "ok",
        Ending::Interrupted => "interrupted",
        Ending::Error(_) => "error",
    });
    let broken = verdict.broken.iter().map(|broken| {
        let names: Vec<_> = names(&broken.text).collect();
        let at = broken.at.as_secs_f64();
        json!({ "text": broken.text, "names": names, "at_s": at, "why": broken.why })
    });
    json!({
        "simulated_s": verdict.length().as_secs_f64(), "ending": ending,
        "broken": broken.collect::<Vec<_>>(), "panic": verdict.panic, "trace": format!("{:016x}", verdict.trace),
    })
}

/// The paths and words of an expectation: `forward.touch.TouchSensorPressed`.
fn names(text: &str) -> impl Iterator<Item = &str> {
    let words = text.split(|each: char| !each.is_alphanumeric() && !matches!(each, '_' | '.'));
    words.filter(|word| word.starts_with(|first: char| first.is_alphabetic() || first == '_'))
}

/// One object with the keys of both.
fn merged(mut head: serde_json::Value, more: serde_json::Value) -> serde_json::Value {
    if let (Some(head), serde_json::Value::Object(more)) = (head.as_object_mut(), more) {
        head.extend(more);
    }
    head
}
