//! Diagnostics for people, in the manner of rustc.

use afp_excerpt::{Mark, Report};

use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::source::{Sources, Span};

impl Diagnostics {
    /// All diagnostics as text, one blank line between them, with terminal colours when asked.
    pub fn render(&self, sources: &Sources, colour: bool) -> String {
        let mut texts = Vec::new();
        let mut rest = self.iter().peekable();
        while let Some(first) = rest.next() {
            let line = line(first.span, sources);
            texts.push(first.render(sources, colour));
            for shown in 1.. {
                let here = |each: &&Diagnostic| self::line(each.span, sources) == line;
                let Some(next) = rest.next_if(here) else { break };
                if shown < MOST_OF_A_LINE {
                    texts.push(next.render(sources, colour));
                    continue;
                }
                let mut left = 1;
                while rest.next_if(here).is_some() {
                    left += 1;
                }
                let number = sources.get(first.span.file).map(|s| s.line_column(first.span.start));
                let number = number.map_or(0, |(number, _)| number);
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

/// The file and the first byte of the line that a place begins in.
fn line(span: Span, sources: &Sources) -> (u16, usize) {
    let text = sources.get(span.file).map_or("", |source| source.text.as_str());
    let before = text.get(..span.start as usize).unwrap_or_default();
    (span.file, before.rfind('\n').map_or(0, |at| at + 1))
}

impl Diagnostic {
    /// The diagnostic as text without a final line break, with terminal colours when asked.
    pub fn render(&self, sources: &Sources, colour: bool) -> String {
        let mark = |span: Span, label: String| {
            let source = sources.get(span.file)?;
            let bytes = span.start as usize..span.end as usize;
            Some(Mark { path: &source.name, text: &source.text, span: Some(bytes), label })
        };
        let help = if self.help.is_empty() { "" } else { "help: " };
        let primary = mark(self.span, format!("{help}{}", self.help));
        let notes = self.notes.iter().map(|note| mark(note.span, note.text.clone()));
        let (severity, code, message) = (self.severity, self.code.as_str(), &self.message);
        let marks = [primary].into_iter().chain(notes).flatten().collect();
        Report { severity, code, message, marks }.render(colour)
    }
}
