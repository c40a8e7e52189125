//! Diagnostics as JSON objects for tools, in one form for all sources.

use std::ops::Range;

use serde_json::{Value, json};

use crate::{Mark, Report, line_column};

impl Report<'_> {
    /// The report as an object.
    ///
    /// Keys: `code`, `severity`, `message`, `place` (of the first mark), `notes` (each with `place`
    /// and `text`) of the other marks, and `help`, which may be empty. Code and place are `null` if
    /// absent; places have the form of [`place`].
    pub fn json(&self) -> Value {
        let notes = self.marks.iter().skip(1);
        let notes = notes.map(|mark| json!({ "place": mark.place(), "text": mark.label }));
        json!({
            "code": (!self.code.is_empty()).then_some(self.code),
            "severity": self.severity.as_str(),
            "message": self.message,
            "place": self.marks.first().map(Mark::place),
            "notes": notes.collect::<Vec<_>>(),
            "help": self.help,
        })
    }
}

impl Mark<'_> {
    fn place(&self) -> Value {
        let span = self.span.clone().unwrap_or(0..0);
        let at = match self.lines {
            Some(table) => table.line_column(span.start),
            None => line_column(self.text, span.start),
        };
        place(self.path, span, at)
    }
}

/// A place as an object: `file`, `start` and `end` in bytes, `line` and `column` counted from 1.
pub fn place(file: &str, span: Range<usize>, (line, column): (usize, usize)) -> Value {
    json!({ "file": file, "start": span.start, "end": span.end, "line": line, "column": column })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Severity;

    #[test]
    fn an_object_has_all_keys() {
        let text = "x = 1\nä = 'cd'\n";
        let mark = |span, label: &str| Mark {
            path: "a.toml",
            text,
            lines: None,
            span,
            label: label.to_owned(),
        };
        let marks = vec![mark(Some(11..15), ""), mark(None, "here")];
        let report = Report {
            severity: Severity::Warning,
            code: "E0203",
            message: "it is wrong",
            help: "write 'b'",
            marks,
        };
        let wanted = json!({
            "code": "E0203", "severity": "warning", "message": "it is wrong", "help": "write 'b'",
            "place": { "file": "a.toml", "start": 11, "end": 15, "line": 2, "column": 5 },
            "notes": [{
                "place": { "file": "a.toml", "start": 0, "end": 0, "line": 1, "column": 1 },
                "text": "here",
            }],
        });
        assert_eq!(report.json(), wanted);
        let bare = Report { code: "", help: "", marks: Vec::new(), ..report }.json();
        assert_eq!((&bare["code"], &bare["place"]), (&Value::Null, &Value::Null));
        assert_eq!((&bare["notes"], &bare["help"]), (&json!([]), &json!("")));
    }
}
