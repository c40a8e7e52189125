//! Diagnostics for tools: one JSON object on a line.

use afp_excerpt::{Report, place};
use serde_json::json;

use super::tables::Tables;
use crate::diagnostics::{Diagnostic, Diagnostics, Severity};
use crate::source::Sources;

impl Diagnostics {
    /// The diagnostics, one JSON object on each line: the first 1,000 errors and 1,000 others. If
    /// more are left, the last object has no code and no place, and its message counts them.
    pub fn json_lines(&self, sources: &Sources) -> String {
        let tables = Tables::new(sources);
        let (shown, left) = self.first(MOST_WRITTEN);
        let rest = left.map(|message| {
            let severity = Severity::Note;
            Report { severity, code: "", message: &message, help: "", marks: Vec::new() }.json()
        });
        let lines = shown.into_iter().map(|each| each.json_by(&tables));
        lines.chain(rest.map(|rest| rest.to_string())).map(|line| line + "\n").collect()
    }
}

/// The limit of errors in JSON.
const MOST_WRITTEN: usize = 1000;

impl Diagnostic {
    /// The diagnostic as one JSON object without line breaks.
    ///
    /// It has the keys of [`afp_excerpt::Report::json`] and, with an edit, `fix` (`place` and
    /// `text`).
    pub fn json(&self, sources: &Sources) -> String {
        self.json_by(&Tables::new(sources))
    }

    fn json_by(&self, tables: &Tables<'_>) -> String {
        let mut object = self.report(tables, |report| report.json());
        if let Some(fix) = &self.fix
            && let Some(source) = tables.sources.get(fix.span.file)
        {
            let bytes = fix.span.start as usize..fix.span.end as usize;
            let place = place(&source.name, bytes, tables.line_column(fix.span));
            object["fix"] = json!({ "place": place, "text": fix.text });
        }
        object.to_string()
    }
}
