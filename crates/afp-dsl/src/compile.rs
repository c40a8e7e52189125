//! The front door: a plan's text in; its graph, or everything that is wrong with it, out.

use std::sync::Arc;

use crate::check::{self, Flow};
use crate::diagnostics::Diagnostics;
use crate::graph::Graph;
use crate::source::{Source, Sources, Span};
use crate::syntax;
use crate::timing;
use crate::toolbox::Toolboxes;

/// What became of a text.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// The static graph; `None` exactly when there are errors.
    pub graph: Option<Graph>,
    /// Everything there is to say, ordered by place.
    pub diags: Diagnostics,
    /// The files that spans belong to: the toolboxes', then the plan's.
    pub sources: Sources,
}

impl Compiled {
    /// The diagnostics as text for people, see [`Diagnostics::render`].
    pub fn render(&self, colour: bool) -> String {
        self.diags.render(&self.sources, colour)
    }
}

/// Compiles the first plan of a file.
///
/// All errors are reported, of plans that the first one does not use as well, and of toolboxes.
pub fn compile(source: &Source, toolboxes: &Toolboxes) -> Compiled {
    compile_plan(source, toolboxes, None)
}

/// Compiles the plan of that name in a file, the first one without a name.
pub fn compile_plan(source: &Source, toolboxes: &Toolboxes, plan: Option<&str>) -> Compiled {
    compile_with(source, toolboxes, plan, Flow::Checked)
}

/// Compiles the first plan of a file without the checks of flow: for tests of what the run time
/// does with plans that they refuse.
#[doc(hidden)]
pub fn compile_unchecked(source: &Source, toolboxes: &Toolboxes) -> Compiled {
    compile_with(source, toolboxes, None, Flow::Unchecked)
}

fn compile_with(
    source: &Source,
    toolboxes: &Toolboxes,
    plan: Option<&str>,
    flow: Flow,
) -> Compiled {
    let mut diags = toolboxes.diagnostics().clone();
    let mut sources = toolboxes.sources().clone();
    // Beyond 65,536 files spans would be ambiguous; nothing can be said about such a compilation.
    let file = sources.add(Arc::new(source.clone())).unwrap_or(u16::MAX);
    let tree = syntax::parse(&source.text, file, &mut diags).file();
    let end = u32::try_from(source.text.len()).unwrap_or(u32::MAX);
    let whole = Span { file, start: 0, end };
    let graph = check::check(&tree, &source.text, whole, toolboxes, plan, flow, &mut diags);
    if let Some(graph) = graph.as_ref().filter(|_| flow == Flow::Checked) {
        timing::check_responses(graph, &mut diags);
    }
    diags.sort();
    Compiled { graph: graph.filter(|_| !diags.has_errors()), diags, sources }
}
