//! Diagnostics for tools: one JSON object on a line.

use afp_excerpt::place;
use serde_json::json;

use super::tables::Tables;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::source::Sources;

impl Diagnostics {
    /// All diagnostics, one JSON object on each line.
    pub fn json_lines(&self, sources: &Sources) -> String {
        let tables = Tables::new(sources);
        self.iter().map(|each| each.json_by(&tables) + "\n").collect()
    }
}

impl Diagnostic {
    /// The diagnostic as one JSON object without line breaks.
    ///
    /// Keys are those of [`afp_excerpt::Report::json`] and, where there is an edit that follows the help, `fix` (`place`
    /// and `text`).
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
