//! Places in the texts of plans, as people know them.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::graph::Graph;
use afp_syntax::source::{Source, Span};

/// The texts of the plans of a graph. Places are looked up when somebody asks: plans have many, and few are shown.
#[derive(Clone, Debug, Default)]
pub struct PlanTexts {
    /// The plan files by their numbers.
    files: BTreeMap<u16, File>,
}

#[derive(Clone, Debug)]
struct File {
    /// Its path, seen from the folder of the main plan's file.
    name: String,
    source: Arc<Source>,
    /// Where each line but the first starts.
    lines: Vec<usize>,
}

/// A place in the text of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextPlace<'a> {
    /// The file, seen from the folder of the main plan's file.
    pub file: &'a str,
    /// The line, from 1.
    pub line: u32,
    /// The column in characters, from 1.
    pub column: u32,
}

impl PlanTexts {
    pub(super) fn new(graph: &Graph) -> Self {
        let last = |path: &str| path.rsplit(['/', '\\']).next().unwrap_or_default().to_owned();
        let files = graph.plans.iter().filter_map(|plan| {
            let file = plan.span.file;
            let (_, source) = graph.sources.iter().find(|(number, _)| *number == file)?;
            let name = plan.file.clone().unwrap_or_else(|| last(&source.name));
            let ends = source.text.match_indices('\n').map(|(at, _)| at + 1);
            Some((file, File { name, source: Arc::clone(source), lines: ends.collect() }))
        });
        PlanTexts { files: files.collect() }
    }

    /// Where a span of a plan begins; `None` for one of a toolbox.
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
