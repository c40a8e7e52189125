//! What a file is made of, as a tree of names.

use crate::View;
use crate::describe::declaration;
use afp_dsl::index::{DefinitionId, DefinitionKind};
use afp_syntax::source::Span;

/// Something that has a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// Its name; of a scenario without the quotes.
    pub name: String,
    pub kind: DefinitionKind,
    /// How it is declared, in one line.
    pub detail: String,
    /// The whole of it, all that is declared in it included.
    pub span: Span,
    /// Its own name.
    pub name_span: Span,
    /// What is declared in it, in the order of the text.
    pub children: Vec<Symbol>,
}

/// The symbols of the file in the order of the text; names of toolboxes behind `as` are none.
pub fn symbols(view: &View) -> Vec<Symbol> {
    let top = view.index().definitions_in(view.file);
    let top = top.filter(|(_, known)| known.owner.is_none() && known.kind != DefinitionKind::Alias);
    top.map(|(id, _)| symbol(view, id)).collect()
}

fn symbol(view: &View, id: DefinitionId) -> Symbol {
    let definition = view.index().definition(id);
    let children: Vec<_> =
        view.index().members(id).map(|(member, _)| symbol(view, member)).collect();
    // A toolbox has the whole file below its own line.
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
