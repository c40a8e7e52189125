//! Times of actions and checks.

use crate::check::timing;
use crate::scenario::{DEFAULT_UNTIL, MomentId, Window};
use crate::types::text::duration;
use afp_syntax::ast::{Bound, Formula, FormulaKind, Line, LineKind};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;
use afp_syntax::source::Span;

/// A whole run, or its part after a moment: the origin of its times, and its end.
pub(super) struct Stretch {
    /// The moment that times are relative to; the run's start if `None`.
    pub from: Option<MomentId>,
    /// The end, nanoseconds.
    pub until: u64,
    until_span: Option<Span>,
}

impl Stretch {
    pub fn of(lines: &[Line], from: Option<MomentId>, diags: &mut Diagnostics) -> Stretch {
        let written = lines.iter().find_map(|line| match line.kind() {
            LineKind::Until(time) => time,
            _ => None,
        });
        let time = written
            .as_ref()
            .and_then(|written| timing::time(written, &[usual_end(written, lines)], diags));
        // The remaining time after a future moment is unknown.
        let otherwise = from.map_or(DEFAULT_UNTIL, |_| u64::MAX);
        let until_span = written.map(|written| written.span());
        Stretch { from, until: time.unwrap_or(otherwise), until_span }
    }

    /// The end, if written.
    pub fn written_end(&self) -> Option<u64> {
        self.until_span.map(|_| self.until)
    }

    pub fn instant(&self, written: &Formula, diags: &mut Diagnostics) -> Option<u64> {
        let at = timing::time(written, &[usual(written, self.until)], diags)?;
        if at > self.until {
            diags.push(self.too_late(written.span()));
            return None;
        }
        Some(at)
    }

    fn too_late(&self, span: Span) -> Diagnostic {
        let message = message!("the scenario has ended by then, at '{}'", duration(self.until));
        let error = Diagnostic::new(Code::E0605, span, message);
        match self.until_span {
            Some(until) => error
                .note(until, "it ends here")
                .help("write an earlier time, or make the scenario longer"),
            None => error.help("write an earlier time, or 'until' with a later one"),
        }
    }

    /// The window of an expectation.
    pub fn window(&self, bounds: &[Bound], diags: &mut Diagnostics) -> Option<Window> {
        let mut seen: Vec<(String, Span)> = Vec::new();
        let mut window = Window { from: 0, to: self.until };
        let mut length = None;
        // Errors in the times are reported below.
        let ends = bounds.iter().filter(|bound| bound.word() == "before").filter_map(Bound::time);
        let ends = ends.filter_map(|time| timing::time(&time, &["s"], &mut Diagnostics::default()));
        let end = ends.fold(self.until, u64::min);
        for bound in bounds {
            let word = bound.word();
            let clash = |known: &str| {
                let same = |words: &[&str]| words.contains(&known) && words.contains(&&*word);
                known == word || same(&["within", "before"]) || same(&["always", "once", "times"])
            };
            if let Some((first, place)) = seen.iter().find(|(known, _)| clash(known)) {
                let message = match *first == word {
                    true => message!("'{}' is repeated", word),
                    false => message!("'{}' does not go with '{}'", word, first),
                };
                diags.push(
                    Diagnostic::new(Code::E0605, bound.span(), message)
                        .note(*place, "the other time")
                        .help("keep one of them"),
                );
                return None;
            }
            seen.push((word.clone(), bound.span()));
            if ["always", "once", "times"].contains(&word.as_str()) {
                continue;
            }
            let written = bound.time()?;
            let usual: &[&str] = match word.as_str() {
                // Reactions take milliseconds, and motions take seconds.
                "within" if as_seconds(&written) <= 60e9 => &["ms", "s"],
                "within" => &["ms"],
                _ => &[usual(&written, end)],
            };
            let time = timing::time(&written, usual, diags)?;
            match word.as_str() {
                "after" => window.from = time,
                // That instant itself is excluded.
                "before" => window.to = window.to.min(time.saturating_sub(1)),
                _ => length = Some(time),
            }
            if word != "within" && time > self.until {
                diags.push(self.too_late(written.span()));
                return None;
            }
        }
        if let Some(length) = length {
            window.to = window.to.min(window.from.saturating_add(length));
        }
        if window.from > window.to {
            let span = bounds.first()?.span().to(bounds.last()?.span());
            diags.push(
                Diagnostic::new(Code::E0605, span, "no instant lies between these times")
                    .help("write 'after' with the earlier and 'before' with the later time"),
            );
            return None;
        }
        Some(window)
    }
}

/// The likely unit of an instant: in seconds it may be after the end.
fn usual(written: &Formula, end: u64) -> &'static str {
    if as_seconds(written) > end as f64 { "ms" } else { "s" }
}

/// The likely unit of an end: in seconds it may be before a later line.
fn usual_end(written: &Formula, lines: &[Line]) -> &'static str {
    let times = lines.iter().flat_map(|line| match line.kind() {
        LineKind::Stimulus(at, _) => at.into_iter().collect(),
        LineKind::Expect { bounds, .. } => {
            let instants = bounds.iter().filter(|bound| bound.word() != "within");
            instants.filter_map(Bound::time).collect()
        }
        _ => Vec::new(),
    });
    // Errors in the times are reported at their lines.
    let mut unread = Diagnostics::default();
    let latest = times.filter_map(|time| timing::time(&time, &["s"], &mut unread)).max();
    if as_seconds(written) < latest.unwrap_or(0) as f64 { "min" } else { "s" }
}

/// A bare number as seconds, in nanoseconds.
fn as_seconds(written: &Formula) -> f64 {
    match written.kind() {
        FormulaKind::Number { number, .. } => number.text.parse::<f64>().unwrap_or_default() * 1e9,
        _ => 0.0,
    }
}
