//! Diagnostics for people, in the manner of rustc.

use afp_excerpt::{Mark, Report};

use super::tables::Tables;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::source::{Sources, Span};

impl Diagnostics {
    /// All diagnostics as text, one blank line between them, with terminal colours when asked.
    pub fn render(&self, sources: &Sources, colour: bool) -> String {
        let tables = Tables::new(sources);
        let line = |span: Span| {
            let start = tables.lines(span.file).map(|lines| lines.line(span.start as usize).start);
            (span.file, start)
        };
        let mut texts = Vec::new();
        let mut rest = self.iter().peekable();
        while let Some(first) = rest.next() {
            let first_line = line(first.span);
            texts.push(first.render_by(&tables, colour));
            for shown in 1.. {
                let here = |each: &&Diagnostic| line(each.span) == first_line;
                let Some(next) = rest.next_if(here) else { break };
                if shown < MOST_OF_A_LINE {
                    texts.push(next.render_by(&tables, colour));
                    continue;
                }
                let mut left = 1;
                while rest.next_if(here).is_some() {
                    left += 1;
                }
                let (number, _) = tables.line_column(first.span);
                texts.push(format!("... and {left} more about line {number}"));
                break;
            }
        }
        texts.join("\n\n")
    }
}

/// How many diagnostics about one line are shown: a line that is wrong again and again is one
/// mistake, and each time it is shown as a whole.
const MOST_OF_A_LINE: usize = 20;

impl Diagnostic {
    /// The diagnostic as text without a final line break, with terminal colours when asked.
    pub fn render(&self, sources: &Sources, colour: bool) -> String {
        self.render_by(&Tables::new(sources), colour)
    }

    fn render_by(&self, tables: &Tables<'_>, colour: bool) -> String {
        self.report(tables, |report| report.render(colour))
    }

    /// What is made of the diagnostic with the texts that it is about.
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
