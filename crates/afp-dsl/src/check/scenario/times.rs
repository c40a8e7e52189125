//! When things happen and are looked at.

use super::Checker;
use crate::check::timing;
use crate::scenario::{DEFAULT_UNTIL, Window};
use crate::types::text::duration;
use afp_syntax::ast::{Bound, Formula, Line, LineKind};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::source::Span;

/// When a scenario ends, and where it says so.
pub(super) fn until(lines: &[Line], diags: &mut Diagnostics) -> (u64, Option<Span>) {
    let written = lines.iter().find_map(|line| match line.kind() {
        LineKind::Until(time) => Some(time),
        _ => None,
    });
    let Some(Some(written)) = written else { return (DEFAULT_UNTIL, None) };
    let time = timing::time(&written, diags);
    (time.unwrap_or(DEFAULT_UNTIL), Some(written.span()))
}

impl Checker<'_> {
    /// An instant of the scenario.
    pub(super) fn instant(&self, written: &Formula, diags: &mut Diagnostics) -> Option<u64> {
        let at = timing::time(written, diags)?;
        if at > self.until {
            diags.push(self.too_late(written.span()));
            return None;
        }
        Some(at)
    }

    fn too_late(&self, span: Span) -> Diagnostic {
        let message = format!("the scenario has ended by then, at '{}'", duration(self.until));
        let error = Diagnostic::new(Code::E0605, span, message);
        match self.until_span {
            Some(until) => error
                .note(until, "it ends here")
                .help("write an earlier time, or let it last longer"),
            None => error.help("write an earlier time, or 'until' with a later one"),
        }
    }

    /// The window of an expectation.
    pub(super) fn window(&self, bounds: &[Bound], diags: &mut Diagnostics) -> Option<Window> {
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
                    true => format!("'{word}' stands twice"),
                    false => format!("'{word}' does not go with '{first}'"),
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
            let time = timing::time(&written, diags)?;
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
