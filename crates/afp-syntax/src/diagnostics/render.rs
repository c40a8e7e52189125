//! Diagnostics for people, in the style of rustc.

use afp_excerpt::{Mark, Report};

use super::tables::Tables;
use crate::diagnostics::{Diagnostic, Diagnostics, Severity};
use crate::source::{Sources, Span};

impl Diagnostics {
    /// The diagnostics as text, separated by blank lines, with terminal colours on request: the
    /// first 20 errors, the first 20 others, and the number of the rest.
    pub fn render(&self, sources: &Sources, colour: bool) -> String {
        let tables = Tables::new(sources);
        let (shown, left) = self.first(MOST_SHOWN);
        let texts = shown.into_iter().map(|each| each.render_by(&tables, colour));
        texts.chain(left).collect::<Vec<_>>().join("\n\n")
    }

    /// The first `most` errors and as many others, and a line that counts the rest, if any.
    pub(super) fn first(&self, most: usize) -> (Vec<&Diagnostic>, Option<String>) {
        let mut counts = [0_usize; 2];
        let is_shown = |each: &&Diagnostic| {
            let count = &mut counts[usize::from(each.severity != Severity::Error)];
            *count += 1;
            *count <= most
        };
        let shown = self.iter().filter(is_shown).collect();
        counts[0] += self.counted.len();
        let left = counts.into_iter().zip(["error", "warning"]).filter_map(|(count, what)| {
            let left = count.checked_sub(most).filter(|left| *left > 0)?;
            let plural = if left == 1 { "" } else { "s" };
            Some(format!("{} more {what}{plural}", thousands(left)))
        });
        let left: Vec<_> = left.collect();
        (shown, (!left.is_empty()).then(|| format!("and {}", left.join(" and "))))
    }
}

/// The limit of errors for people: in a file with more, most follow from the first ones.
const MOST_SHOWN: usize = 20;

/// A number with a comma between the thousands.
pub(crate) fn thousands(number: usize) -> String {
    let digits = number.to_string();
    let groups = digits.as_bytes().rchunks(3).rev();
    groups.map(String::from_utf8_lossy).collect::<Vec<_>>().join(",")
}

impl Diagnostic {
    /// The diagnostic as text without a final line break, with terminal colours on request.
    pub fn render(&self, sources: &Sources, colour: bool) -> String {
        self.render_by(&Tables::new(sources), colour)
    }

    fn render_by(&self, tables: &Tables<'_>, colour: bool) -> String {
        self.report(tables, |report| report.render(colour))
    }

    /// Calls `show` with a report of the diagnostic.
    pub(super) fn report<T>(&self, tables: &Tables<'_>, show: impl FnOnce(Report<'_>) -> T) -> T {
        let mark = |span: Span, label: String| {
            let source = tables.sources.get(span.file)?;
            let lines = tables.lines(span.file);
            let bytes = span.start as usize..span.end as usize;
            Some(Mark { path: &source.name, text: &source.text, lines, span: Some(bytes), label })
        };
        let primary = mark(self.span, String::new());
        let notes = self.note_texts().map(|(place, text)| mark(place, text));
        let (severity, code) = (self.severity, self.code.as_str());
        let marks = [primary].into_iter().chain(notes).flatten().collect();
        let (message, help) = (self.message_text(), self.help_text());
        show(Report { severity, code, message: &message, help: &help, marks })
    }
}
