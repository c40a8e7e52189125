//! Computations declared in a plan file; their names share the namespace of plans.

use std::sync::Arc;

use crate::check::imports::Import;
use crate::check::tables;
use crate::check::toolbox::computation;
use crate::check::types::Types;
use crate::gather::PlanFile;
use crate::graph::ToolboxId;
use crate::index::Recorder;
use crate::toolbox::Toolbox;
use afp_syntax::ast::{Item, Name};
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::source::Span;

/// The computations of a file as a nameless toolbox, which is added to `linked`; `None` without
/// any.
pub(super) fn own(
    file: &PlanFile,
    types: &Types,
    linked: &mut Vec<Arc<Toolbox>>,
    record: &Recorder,
    diags: &mut Diagnostics,
) -> Option<Import> {
    let items = file.tree.items();
    let nodes = items.iter().filter_map(|item| match item {
        Item::Template(node) if node.is_declared() => Some(node),
        _ => None,
    });
    let nodes: Vec<_> = nodes.collect();
    if nodes.is_empty() || items.iter().any(|item| matches!(item, Item::Toolbox(_))) {
        return None;
    }
    let types = Types { generic: true, ..types.clone() };
    let mut names = tables::other_names(&items);
    for item in &items {
        if let Item::Table(table) = item
            && let Some(name) = table.name()
        {
            names.declare(&name, &mut Diagnostics::default());
        }
    }
    let templates = nodes.into_iter().filter_map(|node| {
        let template = computation(node, (&types, &file.source.text), record, diags)?;
        let name = Name { text: template.name.clone(), span: template.span };
        names.declare(&name, diags).then_some(template)
    });
    let templates: Vec<_> = templates.collect();
    let span = templates.first().map_or(Span::default(), |first| first.span);
    let toolbox = Arc::new(Toolbox { templates, span, ..Toolbox::default() });
    let id = ToolboxId(u16::try_from(linked.len()).ok()?);
    linked.push(Arc::clone(&toolbox));
    Some(Import { qualifier: String::new(), span, toolbox, id })
}
