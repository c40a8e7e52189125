//! Where what a name means is declared, and what it is made from.

use crate::View;
use afp_dsl::index::{DefinitionId, DefinitionKind, Meaning};
use afp_syntax::source::Span;

/// A declaration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Target {
    /// Its name; of a whole file its first byte.
    pub name: Span,
    /// The whole of it.
    pub span: Span,
}

/// A name and where it leads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Definitions {
    /// The name that was asked about.
    pub origin: Span,
    /// Where it is declared; several places where it is ambiguous, or stands for an entry and its port.
    pub targets: Vec<Target>,
}

/// Where the name at a byte is declared; `None` where no name stands or nothing is known of it.
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

/// What the name at a byte is made from: the template of an element, the enum of an entry, the plan of
/// a scenario.
pub fn type_definition(view: &View, offset: u32) -> Option<Definitions> {
    let name = view.name_at(offset)?;
    let made = view.index().definition(name.meaning.definition()?).made_from?;
    Some(Definitions { origin: name.span, targets: vec![target(view, made)] })
}

fn target(view: &View, id: DefinitionId) -> Target {
    let definition = view.index().definition(id);
    match (definition.kind, definition.made_from) {
        // Who follows a short name means the toolbox.
        (DefinitionKind::Alias, Some(toolbox)) => target(view, toolbox),
        _ => Target { name: definition.name, span: definition.span },
    }
}
