//! The outcome of a run.

use std::collections::BTreeMap;

use afp_session::{FigureValue, Figures};
use serde::{Deserialize, Serialize};

/// The columns of every table.
pub(crate) const FIXED: [&str; 15] = [
    "run",
    "world",
    "seed",
    "ending",
    "where",
    "why",
    "time_s",
    "distance_m",
    "collisions",
    "touched",
    "interruptions",
    "deadline_misses",
    "trace",
    "command",
    "took_s",
];

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// The plan ended by a state or a computation.
    Ok,
    Interrupted,
    /// The time limit was reached.
    TimeLimit,
    /// The plan ended in `Error`, for example after a panic of a component.
    Error,
    /// The run could not start, for example because of an obstacle at the robot's start or an
    /// invalid value.
    NotStarted,
    /// The simulator or the engine panicked.
    Panicked,
}

impl Ending {
    /// Every ending, from good to bad.
    pub const ALL: [Ending; 6] = [
        Ending::Ok,
        Ending::Interrupted,
        Ending::TimeLimit,
        Ending::Error,
        Ending::NotStarted,
        Ending::Panicked,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Ending::Ok => "ok",
            Ending::Interrupted => "interrupted",
            Ending::TimeLimit => "time_limit",
            Ending::Error => "error",
            Ending::NotStarted => "not_started",
            Ending::Panicked => "panicked",
        }
    }

    /// Whether such a run failed.
    pub fn is_failure(self) -> bool {
        matches!(self, Ending::Error | Ending::NotStarted | Ending::Panicked)
    }
}

/// The outcome of a run. All fields except `took_s` are the same on every machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    pub run: u64,
    pub ending: Ending,
    /// The path of the component that was active or failed last.
    #[serde(rename = "where")]
    pub place: String,
    /// The state or event, the fault, or the start error.
    pub why: String,
    pub time_s: f64,
    /// The distance driven, in metres.
    pub distance_m: f64,
    pub collisions: u64,
    /// Touched things, with the total duration in seconds.
    #[serde(default)]
    pub touched: BTreeMap<String, f64>,
    /// The number of interrupted actors.
    pub interruptions: u64,
    pub deadline_misses: u64,
    /// Other results of the robot and its measures, by column name: `contacts_s`,
    /// `wall_error_mean_m`. A result without a value keeps its column.
    #[serde(flatten)]
    pub figures: BTreeMap<String, Option<f64>>,
    /// The hash of the trace, 16 hexadecimal digits; empty without a trace.
    pub trace: String,
    /// The real time in seconds.
    pub took_s: f64,
}

pub(crate) const CONTACTS: &str = "contacts";

/// Results as named numbers: a count under the result's name, several numbers with that name as a
/// prefix, and time spans as their sum in seconds. If a fixed column has the name, the number
/// counts as the robot's.
pub(crate) fn numbers(figures: &Figures) -> BTreeMap<String, Option<f64>> {
    let mut all = BTreeMap::new();
    for figure in &figures.0 {
        match &figure.value {
            FigureValue::Count(count) => {
                all.insert(figure.name.to_owned(), Some(*count as f64));
            }
            FigureValue::Numbers(parts) => all.extend(
                parts
                    .iter()
                    .map(|(part, number)| (format!("{}_{part}", figure.name), Some(*number))),
            ),
            FigureValue::Spans { spans, .. } => {
                let lasted = spans.iter().map(|span| span.end.since(span.begin).as_secs_f64());
                // The sum of an empty list is negative zero.
                let sum = lasted.fold(0.0, |all, each| all + each);
                all.insert(format!("{}_s", figure.name), Some(sum));
            }
        }
    }
    let own = |name: String| if FIXED.contains(&&*name) { of_robot(&name) } else { name };
    all.into_iter().map(|(name, number)| (own(name), number)).collect()
}

/// The column name of a result whose own name is taken.
pub(crate) fn of_robot(figure: &str) -> String {
    format!("robot.{figure}")
}

/// Touched things, with the total duration in seconds.
pub(crate) fn touched(figures: &Figures) -> BTreeMap<String, f64> {
    let mut all = BTreeMap::new();
    for span in figures.spans(CONTACTS) {
        let lasted = span.end.since(span.begin).as_secs_f64();
        *all.entry(span.name.clone()).or_insert(0.0) += lasted;
    }
    all
}

impl Outcome {
    /// Whether the run has measures; a run that did not start, or panicked, has no trace.
    pub fn has_started(&self) -> bool {
        !self.trace.is_empty()
    }

    /// Touched things in words: `crate 1.3 s, wall 0.2 s`.
    pub(crate) fn touched_text(&self) -> String {
        let each = self.touched.iter().map(|(name, lasted)| format!("{name} {lasted:.1} s"));
        each.collect::<Vec<_>>().join(", ")
    }

    /// An outcome without data other than its failure.
    pub(crate) fn failed(run: u64, ending: Ending, why: String) -> Self {
        Outcome {
            run,
            ending,
            place: String::new(),
            why,
            time_s: 0.0,
            distance_m: 0.0,
            collisions: 0,
            touched: BTreeMap::new(),
            interruptions: 0,
            deadline_misses: 0,
            figures: BTreeMap::new(),
            trace: String::new(),
            took_s: 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use afp_core::Instant;
    use afp_session::{Figure, Span};

    use super::*;

    #[test]
    fn figures_become_numbers_that_a_journal_keeps() {
        let at = |seconds: u64| Instant::from_nanos(seconds * 1_000_000_000);
        let span = |begin, end| Span { name: "crate".to_owned(), begin: at(begin), end: at(end) };
        let figure = |name, value| Figure { name, value, text: String::new() };
        let spans = vec![span(1, 3), span(5, 6)];
        let figures = Figures(vec![
            figure("drops", FigureValue::Count(2)),
            figure("contacts", FigureValue::Spans { of: "obstacle", spans }),
            figure("dirt", FigureValue::Numbers(vec![("left_m2", 0.5)])),
        ]);
        let touched = touched(&figures);
        assert_eq!(touched, [("crate".to_owned(), 3.0)].into());
        let figures = numbers(&figures);
        let pairs: Vec<_> = figures.iter().map(|(name, number)| (name.as_str(), *number)).collect();
        let wanted = [("contacts_s", Some(3.0)), ("dirt_left_m2", Some(0.5)), ("drops", Some(2.0))];
        assert_eq!(pairs, wanted);
        let figures = figures.into_iter().chain([("none".to_owned(), None)]).collect();
        let outcome = Outcome { figures, touched, ..Outcome::failed(3, Ending::Ok, String::new()) };
        let line = serde_json::to_string(&outcome).unwrap();
        assert!(line.contains("\"dirt_left_m2\":0.5"), "{line}");
        assert_eq!(outcome.touched_text(), "crate 3.0 s");
        assert_eq!(serde_json::from_str::<Outcome>(&line).unwrap(), outcome);
    }
}
