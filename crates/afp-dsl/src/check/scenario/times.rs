//! When things happen and are looked at.

use crate::check::timing;
use crate::scenario::{DEFAULT_UNTIL, MomentId, Window};
use crate::types::text::duration;
use afp_syntax::ast::{Bound, Formula, FormulaKind, Line, LineKind};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;
use afp_syntax::source::Span;

/// The whole of a run, or what of it comes after one of its moments: what times in it count from, and when it ends.
pub(super) struct Stretch {
    /// What times count from; the start of the run without one.
    pub from: Option<MomentId>,
    /// When it ends, nanoseconds.
    pub until: u64,
    until_span: Option<Span>,
}

impl Stretch {
    /// The stretch that some lines are about.
    pub fn of(lines: &[Line], from: Option<MomentId>, diags: &mut Diagnostics) -> Stretch {
        let written = lines.iter().find_map(|line| match line.kind() {
            LineKind::Until(time) => time,
            _ => None,
        });
        let time = written
            .as_ref()
            .and_then(|written| timing::time(written, &[usual_end(written, lines)], diags));
        // How long a run is after a moment that is still to come is not known.
        let otherwise = from.map_or(DEFAULT_UNTIL, |_| u64::MAX);
        let until_span = written.map(|written| written.span());
        Stretch { from, until: time.unwrap_or(otherwise), until_span }
    }

    /// When it ends, where that is written.
    pub fn written_end(&self) -> Option<u64> {
        self.until_span.map(|_| self.until)
    }

    /// An instant of the scenario.
    pub fn instant(&self, written: &Formula, diags: &mut Diagnostics) -> Option<u64> {
        let at = timing::time(written, &[self.usual(written)], diags)?;
        if at > self.until {
            diags.push(self.too_late(written.span()));
            return None;
        }
        Some(at)
    }

    /// The unit in which an instant is most likely meant: in seconds it may lie behind the end.
    fn usual(&self, written: &Formula) -> &'static str {
        if as_seconds(written) > self.until as f64 { "ms" } else { "s" }
    }

    fn too_late(&self, span: Span) -> Diagnostic {
        let message = message!("the scenario has ended by then, at '{}'", duration(self.until));
        let error = Diagnostic::new(Code::E0605, span, message);
        match self.until_span {
            Some(until) => error
                .note(until, "it ends here")
                .help("write an earlier time, or let it last longer"),
            None => error.help("write an earlier time, or 'until' with a later one"),
        }
    }

    /// The window of an expectation.
    pub fn window(&self, bounds: &[Bound], diags: &mut Diagnostics) -> Option<Window> {
        let mut seen: Vec<(String, Span)> = Vec::new();
        let mut window = Window { from: 0, to: self.until };
        let mut length = None;
        for bound in bounds {
            let word = bound.word();
            let clash = |known: &str| {
                let same = |words: &[&str]| words.contains(&known) && words.contains(&&*word);
                known == word || same(&["within", "before"]) || same(&["always", "once", "times"])
            };
            if let Some((first, place)) = seen.iter().find(|(known, _)| clash(known)) {
                let message = match *first == word {
                    true => message!("'{}' stands twice", word),
                    false => message!("'{}' does not go with '{}'", word, first),
                };
                diags.push(
                    Diagnostic::new(Code::E0605, bound.span(), message)
                        .note(*place, "the other one")
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
                // Answers take some milliseconds, and what a robot does some seconds.
                "within" if as_seconds(&written) <= 60e9 => &["ms", "s"],
                "within" => &["ms"],
                _ => &[self.usual(&written)],
            };
            let time = timing::time(&written, usual, diags)?;
            match word.as_str() {
                "after" => window.from = time,
                // What happens at that very instant is not before it.
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

/// The unit in which an end is most likely meant: in seconds it may lie before what is still to come.
fn usual_end(written: &Formula, lines: &[Line]) -> &'static str {
    let times = lines.iter().flat_map(|line| match line.kind() {
        LineKind::Stimulus(at, _) => at.into_iter().collect(),
        LineKind::Expect { bounds, .. } => {
            let instants = bounds.iter().filter(|bound| bound.word() != "within");
            instants.filter_map(Bound::time).collect()
        }
        _ => Vec::new(),
    });
    // What is wrong with them is reported where they stand.
    let mut unread = Diagnostics::default();
    let latest = times.filter_map(|time| timing::time(&time, &["s"], &mut unread)).max();
    if as_seconds(written) < latest.unwrap_or(0) as f64 { "min" } else { "s" }
}

/// A bare number as if it were seconds, nanoseconds.
fn as_seconds(written: &Formula) -> f64 {
    match written.kind() {
        FormulaKind::Number { number, .. } => number.text.parse::<f64>().unwrap_or_default() * 1e9,
        _ => 0.0,
    }
}
