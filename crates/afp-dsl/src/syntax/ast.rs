//! The typed view of the tree.
//!
//! Every part may be missing, since the text may be half typed; whoever reads the view skips holes,
//! for which the parser has reported an error already.

mod formula;
mod plan;
mod toolbox;

use crate::source::Span;
use crate::syntax::kind::Kind;
use crate::syntax::{Node, Token, node_span, token_span};

pub use formula::{Formula, FormulaKind, Sign};
pub use plan::{Bind, Edge, Element, ElementKind, Entry, Guard, Plan, Start};
pub use toolbox::{InPort, OutPort, Outcome, Part, Template, TemplateKind, Timing, Toolbox};

/// A name and its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    /// The name.
    pub text: String,
    /// Its place.
    pub span: Span,
}

macro_rules! views {
    ($($(#[$doc:meta])* $name:ident)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Debug)]
        pub struct $name {
            node: crate::syntax::Node,
            file: u16,
        }

        impl $name {
            pub(crate) fn new(node: crate::syntax::Node, file: u16) -> $name {
                $name { node, file }
            }

            /// Its place, without comments around it.
            pub fn span(&self) -> crate::source::Span {
                crate::syntax::node_span(&self.node, self.file)
            }
        }
    )*};
}
pub(crate) use views;

views! {
    /// A file.
    File
    /// `use carbot as c` or `use "other.afp"`
    Use
    /// An enum.
    Enum
    /// `object Map`
    Object
    /// A scenario.
    Scenario
    /// A type.
    Type
    /// `name` or `home.name`
    Ref
}

/// What stands at the top of a file.
#[derive(Clone, Debug)]
pub enum Item {
    /// `use ...`
    Use(Use),
    /// A plan.
    Plan(Plan),
    /// A scenario.
    Scenario(Scenario),
    /// An enum.
    Enum(Enum),
    /// The head of a toolbox.
    Toolbox(Toolbox),
    /// An object type of a toolbox.
    Object(Object),
    /// A template of a toolbox.
    Template(Template),
}

impl File {
    /// The items in order.
    pub fn items(&self) -> Vec<Item> {
        let file = self.file;
        let item = |node: Node| {
            Some(match node.kind() {
                Kind::Use => Item::Use(Use::new(node, file)),
                Kind::Plan => Item::Plan(Plan::new(node, file)),
                Kind::Scenario => Item::Scenario(Scenario::new(node, file)),
                Kind::Enum => Item::Enum(Enum::new(node, file)),
                Kind::Toolbox => Item::Toolbox(Toolbox::new(node, file)),
                Kind::Object => Item::Object(Object::new(node, file)),
                Kind::Template => Item::Template(Template::new(node, file)),
                _ => return None,
            })
        };
        self.node.children().filter_map(item).collect()
    }

    /// The number of `afp 1`.
    pub fn version(&self) -> Option<Name> {
        let node = child(&self.node, Kind::Version)?;
        token(&node, Kind::Int).map(|token| named(&token, self.file))
    }
}

impl Use {
    /// The toolbox's name.
    pub fn toolbox(&self) -> Option<Name> {
        token(&self.node, Kind::Name).map(|token| named(&token, self.file))
    }

    /// The short name behind `as`.
    pub fn alias(&self) -> Option<Name> {
        let alias = child(&self.node, Kind::Alias)?;
        token(&alias, Kind::Name).map(|token| named(&token, self.file))
    }

    /// The file's name, quotes included.
    pub fn path(&self) -> Option<Name> {
        token(&self.node, Kind::Text).map(|token| named(&token, self.file))
    }
}

impl Enum {
    /// Its name.
    pub fn name(&self) -> Option<Name> {
        token(&self.node, Kind::Name).map(|token| named(&token, self.file))
    }

    /// Its `///` lines.
    pub fn doc(&self) -> String {
        doc(&self.node)
    }

    /// The names of its values.
    pub fn variants(&self) -> Vec<Name> {
        children(&self.node, Kind::Variant)
            .filter_map(|node| token(&node, Kind::Name).map(|token| named(&token, self.file)))
            .collect()
    }
}

impl Object {
    /// Its name.
    pub fn name(&self) -> Option<Name> {
        token(&self.node, Kind::Name).map(|token| named(&token, self.file))
    }

    /// Its `///` lines.
    pub fn doc(&self) -> String {
        doc(&self.node)
    }
}

impl Scenario {
    /// Its name, quotes included.
    pub fn name(&self) -> Option<Name> {
        token(&self.node, Kind::Text).map(|token| named(&token, self.file))
    }
}

impl Ref {
    /// The name before the point; `None` without a point.
    pub fn home(&self) -> Option<Name> {
        let mut names = self.names();
        if names.len() > 1 { Some(names.swap_remove(0)) } else { None }
    }

    /// The name, behind the point if there is one.
    pub fn name(&self) -> Option<Name> {
        self.names().pop()
    }

    fn names(&self) -> Vec<Name> {
        tokens(&self.node, Kind::Name).map(|token| named(&token, self.file)).collect()
    }
}

/// A factor of a type.
#[derive(Clone, Debug)]
pub struct Factor {
    /// The name; `None` stands for the number in [`Factor::number`].
    pub reference: Option<Ref>,
    /// The number, which should be `1`.
    pub number: Option<Name>,
    /// Whether it divides.
    pub divides: bool,
    /// The exponent as written, `1` without one; `None` when it does not fit 8 bits.
    pub exponent: Option<i8>,
    /// Its place.
    pub span: Span,
}

impl Type {
    /// Its factors in order.
    pub fn factors(&self) -> Vec<Factor> {
        let mut divides = false;
        let mut factors = Vec::new();
        for element in self.node.children_with_tokens() {
            match element.kind() {
                Kind::Star => divides = false,
                Kind::Slash => divides = true,
                Kind::Factor => {
                    factors.extend(element.as_node().map(|node| self.factor(node, divides)));
                }
                _ => {}
            }
        }
        factors
    }

    fn factor(&self, node: &Node, divides: bool) -> Factor {
        let raised = token(node, Kind::Caret);
        let numbers: Vec<_> = tokens(node, Kind::Int).collect();
        let sign = if token(node, Kind::Minus).is_some() { "-" } else { "" };
        let exponent = match (&raised, numbers.last()) {
            (Some(_), Some(number)) => format!("{sign}{}", number.text()).parse().ok(),
            _ => Some(1),
        };
        let reference = child(node, Kind::Ref).map(|node| Ref::new(node, self.file));
        let number = match reference {
            None => numbers.first().map(|token| named(token, self.file)),
            Some(_) => None,
        };
        Factor { reference, number, divides, exponent, span: node_span(node, self.file) }
    }
}

fn child(node: &Node, kind: Kind) -> Option<Node> {
    children(node, kind).next()
}

fn children(node: &Node, kind: Kind) -> impl Iterator<Item = Node> {
    node.children().by_kind(move |each| each == kind)
}

fn token(node: &Node, kind: Kind) -> Option<Token> {
    tokens(node, kind).next()
}

fn tokens(node: &Node, kind: Kind) -> impl Iterator<Item = Token> {
    let found = node.children_with_tokens().by_kind(move |each| each == kind);
    found.filter_map(|element| element.into_token())
}

fn named(token: &Token, file: u16) -> Name {
    Name { text: token.text().to_owned(), span: token_span(token, file) }
}

/// The first word of the grammar in a node.
fn keyword(node: &Node) -> String {
    token(node, Kind::Keyword).map(|token| token.text().to_owned()).unwrap_or_default()
}

/// The `///` lines in front of an item, without the slashes and one blank behind them.
fn doc(node: &Node) -> String {
    let lines: Vec<_> = tokens(node, Kind::Doc)
        .map(|token| {
            let text = token.text().trim_start_matches('/');
            text.strip_prefix(' ').unwrap_or(text).trim_end().to_owned()
        })
        .collect();
    lines.join("\n")
}
