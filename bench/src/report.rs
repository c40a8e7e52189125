//! Results as a table for people and as JSON for tools.

use std::fmt::Write;

use serde::Serialize;

use crate::measure::Times;

/// All results of a run.
#[derive(Default)]
pub struct Report {
    pub rows: Vec<Row>,
}

/// One result.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The name: `group/case`.
    pub name: String,
    pub value: f64,
    pub unit: &'static str,
    pub baseline: Option<String>,
    pub ratio: Option<f64>,
    #[serde(skip)]
    pub limit: Option<(String, bool)>,
}

impl Row {
    /// A result without a baseline.
    pub fn new(name: impl Into<String>, value: f64, unit: &'static str) -> Self {
        Row { name: name.into(), value, unit, baseline: None, ratio: None, limit: None }
    }

    pub fn against(mut self, baseline: impl Into<String>, ratio: f64) -> Self {
        (self.baseline, self.ratio) = (Some(baseline.into()), Some(ratio));
        self
    }

    pub fn limit(mut self, text: impl Into<String>, holds: bool) -> Self {
        self.limit = Some((text.into(), holds));
        self
    }
}

impl Report {
    pub fn add(&mut self, row: Row) {
        eprintln!("{:<44} {:>12.2} {}", row.name, row.value, row.unit);
        self.rows.push(row);
    }

    /// Adds a case of a race, which must not take more than `at_most` times the baseline.
    pub fn race(&mut self, group: &str, case: &Times, baseline: &Times, at_most: Option<f64>) {
        let ratio = case.ratio(baseline);
        let row = Row::new(format!("{group}/{}", case.name), case.median, "ns")
            .against(format!("{group}/{}", baseline.name), ratio);
        self.add(match at_most {
            Some(most) => row.limit(format!("<= {most}"), ratio <= most),
            None => row,
        });
    }

    /// Whether every limit holds.
    pub fn passed(&self) -> bool {
        self.rows.iter().filter_map(|row| row.limit.as_ref()).all(|(_, holds)| *holds)
    }

    /// One JSON array of `name`, `value`, `unit`, `baseline`, `ratio`.
    pub fn json(&self) -> String {
        serde_json::to_string_pretty(&self.rows).unwrap_or_else(|why| why.to_string())
    }

    pub fn table(&self) -> String {
        let mut text = format!(
            "{:<44} {:>12} {:<10} {:>8} {:<32} limit\n",
            "case", "value", "unit", "ratio", "to"
        );
        for row in &self.rows {
            let ratio = row.ratio.map_or(String::new(), |ratio| format!("{ratio:.2}"));
            let to = row.baseline.as_deref().unwrap_or("");
            let limit = match &row.limit {
                Some((limit, true)) => format!("{limit}  ok"),
                Some((limit, false)) => format!("{limit}  EXCEEDED"),
                None => String::new(),
            };
            let (name, value, unit) = (&row.name, row.value, row.unit);
            let line = format!("{name:<44} {value:>12.2} {unit:<10} {ratio:>8} {to:<32} {limit}");
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{}", line.trim_end());
        }
        text
    }
}
