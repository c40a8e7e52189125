//! The end of a run: its reason, its results and the command that repeats it.

use afp_session::{EndingKind, Figure, FigureValue};
use dapts::event;
use serde_json::{Map, Value, json};

use super::mode::By;
use super::{Adapter, Run, again};

/// The number of time spans listed individually.
const SPANS: usize = 4;

impl Adapter<'_> {
    /// Sends how the plan ended.
    pub(super) fn ended(&mut self, run: &Run<'_>, by: &By) {
        let ending = run.target.state().ended().map_or(EndingKind::Interrupted, |it| it.0);
        let misses = run.target.misses();
        let figures = run.target.figures().0;
        let sentences: Vec<_> = std::iter::once(run.ending_in_words(by))
            .chain((misses > 0).then(|| format!("{misses} deadlines were missed")))
            .chain(figures.iter().filter_map(in_words))
            .collect();
        for sentence in &sentences {
            self.output("important", &format!("{sentence}\n"));
        }
        let measured = figures.iter().map(|it| (it.name.to_owned(), json!(it.value)));
        let mut summary: Map<_, _> = measured.collect();
        summary.insert("deadline_misses".to_owned(), json!(misses));
        let trace = run.target.trace();
        summary.extend(trace.map(|trace| ("trace".to_owned(), json!(trace.to_string()))));
        let ended = json!({
            "ending": ending.word(),
            "by": run.ended_by(by),
            "at": run.target.now().as_secs_f64(),
            "sentences": sentences,
            "summary": summary,
            "log": run.launch.log,
            "again": again::command(&run.launch, &*run.target, by),
        });
        self.broadcast("afp/ended", &ended);
        let exit_code = if ending == EndingKind::Error { 3 } else { 0 };
        self.event::<event::Exited>(&dapts::ExitedEvent { exit_code });
        self.event::<event::Terminated>(&dapts::TerminatedEvent::default());
    }
}

impl Run<'_> {
    /// The last edge of the plan, in the format of function breakpoints.
    fn last_edge(&self) -> Option<String> {
        let led = self.target.state().ended_by()?;
        let unit = self.target.program().unit(led.by)?;
        Some(format!("{}.{}", unit.path, led.outcome))
    }

    /// The last edge, or the client that ended the run; null for an incomplete log.
    fn ended_by(&self, by: &By) -> Value {
        match (by, self.last_edge()) {
            (_, Some(edge)) => json!({ "edge": edge }),
            (By::Client(name), None) => json!({ "client": name }),
            (By::Until, None) => json!({ "until": self.launch.until }),
            (By::Plan, None) => Value::Null,
        }
    }

    fn ending_in_words(&self, by: &By) -> String {
        let at = self.target.now().as_secs_f64();
        let name = self.target.program().units.first().map_or("", |plan| &*plan.name);
        let edge = self.last_edge();
        let by_edge = edge.as_ref().map(|edge| format!(" by {edge}")).unwrap_or_default();
        match (self.target.state().ended(), by) {
            (Some((EndingKind::Ok, _)), _) => {
                let by_edge = edge.as_deref().map(taken).unwrap_or_default();
                format!("{name} finished normally after {at:.1} s{by_edge}")
            }
            (Some((EndingKind::Error, why)), _) => {
                format!("{name} stopped with an error after {at:.1} s: {why}")
            }
            (None, By::Plan) if self.target.is_recorded() => {
                format!("the log of {name} ends after {at:.1} s, before the plan does")
            }
            (_, By::Client(client)) if by_edge.is_empty() => {
                format!("{name} was interrupted after {at:.1} s by {client}")
            }
            (_, By::Until) if by_edge.is_empty() => {
                format!("{name} was interrupted after {at:.1} s: its time was up")
            }
            _ => format!("{name} was interrupted after {at:.1} s{by_edge}"),
        }
    }
}

/// An edge in words: its element, and the outcome that it left by.
fn taken(edge: &str) -> String {
    let (element, outcome) = edge.rsplit_once('.').unwrap_or(("", edge));
    format!(" ({element} → {outcome})")
}

/// A result in words, if it has content.
fn in_words(figure: &Figure) -> Option<String> {
    let name = figure.name.replace('_', " ");
    if !figure.text.is_empty() {
        return Some(format!("{name}: {}", figure.text));
    }
    let FigureValue::Spans { spans, .. } = &figure.value else { return None };
    let shown = spans.iter().take(SPANS);
    let shown = shown.map(|span| format!("{} at {:.2} s", span.name, span.begin.as_secs_f64()));
    let more = spans.len().saturating_sub(SPANS);
    let more = (more > 0).then(|| format!("{more} more"));
    let all: Vec<_> = shown.chain(more).collect();
    (!all.is_empty()).then(|| format!("{name}: {}", all.join(", ")))
}
