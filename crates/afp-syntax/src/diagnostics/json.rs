//! Diagnostics for tools: one JSON object on a line.

use serde_json::{Value, json};

use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::source::{Sources, Span};

impl Diagnostics {
    /// All diagnostics, one JSON object on each line.
    pub fn json_lines(&self, sources: &Sources) -> String {
        self.iter().map(|each| each.json(sources) + "\n").collect()
    }
}

impl Diagnostic {
    /// The diagnostic as one JSON object without line breaks.
    ///
    /// Keys: `code`, `severity`, `message`, `place`, `notes` (each `place` and `text`), `help` and,
    /// where there is one, `fix` (`place` and `text`). A place has `file`, `start` and `end` in
    /// bytes, `line` and `column` counted from 1.
    pub fn json(&self, sources: &Sources) -> String {
        let notes: Vec<_> = self
            .notes
            .iter()
            .map(|note| json!({ "place": place(sources, note.span), "text": note.text }))
            .collect();
        let mut object = json!({
            "code": self.code.as_str(),
            "severity": self.severity.as_str(),
            "message": self.message,
            "place": place(sources, self.span),
            "notes": notes,
            "help": self.help,
        });
        if let Some(fix) = &self.fix {
            object["fix"] = json!({ "place": place(sources, fix.span), "text": fix.text });
        }
        object.to_string()
    }
}

fn place(sources: &Sources, span: Span) -> Value {
    let source = sources.get(span.file);
    let (line, column) = source.map_or((1, 1), |source| source.line_column(span.start));
    json!({
        "file": source.map(|source| source.name.as_str()),
        "start": span.start,
        "end": span.end,
        "line": line,
        "column": column,
    })
}
