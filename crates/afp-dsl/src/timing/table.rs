//! Timing as a table for people and as JSON for tools.

use std::fmt::Write;

use serde_json::{Value, json};

use super::{Interruption, SupervisorTiming, Timing};
use crate::types::text::duration;

impl Timing {
    /// The table, one line for each supervisor, with what it is made of; ends with a line break.
    pub fn text(&self) -> String {
        let head = ["supervisor", "every", "deadline", "response", "interruption", ""];
        let head = head.map(str::to_owned);
        let rows: Vec<[String; 6]> =
            std::iter::once(head).chain(self.supervisors.iter().map(|row| self.row(row))).collect();
        let widths: Vec<usize> = (0..6)
            .map(|column| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0))
            .collect();
        let mut text = String::new();
        for row in &rows {
            let cells = row.iter().zip(&widths).map(|(cell, width)| format!("{cell:<width$}"));
            let line = cells.collect::<Vec<_>>().join("  ");
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{}", line.trim_end());
        }
        text + "\n" + &self.sums()
    }

    fn sums(&self) -> String {
        let step = match &self.longest_step {
            Ok(time) => duration(*time),
            Err(reason) => format!("unknown: {reason}"),
        };
        let demand = match &self.demand {
            Ok((share, path)) => format!("{:.1} % while '{path}' is active", share * 100.0),
            Err(reason) => format!("unknown: {reason}"),
        };
        format!("longest step: {step}\ngreatest demand: {demand}\n")
    }

    fn row(&self, row: &SupervisorTiming) -> [String; 6] {
        let path = match row.plan == self.plan {
            true => row.path.clone(),
            false => format!("{}: {}", row.plan, row.path),
        };
        let response = match &row.response {
            Ok(response) => duration(response.total()),
            Err(_) => "unknown".to_owned(),
        };
        let (bound, terms) = match &row.interruption {
            None => ("-".to_owned(), "interrupts nothing".to_owned()),
            Some(interruption) => describe(interruption),
        };
        [path, duration(row.every), duration(row.deadline), response, bound, terms]
    }

    /// The same as one JSON object: `plan`, `longest_step_ns`, `demand` (each with `null` and a reason where
    /// unknown) and `supervisors`. Times are in nanoseconds.
    pub fn json(&self) -> Value {
        let supervisors: Vec<_> = self.supervisors.iter().map(supervisor).collect();
        json!({
            "plan": self.plan,
            "longest_step_ns": self.longest_step.as_ref().ok(),
            "longest_step_unknown": self.longest_step.as_ref().err(),
            "demand": self.demand.as_ref().ok().map(|(share, _)| share),
            "demand_while": self.demand.as_ref().ok().map(|(_, path)| path),
            "demand_unknown": self.demand.as_ref().err(),
            "supervisors": supervisors,
        })
    }
}

impl Interruption {
    /// What the bound is made of, and why it is not proved: `period 1 ms + stop 300 ms`.
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
    let response = row.response.as_ref().ok().map(|response| {
        json!({
            "total_ns": response.total(),
            "tick_ns": response.tick,
            "step_ns": response.step,
            "before_ns": response.before,
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
        "every_ns": row.every,
        "deadline_ns": row.deadline,
        "response": response,
        "response_unknown": row.response.as_ref().err(),
        "interruption": interruption,
    })
}
