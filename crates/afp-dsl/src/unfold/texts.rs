//! Source places in plans, as line and column.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::graph::Graph;
use afp_syntax::source::{Source, Span};

/// The sources of a graph's plans. Places are looked up on demand: plans have many, and few are
/// shown.
#[derive(Clone, Debug, Default)]
pub struct PlanTexts {
    files: BTreeMap<u16, File>,
}

#[derive(Clone, Debug)]
struct File {
    /// Its path, relative to the main plan's folder.
    name: String,
    source: Arc<Source>,
    /// Starts of lines, except the first.
    lines: Vec<usize>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextPlace<'a> {
    /// The file, relative to the main plan's folder.
    pub file: &'a str,
    /// The line, from 1.
    pub line: u32,
    /// The column in characters, from 1.
    pub column: u32,
}

impl PlanTexts {
    pub(super) fn new(graph: &Graph) -> Self {
        let last = |path: &str| path.rsplit(['/', '\\']).next().unwrap_or_default().to_owned();
        let files = graph.sources.iter().map(|(file, source)| {
            let plan = graph.plans.iter().find(|plan| plan.span.file == *file);
            let name = plan.and_then(|plan| plan.file.clone());
            let name = name.unwrap_or_else(|| last(&source.name));
            let ends = source.text.match_indices('\n').map(|(at, _)| at + 1);
            (*file, File { name, source: Arc::clone(source), lines: ends.collect() })
        });
        PlanTexts { files: files.collect() }
    }

    /// The start of a span; `None` for a toolbox.
    pub fn place(&self, span: Span) -> Option<TextPlace<'_>> {
        let file = self.files.get(&span.file)?;
        let text = &file.source.text;
        let at = text.floor_char_boundary(span.start as usize);
        let line = file.lines.partition_point(|start| *start <= at);
        let start = line.checked_sub(1).and_then(|line| file.lines.get(line)).copied();
        let column = text.get(start.unwrap_or(0)..at)?.chars().count();
        let [line, column] = [line, column].map(|at| u32::try_from(at).unwrap_or(u32::MAX));
        let (line, column) = (line.saturating_add(1), column.saturating_add(1));
        Some(TextPlace { file: &file.name, line, column })
    }
}
