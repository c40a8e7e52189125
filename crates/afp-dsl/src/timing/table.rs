//! Timing as a table for users and as JSON for tools.

use std::fmt::{self, Write};

use serde_json::{Value, json};

use super::{Basis, Interruption, StepParts, SupervisorTiming, Timing};
use crate::types::text::duration;
use afp_types::Duration;

const RESPONSE: &str = "a response includes the target's tick, but not the delay of a sensor";

impl Timing {
    /// The table with one line for each supervisor and the parts of its response; ends with a line
    /// break.
    pub fn text(&self) -> String {
        let head = ["supervisor", "every", "deadline", "response", "slack", "interruption", ""];
        let mut text = aligned(head, self.supervisors.iter().map(|row| self.row(row)));
        let head =
            ["response", "tick", "running step", "polls before", "entered before", "own poll"];
        let parts = self.supervisors.iter().filter_map(|row| self.response(row));
        let parts: Vec<_> = parts.collect();
        if !parts.is_empty() {
            text += "\n";
            text += &aligned(head, parts.into_iter());
        }
        format!("{text}\n{}{}; {RESPONSE}\n", self.sums(), self.basis)
    }

    fn sums(&self) -> String {
        let step = match (&self.longest_step, &self.step_parts) {
            (Ok(time), Some(parts)) => format!("{}{}", duration(*time), described(parts)),
            (Ok(time), None) => duration(*time),
            (Err(reason), _) => format!("unknown: {reason}"),
        };
        let demand = match &self.demand {
            Ok((share, path)) => format!("{:.1} % while '{path}' is active", share * 100.0),
            Err(reason) => format!("unknown: {reason}"),
        };
        format!("longest step: {step}\ngreatest demand: {demand}\n")
    }

    fn path(&self, row: &SupervisorTiming) -> String {
        match row.plan == self.plan {
            true => row.path.clone(),
            false => format!("{}: {}", row.plan, row.path),
        }
    }

    fn response(&self, row: &SupervisorTiming) -> Option<[String; 6]> {
        let it = row.response.as_ref().ok()?;
        let parts = [it.tick, it.step, it.before, it.entered, it.own];
        let [tick, step, before, entered, own] = parts.map(duration);
        Some([self.path(row), tick, step, before, entered, own])
    }

    fn row(&self, row: &SupervisorTiming) -> [String; 7] {
        let path = self.path(row);
        let [period, deadline] = [row.timing.period, row.timing.deadline].map(Duration::as_nanos);
        let (response, slack) = match &row.response {
            Ok(response) => {
                let total = response.total();
                let sign = if total > deadline { "-" } else { "" };
                (duration(total), format!("{sign}{}", duration(deadline.abs_diff(total))))
            }
            Err(_) => ("unknown".to_owned(), "unknown".to_owned()),
        };
        let (bound, terms) = match &row.interruption {
            None => ("-".to_owned(), "interrupts nothing".to_owned()),
            Some(interruption) => describe(interruption),
        };
        [path, duration(period), duration(deadline), response, slack, bound, terms]
    }

    /// The timing as one JSON object: `plan`, `longest_step_ns`, `longest_step_parts`, `demand`
    /// (each `null` with a reason if unknown), `slowdown`, `budgets_given` and `supervisors`. Times
    /// are in nanoseconds.
    pub fn json(&self) -> Value {
        let supervisors: Vec<_> = self.supervisors.iter().map(supervisor).collect();
        json!({
            "plan": self.plan,
            "longest_step_ns": self.longest_step.as_ref().ok(),
            "longest_step_unknown": self.longest_step.as_ref().err(),
            "longest_step_parts": self.step_parts.as_ref().map(|parts| json!({
                "while": parts.path,
                "supervisors_ns": parts.supervisors,
                "active_ns": parts.active,
                "entered_ns": parts.entered,
            })),
            "demand": self.demand.as_ref().ok().map(|(share, _)| share),
            "demand_while": self.demand.as_ref().ok().map(|(_, path)| path),
            "demand_unknown": self.demand.as_ref().err(),
            "slowdown": self.basis.slowdown,
            "budgets_given": self.basis.given,
            "supervisors": supervisors,
        })
    }
}

impl fmt::Display for Basis {
    /// `budgets are the declared budgets of the toolboxes, not measured`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let target = self.target.as_deref().unwrap_or_default();
        match self.given {
            0 => write!(f, "budgets are the declared budgets of the toolboxes")?,
            1 => write!(
                f,
                "one budget comes from '[target.{target}]', the others from the toolboxes"
            )?,
            n => write!(
                f,
                "{n} budgets come from '[target.{target}]', the others from the toolboxes"
            )?,
        }
        if self.slowdown != 1.0 {
            write!(f, ", times {} for '{target}'", self.slowdown)?;
        }
        write!(f, ", not measured")
    }
}

/// Lines of cells, with aligned columns.
fn aligned<const N: usize>(head: [&str; N], rows: impl Iterator<Item = [String; N]>) -> String {
    let rows: Vec<_> = std::iter::once(head.map(str::to_owned)).chain(rows).collect();
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max();
    let widths: [usize; N] = std::array::from_fn(|column| width(column).unwrap_or(0));
    let mut text = String::new();
    for row in &rows {
        let cells = row.iter().zip(widths).map(|(cell, width)| format!("{cell:<width$}"));
        let line = cells.collect::<Vec<_>>().join("  ");
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", line.trim_end());
    }
    text
}

/// The parts of a step, such as ` while 'go' is active: supervisors 10 us + its poll or
/// interruption 5 us`.
fn described(parts: &StepParts) -> String {
    let parts_of = [
        ("supervisors", parts.supervisors),
        ("its poll or interruption", parts.active),
        (if parts.path.is_empty() { "entered" } else { "entered after it" }, parts.entered),
    ];
    let of = parts_of.into_iter().filter(|(_, time)| *time > 0);
    let sum: Vec<_> = of.map(|(name, time)| format!("{name} {}", duration(time))).collect();
    match (parts.path.is_empty(), sum.is_empty()) {
        (_, true) => String::new(),
        (true, _) => format!(" when it starts: {}", sum.join(" + ")),
        (false, _) => format!(" while '{}' is active: {}", parts.path, sum.join(" + ")),
    }
}

impl Interruption {
    /// The parts of the bound, and why it is not proved: `period 1 ms + stop 300 ms`.
    pub fn terms_in_words(&self) -> String {
        let terms = self.terms.iter().map(|(name, time)| format!("{name} {}", duration(*time)));
        let mut terms = terms.collect::<Vec<_>>().join(" + ");
        if !self.reason.is_empty() {
            let gap = if terms.is_empty() { "" } else { "; " };
            terms = format!("{terms}{gap}{}", self.reason);
        }
        terms
    }
}

fn describe(interruption: &Interruption) -> (String, String) {
    let trust = interruption.trust.as_str();
    let total = interruption.total().map(duration);
    let bound = total.map_or_else(|| trust.to_owned(), |total| format!("{total} {trust}"));
    (bound, interruption.terms_in_words())
}

fn supervisor(row: &SupervisorTiming) -> Value {
    let [period, deadline] = [row.timing.period, row.timing.deadline].map(Duration::as_nanos);
    let response = row.response.as_ref().ok().map(|response| {
        json!({
            "total_ns": response.total(),
            "tick_ns": response.tick,
            "step_ns": response.step,
            "before_ns": response.before,
            "entered_ns": response.entered,
            "own_ns": response.own,
        })
    });
    let interruption = row.interruption.as_ref().map(|bound| {
        let term = |(name, time): &(&str, u64)| json!({ "name": name, "ns": time });
        json!({
            "trust": bound.trust.as_str(),
            "total_ns": bound.total(),
            "terms": bound.terms.iter().map(term).collect::<Vec<_>>(),
            "reason": bound.reason,
        })
    });
    json!({
        "plan": row.plan,
        "supervisor": row.path,
        "slack_ns": row.response.as_ref().ok().map(|response| {
            i128::from(deadline) - i128::from(response.total())
        }).and_then(|slack| i64::try_from(slack).ok()),
        "every_ns": period,
        "deadline_ns": deadline,
        "response": response,
        "response_unknown": row.response.as_ref().err(),
        "interruption": interruption,
    })
}
