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
            texts.push(first.report(&tables).render(colour));
            for shown in 1.. {
                let here = |each: &&Diagnostic| line(each.span) == first_line;
                let Some(next) = rest.next_if(here) else { break };
                if shown < MOST_OF_A_LINE {
                    texts.push(next.report(&tables).render(colour));
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
        self.report(&Tables::new(sources)).render(colour)
    }

    /// The diagnostic with the texts that it is about.
    pub(super) fn report<'a>(&'a self, tables: &'a Tables<'_>) -> Report<'a> {
        let mark = |span: Span, label: String| {
            let source = tables.sources.get(span.file)?;
            let lines = tables.lines(span.file);
            let bytes = span.start as usize..span.end as usize;
            Some(Mark { path: &source.name, text: &source.text, lines, span: Some(bytes), label })
        };
        let primary = mark(self.span, String::new());
        let notes = self.notes.iter().map(|note| mark(note.span, note.text.clone()));
        let (severity, code) = (self.severity, self.code.as_str());
        let marks = [primary].into_iter().chain(notes).flatten().collect();
        Report { severity, code, message: &self.message, help: &self.help, marks }
    }
}
