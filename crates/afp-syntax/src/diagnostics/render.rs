//! Diagnostics for people, in the manner of rustc.

use afp_excerpt::{Mark, Report};

use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::source::{Sources, Span};

impl Diagnostics {
    /// All diagnostics as text, one blank line between them, with terminal colours when asked.
    pub fn render(&self, sources: &Sources, colour: bool) -> String {
        let texts: Vec<_> = self.iter().map(|each| each.render(sources, colour)).collect();
        texts.join("\n\n")
    }
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
