//! What a scenario came to.

use std::fmt::Write;

use afp_core::{Duration, Ending, Instant};

use crate::watch::hits::Hits;
use crate::watch::{Activation, Broken};

/// How much of the timeline is told before and behind what broke.
const BEFORE: usize = 8;
const BEHIND: usize = 3;

/// What a scenario came to.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// What was not as expected, in order of time; nothing when the scenario passed.
    pub broken: Vec<Broken>,
    /// When the run was over.
    pub end: Instant,
    /// How the plan ended, if it did.
    pub ending: Option<Ending>,
    /// What a component said whose panic ended the plan, and where.
    pub panic: Option<String>,
    /// What the run made use of.
    pub hits: Hits,
    /// When each element was active, in the order in which they were left.
    pub activations: Vec<Activation>,
    /// The timeline, line by line; with colours.
    pub timeline: Vec<(Instant, String)>,
    /// The hash of the trace: the same for the same scenario, on every machine. That of its log has the stop at the end in it.
    pub trace: u64,
}

impl Verdict {
    /// Whether everything was as expected.
    pub fn passed(&self) -> bool {
        self.broken.is_empty()
    }

    /// What broke, and the timeline around the first of it; nothing for a scenario that passed.
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

    /// The length of the run.
    pub fn length(&self) -> Duration {
        self.end.since(Instant::ZERO)
    }
}

/// Where something broke.
fn mark(at: Instant) -> String {
    format!("{:>10.3}  ─── broken here", at.as_secs_f64())
}
