//! Semantic tokens of a file.

use crate::View;
use afp_dsl::graph::EntryKind;
use afp_dsl::index::{DefinitionKind, Meaning, Word};
use afp_syntax::Token;
use afp_syntax::kind::Kind;
use afp_syntax::source::Span;

/// A piece of text with one colour, within a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour {
    pub span: Span,
    pub kind: ColourKind,
    pub declares: bool,
    /// Whether it never changes.
    pub constant: bool,
}

macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident $name:literal)*) => {
        /// The kind of a piece of text, with its name in the protocol.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum ColourKind {
            $($(#[$doc])* $kind,)*
        }

        impl ColourKind {
            pub const ALL: &'static [ColourKind] = &[$(ColourKind::$kind),*];

            pub fn name(self) -> &'static str {
                match self {
                    $(ColourKind::$kind => $name,)*
                }
            }
        }
    };
}

kinds! {
    Keyword "keyword"
    Comment "comment"
    Text "string"
    Number "number"
    Operator "operator"
    /// A toolbox or its short name.
    Toolbox "namespace"
    /// A built-in type or an object type.
    Type "type"
    Enum "enum"
    Value "enumMember"
    Template "class"
    Component "function"
    Entry "variable"
    Port "parameter"
    Outcome "event"
    Device "property"
}

/// Returns all colours in source order; erroneous text and punctuation have none.
pub fn colours(view: &View) -> Vec<Colour> {
    let tokens = view.root().descendants_with_tokens().filter_map(|each| each.into_token());
    tokens.filter_map(|token| colour(view, &token)).collect()
}

fn colour(view: &View, token: &Token) -> Option<Colour> {
    let span = view.token_span(token);
    let plain = |kind| Some(Colour { span, kind, declares: false, constant: false });
    match token.kind() {
        Kind::Keyword => plain(ColourKind::Keyword),
        // A comment over several lines is an error.
        Kind::Comment | Kind::Doc => plain(ColourKind::Comment),
        Kind::Int | Kind::Float | Kind::Unit => plain(ColourKind::Number),
        Kind::Name => name(view, span),
        Kind::Text if token.text().contains('\n') => None,
        Kind::Text => plain(ColourKind::Text),
        kind if is_operator(kind) => plain(ColourKind::Operator),
        _ => None,
    }
}

fn is_operator(kind: Kind) -> bool {
    use Kind::{Arrow, Caret, Equal, EqualEqual, FatArrow, Greater, GreaterEqual};
    use Kind::{Less, LessEqual, Minus, NotEqual, Percent, Plus, Slash, Star};
    matches!(kind, Equal | FatArrow | Arrow | Plus | Minus | Star | Slash | Percent | Caret)
        || matches!(kind, EqualEqual | NotEqual | Less | LessEqual | Greater | GreaterEqual)
}

fn name(view: &View, span: Span) -> Option<Colour> {
    let meaning = view.index().name(span)?.meaning;
    let definition = meaning.definition().map(|id| view.index().definition(id).kind);
    let kind = match meaning {
        Meaning::Word(word) => of_word(word),
        Meaning::Ambiguous(several) => {
            let first = view.index().candidates(several).first()?;
            of_definition(view.index().definition(*first).kind)
        }
        _ => of_definition(definition?),
    };
    let constant =
        matches!(definition, Some(DefinitionKind::Entry(EntryKind::Const) | DefinitionKind::Table));
    let declares = matches!(meaning, Meaning::Declares(_));
    Some(Colour { span, kind, declares, constant })
}

fn of_word(word: Word) -> ColourKind {
    match word {
        Word::Type => ColourKind::Type,
        Word::Ok | Word::Interrupted | Word::Error | Word::DeadlineMissed => ColourKind::Outcome,
        Word::Resource | Word::Fault | Word::Amount | Word::Field => ColourKind::Device,
        _ => ColourKind::Keyword,
    }
}

fn of_definition(kind: DefinitionKind) -> ColourKind {
    use DefinitionKind as Is;
    match kind {
        Is::Toolbox | Is::Alias => ColourKind::Toolbox,
        Is::Template(_) | Is::Plan => ColourKind::Template,
        Is::Input | Is::Output | Is::Column => ColourKind::Port,
        Is::State | Is::Event => ColourKind::Outcome,
        Is::Object => ColourKind::Type,
        Is::Enum => ColourKind::Enum,
        Is::Value => ColourKind::Value,
        Is::Entry(_) | Is::Table => ColourKind::Entry,
        Is::Component(_) => ColourKind::Component,
        Is::Scenario => ColourKind::Text,
        _ => ColourKind::Device,
    }
}
