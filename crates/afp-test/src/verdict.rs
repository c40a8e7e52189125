//! The verdict of a scenario.

use std::fmt::Write;

use afp_core::{Duration, Ending, Instant};

use crate::watch::hits::Hits;
use crate::watch::{Activation, Broken};

/// The lines of the timeline shown before and after a broken line.
const BEFORE: usize = 8;
const BEHIND: usize = 3;

/// The result of a scenario.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// Unmet expectations by time; empty if the scenario passed.
    pub broken: Vec<Broken>,
    /// The time at which the run was over.
    pub end: Instant,
    /// The ending of the plan, if it ended.
    pub ending: Option<Ending>,
    /// The message and place of a component's panic that ended the plan.
    pub panic: Option<String>,
    /// The use counts of the plan's parts.
    pub hits: Hits,
    /// The activations of all elements, ordered by their ends.
    pub activations: Vec<Activation>,
    /// The timeline with colours, line by line.
    pub timeline: Vec<(Instant, String)>,
    /// The hash of the trace, equal for equal scenarios on every machine. The hash of its log also
    /// includes the stop at the end.
    pub trace: u64,
}

impl Verdict {
    /// Whether all expectations were met.
    pub fn passed(&self) -> bool {
        self.broken.is_empty()
    }

    /// The broken lines and the timeline around the first of them; empty if the scenario passed.
    pub fn report(&self) -> String {
        let mut text = String::new();
        for broken in &self.broken {
            let Broken { text: line, at, why, .. } = broken;
            let _ = writeln!(text, "  {line}\n    {:.3} s: {why}", at.as_secs_f64());
        }
        let Some(first) = self.broken.first() else { return text };
        if let Some(said) = &self.panic {
            let _ = writeln!(text, "  panicked: {said}");
        }
        let behind = self.timeline.partition_point(|(at, _)| *at <= first.at);
        let from = behind.saturating_sub(BEFORE);
        let to = (behind + BEHIND).min(self.timeline.len());
        if from > 0 {
            text.push_str("           ...\n");
        }
        for (number, (_, line)) in self.timeline.iter().enumerate().take(to).skip(from) {
            if number == behind {
                let _ = writeln!(text, "{}", mark(first.at));
            }
            let _ = writeln!(text, "{line}");
        }
        if behind >= to {
            let _ = writeln!(text, "{}", mark(first.at));
        }
        text
    }

    /// The simulated time of the run.
    pub fn length(&self) -> Duration {
        self.end.since(Instant::ZERO)
    }
}

/// The mark of a broken line in the timeline.
fn mark(at: Instant) -> String {
    format!("{:>10.3}  ─── broken here", at.as_secs_f64())
}
