//! Who refers to what a name means.

use crate::View;
use afp_dsl::index::DefinitionId;
use afp_syntax::source::Span;

/// The places in all files of the compilation that refer to what the name at a byte means, in order,
/// its own declaration among them.
pub fn references(view: &View, offset: u32) -> Vec<Span> {
    let id = view.name_at(offset).and_then(|name| name.meaning.definition());
    id.map_or_else(Vec::new, |id| of(view, id))
}

/// The places in all files of the compilation that refer to what is declared at a place, in order, the
/// place itself among them; none where nothing is declared there.
pub fn references_to(view: &View, name: Span) -> Vec<Span> {
    view.index().declared_at(name).map_or_else(Vec::new, |id| of(view, id))
}

/// Those of them that stand in the file itself.
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
