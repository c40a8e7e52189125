//! The end of a run in figures.

use std::fmt::Write;
use std::path::PathBuf;

use afp_core::Instant;
use afp_core::trace::{ComponentId, Ending, Kind, Names, TraceHash};
use afp_sim::{Collision, World};
use anstyle::{AnsiColor, Style};
use serde::{Serialize, Serializer};

use crate::judge::Judge;

const QUIET: Style = Style::new().dimmed();
const STRONG: Style = Style::new().bold();
const BAD: Style = AnsiColor::BrightRed.on_default().bold();

/// Why a run stopped though its plan did not end by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum StoppedBy {
    /// `--until` was reached.
    Until,
    /// Ctrl-C, SIGTERM, or nobody reads standard output any more.
    Signal,
}

/// What is the same on every machine.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Figures {
    pub plan: String,
    pub world: String,
    pub seed: u64,
    ending: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    fault: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stopped_by: Option<StoppedBy>,
    time_s: f64,
    #[serde(serialize_with = "in_order")]
    activations: Vec<(String, u64)>,
    #[serde(serialize_with = "in_order")]
    outcomes: Vec<(String, u64)>,
    interruptions: u64,
    deadline_misses: u64,
    distance_m: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    wall_error: Option<Wall>,
    contacts: Vec<Contact>,
    /// The hash of the trace.
    trace: String,
}

#[derive(Clone, Copy, Debug, Serialize)]
struct Wall {
    mean_m: f64,
    max_m: f64,
    judged_s: f64,
}

#[derive(Clone, Debug, Serialize)]
struct Contact {
    obstacle: String,
    begin_s: f64,
    end_s: f64,
}

/// The figures and where things are.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Summary {
    #[serde(flatten)]
    pub figures: Figures,
    /// How many times as fast as real time.
    pub speed: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub log: Option<PathBuf>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub svg: Option<PathBuf>,
    /// Log records that got lost.
    #[serde(skip_serializing_if = "is_zero")]
    pub lost: u64,
}

/// What a run was, for its summary.
pub(crate) struct Ran<'a> {
    pub plan: &'a str,
    pub world: &'a World,
    pub seed: u64,
    pub stopped_by: Option<StoppedBy>,
    pub end: Instant,
    pub misses: u64,
    pub trace: TraceHash,
    pub collisions: &'a [Collision],
}

impl Figures {
    pub(crate) fn new(ran: &Ran<'_>, judge: &Judge, names: &impl Names) -> Self {
        let (ending, fault) = match judge.ending {
            None => ("running", None),
            Some(Ending::Ok) => ("ok", None),
            Some(Ending::Interrupted) => ("interrupted", None),
            Some(Ending::Error(fault)) => ("error", Some(fault.code())),
        };
        let contact = |collision: &Collision| Contact {
            obstacle: match ran.world.obstacles.get(collision.obstacle) {
                Some(obstacle) => obstacle.name.clone(),
                None => String::new(),
            },
            begin_s: collision.begin.as_secs_f64(),
            end_s: collision.end.as_secs_f64(),
        };
        let (mean_m, max_m, judged_s) = (judge.wall.mean(), judge.wall.max, judge.wall.seconds());
        Figures {
            plan: ran.plan.to_owned(),
            world: ran.world.name.clone(),
            seed: ran.seed,
            ending,
            fault,
            stopped_by: ran.stopped_by,
            time_s: ran.end.as_secs_f64(),
            activations: activations(judge, names),
            outcomes: outcomes(judge, names),
            interruptions: judge.interruptions,
            deadline_misses: ran.misses,
            distance_m: judge.distance,
            wall_error: (judged_s > 0.0).then_some(Wall { mean_m, max_m, judged_s }),
            contacts: ran.collisions.iter().map(contact).collect(),
            trace: ran.trace.to_string(),
        }
    }
}

impl Figures {
    /// The figures that a picture shows.
    pub(crate) fn for_picture(&self) -> Vec<(&'static str, String)> {
        let mut lines = vec![
            ("time", format!("{:.1} s", self.time_s)),
            ("distance", format!("{:.2} m", self.distance_m)),
            ("interruptions", self.interruptions.to_string()),
            ("contacts", self.contacts.len().to_string()),
        ];
        if let Some(wall) = self.wall_error {
            lines.push(("wall error", format!("{:.1} cm mean", wall.mean_m * 100.0)));
        }
        lines
    }
}

/// Elements that ran, in the order of the plan.
fn activations(judge: &Judge, names: &impl Names) -> Vec<(String, u64)> {
    let counts = (0..).map(ComponentId).zip(&judge.activations);
    let elements = counts.filter(|(id, count)| {
        let kind = names.component(*id).kind;
        **count > 0 && !matches!(kind, Kind::Plan | Kind::Supervisor)
    });
    elements.map(|(id, count)| (names.component(id).path.to_owned(), *count)).collect()
}

/// States and events that came, in the order of the plan.
fn outcomes(judge: &Judge, names: &impl Names) -> Vec<(String, u64)> {
    let mut all = Vec::new();
    for (id, counts) in (0..).map(ComponentId).zip(&judge.outcomes) {
        for (outcome, count) in (0..).zip(counts) {
            if *count > 0 {
                let (path, name) = (names.component(id).path, names.outcome(id, outcome));
                all.push((format!("{path}.{name}"), *count));
            }
        }
    }
    all
}

fn in_order<S: Serializer>(pairs: &[(String, u64)], to: S) -> Result<S::Ok, S::Error> {
    to.collect_map(pairs.iter().map(|(key, value)| (key, value)))
}

fn is_zero(count: &u64) -> bool {
    *count == 0
}

impl Summary {
    /// The last line: all of it, or only what is the same on every machine.
    pub(crate) fn json(&self, same_everywhere: bool) -> String {
        #[derive(Serialize)]
        struct Line<T> {
            summary: T,
        }
        let text = match same_everywhere {
            true => serde_json::to_string(&Line { summary: &self.figures }),
            false => serde_json::to_string(&Line { summary: self }),
        };
        // Only keys that are no texts or failing Serialize implementations fail here.
        text.unwrap_or_default()
    }

    /// The summary as a few lines.
    pub(crate) fn for_people(&self) -> String {
        let figures = &self.figures;
        let mut text = String::from("\n");
        let mut line = |key: &str, value: String| {
            let _ = writeln!(text, "{QUIET}{key:>15}{QUIET:#}  {value}");
        };
        line("ended", self.ending());
        let counts = |pairs: &[(String, u64)]| {
            let pairs = pairs.iter().map(|(name, count)| format!("{name} {count}"));
            pairs.collect::<Vec<_>>().join(", ")
        };
        line("active", counts(&figures.activations));
        line("states, events", counts(&figures.outcomes));
        line("interruptions", figures.interruptions.to_string());
        line("deadline misses", figures.deadline_misses.to_string());
        line("distance", format!("{:.2} m", figures.distance_m));
        if let Some(Wall { mean_m, max_m, judged_s }) = figures.wall_error {
            let (mean, max) = (mean_m * 100.0, max_m * 100.0);
            line(
                "wall error",
                format!("{mean:.2} cm mean, {max:.2} cm at most, {judged_s:.1} s judged"),
            );
        }
        for contact in &figures.contacts {
            let (begin, end) = (contact.begin_s, contact.end_s);
            line("contact", format!("{} from {begin:.2} s to {end:.2} s", contact.obstacle));
        }
        line("trace", figures.trace.clone());
        line("speed", format!("{:.0} x real time", self.speed));
        if self.lost > 0 {
            line("lost", format!("{BAD}{} log records{BAD:#}", self.lost));
        }
        for (key, path) in [("log", &self.log), ("picture", &self.svg)] {
            if let Some(path) = path {
                line(key, format!("{STRONG}{}{STRONG:#}", path.display()));
            }
        }
        text
    }

    fn ending(&self) -> String {
        let Figures { ending, fault, stopped_by, time_s, .. } = &self.figures;
        let why = match (stopped_by, fault) {
            (Some(StoppedBy::Until), _) => ", its time was up".to_owned(),
            (Some(StoppedBy::Signal), _) => ", asked to stop".to_owned(),
            (None, Some(fault)) => format!(" ({fault})"),
            (None, None) => String::new(),
        };
        let style = if fault.is_some() { BAD } else { STRONG };
        format!("{style}{ending}{style:#} after {time_s:.3} s{why}")
    }
}
