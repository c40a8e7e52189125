//! References to a name.

use crate::View;
use afp_dsl::index::DefinitionId;
use afp_syntax::source::Span;

/// Returns all references in the compilation to the name at a byte offset, in order, with its
/// declaration.
pub fn references(view: &View, offset: u32) -> Vec<Span> {
    let id = view.name_at(offset).and_then(|name| name.meaning.definition());
    id.map_or_else(Vec::new, |id| of(view, id))
}

/// Returns all references in the compilation to a declaration, in order, with the declaration
/// itself; empty without a declaration at that place.
pub fn references_to(view: &View, name: Span) -> Vec<Span> {
    view.index().declared_at(name).map_or_else(Vec::new, |id| of(view, id))
}

/// Returns the references in the file itself.
pub fn highlights(view: &View, offset: u32) -> Vec<Span> {
    let mut all = references(view, offset);
    all.retain(|span| span.file == view.file);
    all
}

fn of(view: &View, id: DefinitionId) -> Vec<Span> {
    let mut all: Vec<_> = view.index().references(id).collect();
    all.push(view.index().definition(id).name);
    all.sort_unstable();
    all
}
