//! The summary of a sweep: numbers of endings, measures, and failures by place and reason.

use std::collections::{BTreeMap, BTreeSet};

use crate::outcome::{Ending, Outcome};

/// The summary of a sweep.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Findings {
    /// The number of runs for each ending that occurs.
    pub endings: Vec<(Ending, u64)>,
    /// Runs with equal ending, place and reason: failures last, the most frequent first.
    pub groups: Vec<Group>,
    /// Touched things, the longest contact first.
    pub touched: Vec<Touched>,
    /// Measures of all started runs.
    pub measures: Vec<(Measure, Spread)>,
}

/// A thing that robots touched.
#[derive(Clone, Debug, PartialEq)]
pub struct Touched {
    pub name: String,
    /// The number of runs with a contact.
    pub runs: u64,
    /// The total duration, in seconds.
    pub lasted_s: f64,
    /// The run with the longest contact.
    pub longest: u64,
}

/// Runs with equal ending, place and reason.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    pub ending: Ending,
    pub place: String,
    pub why: String,
    /// The number of runs.
    pub count: u64,
    pub run: u64,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Simulated time, seconds.
    Time,
    /// The distance driven, in metres.
    Distance,
    Collisions,
    /// The number of interrupted actors.
    Interruptions,
    Misses,
    /// A result of the robot or of one of its measures, by its column name.
    Figure(String),
}

/// Minimum, median and maximum of a measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    pub min: f64,
    /// For an even number of values, the mean of the two in the middle.
    pub median: f64,
    pub max: f64,
}

impl Measure {
    pub const ALL: [Measure; 5] = [
        Measure::Time,
        Measure::Distance,
        Measure::Collisions,
        Measure::Interruptions,
        Measure::Misses,
    ];

    pub fn of_figures(outcomes: &[Outcome]) -> Vec<Measure> {
        let names: BTreeSet<&String> = outcomes.iter().flat_map(|it| it.figures.keys()).collect();
        names.into_iter().cloned().map(Measure::Figure).collect()
    }

    /// The name in tables, with its unit.
    pub fn name(&self) -> &str {
        match self {
            Measure::Time => "time_s",
            Measure::Distance => "distance_m",
            Measure::Collisions => "collisions",
            Measure::Interruptions => "interruptions",
            Measure::Misses => "deadline_misses",
            Measure::Figure(name) => name,
        }
    }

    /// The value of a run; `None` if the run never started.
    pub fn of(&self, outcome: &Outcome) -> Option<f64> {
        outcome.has_started().then_some(())?;
        Some(match self {
            Measure::Time => outcome.time_s,
            Measure::Distance => outcome.distance_m,
            Measure::Collisions => outcome.collisions as f64,
            Measure::Interruptions => outcome.interruptions as f64,
            Measure::Misses => outcome.deadline_misses as f64,
            Measure::Figure(name) => return outcome.figures.get(name).copied().flatten(),
        })
    }
}

impl Spread {
    fn new(mut values: Vec<f64>) -> Option<Spread> {
        values.sort_by(f64::total_cmp);
        let (min, max) = (*values.first()?, *values.last()?);
        let middle = |at: usize| values.get(at).copied().unwrap_or(min);
        let median = (middle((values.len() - 1) / 2) + middle(values.len() / 2)) / 2.0;
        Some(Spread { min, median, max })
    }
}

impl Findings {
    /// Summarizes outcomes; their order does not matter.
    pub fn new(outcomes: &[Outcome]) -> Findings {
        let count = |ending| outcomes.iter().filter(|it| it.ending == ending).count() as u64;
        let endings = Ending::ALL.into_iter().map(|ending| (ending, count(ending)));
        let spread = |measure: Measure| {
            let values = outcomes.iter().filter_map(|outcome| measure.of(outcome));
            let spread = Spread::new(values.collect())?;
            Some((measure, spread))
        };
        let all = Measure::ALL.into_iter().chain(Measure::of_figures(outcomes));
        Findings {
            endings: endings.filter(|(_, count)| *count > 0).collect(),
            groups: groups(outcomes.iter().map(|it| (it.ending, &*it.place, &*it.why, it.run))),
            touched: touched(outcomes),
            measures: all.filter_map(spread).collect(),
        }
    }

    pub fn has_failures(&self) -> bool {
        self.endings.iter().any(|(ending, _)| ending.is_failure())
    }
}

/// Groups runs, given as ending, place, reason and number: failures last, the most frequent first.
pub fn groups<'a>(runs: impl Iterator<Item = (Ending, &'a str, &'a str, u64)>) -> Vec<Group> {
    let mut alike: BTreeMap<(Ending, &str, &str), (u64, u64)> = BTreeMap::new();
    for (ending, place, why, run) in runs {
        let (count, first) = alike.entry((ending, place, why)).or_insert((0, run));
        *count += 1;
        *first = (*first).min(run);
    }
    let group = |((ending, place, why), (count, run)): ((Ending, &str, &str), _)| {
        let (place, why) = (place.to_owned(), why.to_owned());
        Group { ending, place, why, count, run }
    };
    let mut groups: Vec<Group> = alike.into_iter().map(group).collect();
    groups.sort_by_key(|group| {
        (group.ending.is_failure(), std::cmp::Reverse(group.count), group.run)
    });
    groups
}

fn touched(outcomes: &[Outcome]) -> Vec<Touched> {
    let mut sorted: Vec<&Outcome> = outcomes.iter().collect();
    sorted.sort_by_key(|outcome| outcome.run);
    let mut all: BTreeMap<&str, (Touched, f64)> = BTreeMap::new();
    for outcome in sorted {
        for (name, lasted) in &outcome.touched {
            let none = || {
                let name = name.clone();
                (Touched { name, runs: 0, lasted_s: 0.0, longest: outcome.run }, 0.0)
            };
            let (sum, most) = all.entry(name).or_insert_with(none);
            sum.runs += 1;
            sum.lasted_s += lasted;
            if lasted > most {
                (*most, sum.longest) = (*lasted, outcome.run);
            }
        }
    }
    let mut all: Vec<_> = all.into_values().map(|(touched, _)| touched).collect();
    all.sort_by(|a, b| b.lasted_s.total_cmp(&a.lasted_s).then_with(|| a.name.cmp(&b.name)));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outcome(run: u64, ending: Ending, why: &str, time_s: f64) -> Outcome {
        let trace = "0".to_owned();
        Outcome { time_s, trace, ..Outcome::failed(run, ending, why.to_owned()) }
    }

    #[test]
    fn endings_are_counted_and_failures_grouped() {
        let all = [
            outcome(3, Ending::Error, "panic", 4.0),
            outcome(2, Ending::Error, "livelock", 1.0),
            outcome(1, Ending::Error, "panic", 2.0),
            outcome(0, Ending::Ok, "go.Done", 8.0),
        ];
        let findings = Findings::new(&all);
        assert_eq!(findings.endings, [(Ending::Ok, 1), (Ending::Error, 3)]);
        let groups: Vec<_> =
            findings.groups.iter().map(|it| (it.why.as_str(), it.count, it.run)).collect();
        assert_eq!(groups, [("go.Done", 1, 0), ("panic", 2, 1), ("livelock", 1, 2)]);
        assert_eq!(
            findings.measures[0],
            (Measure::Time, Spread { min: 1.0, median: 3.0, max: 8.0 })
        );
        assert!(findings.has_failures());
        let mut reversed = all.to_vec();
        reversed.reverse();
        assert_eq!(Findings::new(&reversed), findings);
    }

    #[test]
    fn contacts_are_added_up_over_the_runs() {
        let run = |run, touched: &[(&str, f64)]| Outcome {
            touched: touched.iter().map(|(name, s)| ((*name).to_owned(), *s)).collect(),
            ..outcome(run, Ending::TimeLimit, "", 60.0)
        };
        let all = [run(2, &[("step", 4.0)]), run(0, &[("crate", 1.5), ("step", 0.5)]), run(1, &[])];
        let touched = |name: &str, runs, lasted_s, longest| Touched {
            name: name.to_owned(),
            runs,
            lasted_s,
            longest,
        };
        let wanted = [touched("step", 2, 4.5, 2), touched("crate", 1, 1.5, 0)];
        assert_eq!(Findings::new(&all).touched, wanted);
    }

    #[test]
    fn runs_that_never_started_have_no_measures() {
        let none = Findings::new(&[Outcome::failed(0, Ending::NotStarted, "why".to_owned())]);
        assert!(none.measures.is_empty() && none.has_failures());
        assert_eq!(Findings::new(&[]), Findings::default());
    }
}
