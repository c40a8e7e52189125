//! What a run came to.

use std::collections::BTreeMap;

use afp_session::{FigureValue, Figures};
use serde::{Deserialize, Serialize};

/// The columns that each table has.
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
    /// By a state or a computation of the plan.
    Ok,
    Interrupted,
    /// By the end of its time.
    TimeLimit,
    /// The plan ended in `Error`; a component that panics ends it so.
    Error,
    /// The run could not begin: a robot that would stand in something, a value that makes no sense.
    NotStarted,
    /// The simulator or the engine panicked.
    Panicked,
}

impl Ending {
    /// Every ending, the good ones first.
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

    /// Whether nothing good can be said of such a run.
    pub fn is_failure(self) -> bool {
        matches!(self, Ending::Error | Ending::NotStarted | Ending::Panicked)
    }
}

/// What a run came to. All but `took_s` is the same on every machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// The run's number in its sweep.
    pub run: u64,
    pub ending: Ending,
    /// Where: the path of the component that was active or failed last.
    #[serde(rename = "where")]
    pub place: String,
    /// Why: the state or event, the fault, or what was refused.
    pub why: String,
    pub time_s: f64,
    /// The way that the robot went, metres.
    pub distance_m: f64,
    /// How often it ran into something.
    pub collisions: u64,
    /// What it touched, and for how long altogether, seconds.
    #[serde(default)]
    pub touched: BTreeMap<String, f64>,
    /// How often an actor was interrupted.
    pub interruptions: u64,
    /// Deadlines that were missed.
    pub deadline_misses: u64,
    /// What else the robot and its measures say the run came to, by the names of columns: `contacts_s`,
    /// `wall_error_mean_m`. One without a value is still a column.
    #[serde(flatten)]
    pub figures: BTreeMap<String, Option<f64>>,
    /// The hash of the trace, 16 hexadecimal digits; empty for a run without one.
    pub trace: String,
    /// How long it took by the wall clock, seconds.
    pub took_s: f64,
}

/// The figure of what was touched.
pub(crate) const CONTACTS: &str = "contacts";

/// Figures as numbers with names: a count by the figure's own, each of its numbers with that before it, stretches of time
/// by their sum in seconds. What is called as a column that each table has is called the robot's.
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
                // A sum of nothing is a negative zero.
                let sum = lasted.fold(0.0, |all, each| all + each);
                all.insert(format!("{}_s", figure.name), Some(sum));
            }
        }
    }
    let own = |name: String| if FIXED.contains(&&*name) { of_robot(&name) } else { name };
    all.into_iter().map(|(name, number)| (own(name), number)).collect()
}

/// What a figure is called whose name is that of another column.
pub(crate) fn of_robot(figure: &str) -> String {
    format!("robot.{figure}")
}

/// What the robot touched, and for how long altogether, seconds.
pub(crate) fn touched(figures: &Figures) -> BTreeMap<String, f64> {
    let mut all = BTreeMap::new();
    for span in figures.spans(CONTACTS) {
        let lasted = span.end.since(span.begin).as_secs_f64();
        *all.entry(span.name.clone()).or_insert(0.0) += lasted;
    }
    all
}

impl Outcome {
    /// Whether there is anything to measure: what did not start, or panicked, has no trace.
    pub fn has_started(&self) -> bool {
        !self.trace.is_empty()
    }

    /// What it touched, in words: `crate 1.3 s, wall 0.2 s`.
    pub(crate) fn touched_text(&self) -> String {
        let each = self.touched.iter().map(|(name, lasted)| format!("{name} {lasted:.1} s"));
        each.collect::<Vec<_>>().join(", ")
    }

    /// A run that has no more to tell than why it failed.
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
