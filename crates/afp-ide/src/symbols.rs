//! The outline of a file, as a tree of names.

use crate::View;
use crate::describe::declaration;
use afp_dsl::index::{DefinitionId, DefinitionKind};
use afp_syntax::source::Span;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// Its name; for a scenario without the quotes.
    pub name: String,
    pub kind: DefinitionKind,
    /// Its declaration in one line.
    pub detail: String,
    pub span: Span,
    pub name_span: Span,
    pub children: Vec<Symbol>,
}

/// Returns the symbols of the file in source order, without aliases.
pub fn symbols(view: &View) -> Vec<Symbol> {
    let top = view.index().definitions_in(view.file);
    let top = top.filter(|(_, known)| known.owner.is_none() && known.kind != DefinitionKind::Alias);
    top.map(|(id, _)| symbol(view, id)).collect()
}

fn symbol(view: &View, id: DefinitionId) -> Symbol {
    let definition = view.index().definition(id);
    let children: Vec<_> =
        view.index().members(id).map(|(member, _)| symbol(view, member)).collect();
    // A toolbox contains the whole file after its own line.
    let span = children.iter().fold(definition.span, |span, child| Span {
        start: span.start.min(child.span.start),
        end: span.end.max(child.span.end),
        ..span
    });
    Symbol {
        name: view.name_of(id).trim_matches('"').to_owned(),
        kind: definition.kind,
        detail: declaration(view, id),
        span,
        name_span: definition.name,
        children,
    }
}
