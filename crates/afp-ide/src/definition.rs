//! The declaration and the template of a name.

use crate::View;
use afp_dsl::index::{DefinitionId, DefinitionKind, Meaning};
use afp_syntax::source::Span;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Target {
    /// Its name; for a whole file, its first byte.
    pub name: Span,
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Definitions {
    /// The name at the cursor.
    pub origin: Span,
    /// The declarations: several for an ambiguous name, or for an entry and its port.
    pub targets: Vec<Target>,
}

/// Returns the declaration of the name at a byte offset; `None` without a known name.
pub fn definition(view: &View, offset: u32) -> Option<Definitions> {
    let name = view.name_at(offset)?;
    let targets = match name.meaning {
        Meaning::Ambiguous(several) => {
            view.index().candidates(several).iter().map(|id| target(view, *id)).collect()
        }
        Meaning::Both { entry, port } => vec![target(view, entry), target(view, port)],
        Meaning::File(file) => {
            let first = Span { file, start: 0, end: 0 };
            vec![Target { name: first, span: first }]
        }
        meaning => vec![target(view, meaning.definition()?)],
    };
    Some(Definitions { origin: name.span, targets })
}

/// Returns the template or type of the name at a byte offset: of an element, an entry or a
/// scenario.
pub fn type_definition(view: &View, offset: u32) -> Option<Definitions> {
    let name = view.name_at(offset)?;
    let made = view.index().definition(name.meaning.definition()?).made_from?;
    Some(Definitions { origin: name.span, targets: vec![target(view, made)] })
}

fn target(view: &View, id: DefinitionId) -> Target {
    let definition = view.index().definition(id);
    match (definition.kind, definition.made_from) {
        // The target of an alias is the toolbox.
        (DefinitionKind::Alias, Some(toolbox)) => target(view, toolbox),
        _ => Target { name: definition.name, span: definition.span },
    }
}
