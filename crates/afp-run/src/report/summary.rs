//! The results of a run in numbers.

use std::fmt::Write;
use std::path::PathBuf;

use afp_core::Instant;
use afp_core::trace::{ComponentId, ComponentKind, Ending, Names, Outcome, TraceHash};
use afp_session::{
    AnySession, Applied, Counts, Done, Figure, FigureValue, Figures, Histogram, LoopTimes,
    Observer, Requested, Span, Stimulus, Usage,
};
use anstyle::{AnsiColor, Style};
use serde::{Serialize, Serializer};

use super::timeline::stimulus;

const QUIET: Style = Style::new().dimmed();
const STRONG: Style = Style::new().bold();
const BAD: Style = AnsiColor::BrightRed.on_default().bold();

/// The reason why a run stopped before the end of its plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum StoppedBy {
    /// `--until` was reached.
    Until,
    /// Ctrl-C, SIGTERM, or the reader of standard output is gone.
    Signal,
}

/// Results that are equal on every machine.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct RunFigures {
    pub plan: String,
    pub world: String,
    pub seed: u64,
    ending: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    fault: Option<&'static str>,
    /// The fault as text: port, value and place.
    #[serde(skip_serializing_if = "Option::is_none")]
    fault_text: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fault_component: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stopped_by: Option<StoppedBy>,
    time_s: f64,
    #[serde(serialize_with = "in_order")]
    activations: Vec<(String, u64)>,
    #[serde(serialize_with = "in_order")]
    outcomes: Vec<(String, u64)>,
    #[serde(serialize_with = "in_order", skip_serializing_if = "Vec::is_empty")]
    faults: Vec<(String, u64)>,
    interruptions: u64,
    deadline_misses: u64,
    /// Null without a pose of the robot.
    distance_m: Option<f64>,
    /// Requests from outside, including those that the run did not reach.
    #[serde(serialize_with = "by_time", skip_serializing_if = "Vec::is_empty")]
    requests: Vec<Requested>,
    /// Results of measures and robot.
    #[serde(flatten)]
    measured: Figures,
    trace: String,
    /// How late a real robot's control loop woke up, if that is wanted.
    #[serde(skip_serializing_if = "Option::is_none")]
    loop_late: Option<String>,
    /// How long its steps took.
    #[serde(skip_serializing_if = "Option::is_none")]
    loop_steps: Option<String>,
    /// How long the calls of its components took.
    #[serde(serialize_with = "in_order", skip_serializing_if = "Vec::is_empty")]
    loop_calls: Vec<(String, String)>,
    /// The times from events of its supervisors to commands.
    #[serde(serialize_with = "in_order", skip_serializing_if = "Vec::is_empty")]
    loop_reactions: Vec<(String, String)>,
}

/// The results, and the places of objects.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Summary {
    #[serde(flatten)]
    pub figures: RunFigures,
    /// A multiple of real time.
    pub speed: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub log: Option<PathBuf>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub svg: Option<PathBuf>,
    #[serde(skip_serializing_if = "is_zero")]
    pub lost: u64,
    /// Whether the run repeated the log of `--again`: their traces are equal.
    #[serde(skip)]
    pub repeats: bool,
}

/// The data of a run for its summary.
pub(crate) struct Ran<'a> {
    pub plan: &'a str,
    pub world: &'a str,
    pub seed: u64,
    pub stopped_by: Option<StoppedBy>,
    pub end: Instant,
    pub misses: u64,
    /// `None` if records were lost.
    pub trace: Option<TraceHash>,
    /// Metres; `None` without a pose of the robot.
    pub distance: Option<f64>,
    pub requests: Vec<Requested>,
    /// The times of a real robot's control loop, if they are wanted.
    pub times: Option<&'a LoopTimes>,
}

/// Collects requests from outside.
#[derive(Default)]
pub(crate) struct Requests(Vec<Requested>);

impl Requests {
    /// All requests, including those that the run did not reach.
    pub(crate) fn finish(mut self, session: &dyn AnySession) -> Vec<Requested> {
        let late = session.pending().into_iter();
        self.0.extend(late.map(|(at, _, what)| Requested { at, what, done: Done::NotReached }));
        self.0
    }
}

impl Observer for Requests {
    fn on_request(&mut self, applied: &Applied<'_>) {
        self.0.extend(applied.event().facts().request.cloned());
    }
}

impl Ran<'_> {
    pub(crate) fn figures(
        self,
        counts: &Counts,
        measured: Figures,
        names: &dyn Names,
    ) -> RunFigures {
        let (ending, fault) = match counts.ending {
            None => ("running", None),
            Some(Ending::Ok) => ("ok", None),
            Some(Ending::Interrupted) => ("interrupted", None),
            Some(Ending::Error(fault)) => ("error", Some(fault.code())),
        };
        let is_element = |kind| !matches!(kind, ComponentKind::Plan | ComponentKind::Supervisor);
        RunFigures {
            plan: self.plan.to_owned(),
            world: self.world.to_owned(),
            seed: self.seed,
            ending,
            fault,
            fault_text: counts.why(names),
            fault_component: counts
                .fatal()
                .map(|failure| names.component(failure.component).path.to_owned()),
            stopped_by: self.stopped_by,
            time_s: self.end.as_secs_f64(),
            activations: counted(counts, names, |kind, usage| {
                (is_element(kind) && usage.starts + usage.faults > 0).then_some(usage.starts)
            }),
            outcomes: outcomes(counts, names),
            faults: counted(counts, names, |kind, usage| {
                (kind != ComponentKind::Plan && usage.faults > 0).then_some(usage.faults)
            }),
            interruptions: counts.interruptions,
            deadline_misses: self.misses,
            distance_m: self.distance,
            requests: self.requests,
            measured,
            trace: self.trace.map_or_else(|| "incomplete".to_owned(), |hash| hash.to_string()),
            loop_late: self.times.map(|times| times.late.to_string()),
            loop_steps: self.times.map(|times| times.steps.to_string()),
            loop_calls: self.times.map_or_else(Vec::new, |times| timed(&times.calls, names)),
            loop_reactions: self
                .times
                .map_or_else(Vec::new, |times| timed(&times.reactions, names)),
        }
    }
}

impl RunFigures {
    /// The times of a real robot's control loop, with their names in front of the first of a kind.
    fn loop_lines(&self) -> Vec<(&'static str, String)> {
        let whole = [("loop late", &self.loop_late), ("loop steps", &self.loop_steps)];
        let whole = whole.into_iter().filter_map(|(key, times)| Some((key, times.clone()?)));
        let parts = [("calls", &self.loop_calls), ("reactions", &self.loop_reactions)];
        let parts = parts.into_iter().flat_map(|(key, all)| {
            all.iter().enumerate().map(move |(n, (path, times))| {
                (if n == 0 { key } else { "" }, format!("{path}: {times}"))
            })
        });
        whole.chain(parts).collect()
    }

    pub(crate) fn for_picture(&self) -> Vec<(String, String)> {
        let of = |key: &str, value: String| (key.to_owned(), value);
        let mut lines = vec![of("time", format!("{:.1} s", self.time_s))];
        lines.extend(self.distance_m.map(|way| of("distance", format!("{way:.2} m"))));
        lines.push(of("interruptions", self.interruptions.to_string()));
        for figure in &self.measured.0 {
            let value = match &figure.value {
                FigureValue::Count(count) => count.to_string(),
                FigureValue::Spans { spans, .. } => spans.len().to_string(),
                // Only the first number fits.
                FigureValue::Numbers(_) => {
                    figure.text.split(',').next().unwrap_or_default().to_owned()
                }
            };
            lines.push((spaced(figure), value));
        }
        lines
    }
}

/// The name of a result with spaces.
fn spaced(figure: &Figure) -> String {
    figure.name.replace('_', " ")
}

/// The results of `count` for components, if any, in the order of the plan.
fn counted(
    counts: &Counts,
    names: &dyn Names,
    count: impl Fn(ComponentKind, &Usage) -> Option<u64>,
) -> Vec<(String, u64)> {
    let all = (0..).map(ComponentId).zip(&counts.components);
    let told = all.filter_map(|(id, usage)| {
        let name = names.component(id);
        Some((name.path.to_owned(), count(name.kind, usage)?))
    });
    told.collect()
}

/// The times of components, in the order of the plan.
fn timed(times: &[Histogram], names: &dyn Names) -> Vec<(String, String)> {
    let all = (0..).map(ComponentId).zip(times).filter(|(_, times)| times.count() > 0);
    all.map(|(id, times)| (names.component(id).path.to_owned(), times.to_string())).collect()
}

/// States and events that occurred, in the order of the plan.
fn outcomes(counts: &Counts, names: &dyn Names) -> Vec<(String, u64)> {
    let mut all = Vec::new();
    for (id, usage) in (0..).map(ComponentId).zip(&counts.components) {
        for (outcome, count) in (0..).map(Outcome::Declared).zip(&usage.outcomes) {
            if *count > 0 {
                let (path, name) = (names.component(id).path, names.outcome(id, outcome));
                all.push((format!("{path}.{name}"), *count));
            }
        }
    }
    all
}

fn by_time<S: Serializer>(requests: &[Requested], to: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Row<'a> {
        at_s: f64,
        request: String,
        done: bool,
        #[serde(skip_serializing_if = "str::is_empty")]
        why: &'a str,
    }
    to.collect_seq(requests.iter().map(|request| Row {
        at_s: request.at.as_secs_f64(),
        request: request.what.to_string(),
        done: request.done == Done::Done,
        why: why_not(request),
    }))
}

/// The reason if a request failed; else empty.
fn why_not(request: &Requested) -> &str {
    match &request.done {
        Done::Done => "",
        Done::Refused(why) => why,
        Done::NotReached => "the run was over before",
    }
}

/// Whether a request is of interest to people; releases of controls are not.
fn is_worth_a_line(request: &Requested) -> bool {
    !matches!(request.what, Stimulus::Press(_, false))
}

fn request(request: &Requested) -> String {
    let (what, at) = (stimulus(&request.what), request.at.as_secs_f64());
    match why_not(request) {
        "" => format!("{what} at {at} s"),
        why => format!("{BAD}{what} at {at} s: {why}{BAD:#}"),
    }
}

fn in_order<T: Serialize, S: Serializer>(pairs: &[(String, T)], to: S) -> Result<S::Ok, S::Error> {
    to.collect_map(pairs.iter().map(|(key, value)| (key, value)))
}

fn is_zero(count: &u64) -> bool {
    *count == 0
}

impl Summary {
    /// The last line: complete, or only the results that are equal on every machine.
    pub(crate) fn json(&self, same_everywhere: bool) -> String {
        #[derive(Serialize)]
        struct Line<T> {
            summary: T,
        }
        let text = match same_everywhere {
            true => serde_json::to_string(&Line { summary: &self.figures }),
            false => serde_json::to_string(&Line { summary: self }),
        };
        // JSON fails only for keys that are not strings and for faulty `Serialize` implementations.
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
        for (key, pairs) in [
            ("active", &figures.activations),
            ("states, events", &figures.outcomes),
            ("faults", &figures.faults),
        ] {
            if !pairs.is_empty() {
                line(key, counts(pairs));
            }
        }
        for (n, request) in figures.requests.iter().filter(|it| is_worth_a_line(it)).enumerate() {
            line(if n == 0 { "from outside" } else { "" }, self::request(request));
        }
        line("interruptions", figures.interruptions.to_string());
        line("deadline misses", figures.deadline_misses.to_string());
        if let Some(way) = figures.distance_m {
            line("distance", format!("{way:.2} m"));
        }
        for figure in &figures.measured.0 {
            if !figure.text.is_empty() {
                line(&spaced(figure), figure.text.clone());
            }
            if let FigureValue::Spans { spans, .. } = &figure.value {
                let name = spaced(figure);
                for Span { name: what, begin, end } in spans {
                    let (begin, end) = (begin.as_secs_f64(), end.as_secs_f64());
                    // The world chooses the name, which may contain control characters.
                    let what = what.replace(char::is_control, " ");
                    let text = format!("{what} from {begin:.2} s to {end:.2} s");
                    line(name.strip_suffix('s').unwrap_or(&name), text);
                }
            }
        }
        let equal = if self.repeats { ", equal to the log's" } else { "" };
        line("trace", format!("{}{equal}", figures.trace));
        line("speed", format!("{:.0} x real time", self.speed));
        figures.loop_lines().into_iter().for_each(|(key, text)| line(key, text));
        if self.lost > 0 {
            line("lost", format!("{BAD}{} records and samples{BAD:#}", self.lost));
        }
        for (key, path) in [("log", &self.log), ("picture", &self.svg)] {
            if let Some(path) = path {
                line(key, format!("{STRONG}{}{STRONG:#}", path.display()));
            }
        }
        text
    }

    fn ending(&self) -> String {
        let RunFigures { ending, fault, fault_text, fault_component, stopped_by, time_s, .. } =
            &self.figures;
        let whose = fault_component.as_ref().filter(|_| stopped_by.is_none());
        let whose = whose.map(|path| format!(" of {path}")).unwrap_or_default();
        let why = match (stopped_by, fault) {
            (Some(StoppedBy::Until), _) => ", its time was up".to_owned(),
            (Some(StoppedBy::Signal), _) => ", asked to stop".to_owned(),
            (None, Some(fault)) => match fault_text {
                Some(text) => format!(": {text}"),
                None => format!(" ({fault})"),
            },
            (None, None) => String::new(),
        };
        let style = if fault.is_some() { BAD } else { STRONG };
        format!("{style}{ending}{style:#}{whose} after {time_s:.3} s{why}")
    }
}
