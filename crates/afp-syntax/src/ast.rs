//! The typed view of the tree.
//!
//! Every part is optional, because the text may be incomplete. Readers skip missing parts: the
//! parser has already reported them.

mod bind;
mod comments;
mod device;
mod formula;
mod one_line;
mod plan;
mod scenario;
mod table;
mod toolbox;

use rowan::{GreenNodeData, GreenTokenData, Language, NodeOrToken};

use crate::diagnostics::{Arg, Diagnostics, ToArg};
use crate::keywords;
use crate::kind::{Afp, Kind};
use crate::source::Span;
use crate::tree::green_span;
use crate::{Node, Parse, node_span, parse};

use comments::{doc, note};

pub use crate::keywords::ENDS;
pub use afp_types::Operator;
pub use bind::Bind;
pub use device::{Amount, Control, Device, DeviceKind, DevicePart, Fault, Press, Signal};
pub use formula::{Formula, FormulaKind, Sign};
pub use plan::{Edge, Element, ElementKind, Entry, Frame, Guard, Plan, Reactions, Start};
pub use scenario::{Action, Bound, Claim, ClaimKind, ClaimTarget, Line, LineKind, Path, Scenario};
pub use table::{Column, Row, Table};
pub use toolbox::{
    Comparison, Exclusive, InPort, OutPort, Outcome, Part, Template, TemplateKind, Timing, Toolbox,
};

/// A name and its span.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    pub text: String,
    pub span: Span,
}

impl ToArg for Name {
    fn to_arg(&self) -> Arg {
        Arg::Name(self.text.clone())
    }
}

macro_rules! views {
    ($($(#[$doc:meta])* $name:ident)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Debug)]
        pub struct $name {
            node: crate::Node,
            file: u16,
        }

        impl $name {
            pub(crate) fn new(node: crate::Node, file: u16) -> $name {
                $name { node, file }
            }

            /// Its span, without surrounding comments.
            pub fn span(&self) -> crate::source::Span {
                crate::node_span(&self.node, self.file)
            }

            /// Its source text in one line, without comments.
            pub fn in_one_line(&self) -> String {
                crate::ast::one_line::in_one_line(&self.node)
            }
        }
    )*};
}
pub(crate) use views;

/// A node with a name and the help above it.
macro_rules! named {
    ($($name:ident)*) => {$(
        impl $name {
            pub fn name(&self) -> Option<crate::ast::Name> {
                crate::ast::token(&self.node, crate::kind::Kind::Name, self.file)
            }

            /// Its `///` lines.
            pub fn doc(&self) -> String {
                crate::ast::doc(&self.node)
            }
        }
    )*};
}
pub(crate) use named;

views! {
    File
    /// `use carbot as c` or `use "other.afp"`
    Use
    Enum
    /// `object Map`
    Object
    Type
    /// `name` or `home.name`
    Ref
}

named! { Enum Object }

/// An item of a file.
#[derive(Clone, Debug)]
pub enum Item {
    /// `use ...`
    Use(Use),
    Plan(Plan),
    Scenario(Scenario),
    Enum(Enum),
    Table(Table),
    /// The head of a toolbox.
    Toolbox(Toolbox),
    /// An object type of a toolbox.
    Object(Object),
    /// A template of a toolbox.
    Template(Template),
    /// A device of a toolbox.
    Device(Device),
}

impl File {
    /// The tree itself.
    pub fn root(&self) -> &Node {
        &self.node
    }

    /// The items in order, followed by items that are wrongly in the braces of a plan.
    pub fn items(&self) -> Vec<Item> {
        let file = self.file;
        let item = |node: Node| {
            Some(match node.kind() {
                Kind::Use => Item::Use(Use::new(node, file)),
                Kind::Plan => Item::Plan(Plan::new(node, file)),
                Kind::Scenario => Item::Scenario(Scenario::new(node, file)),
                Kind::Enum => Item::Enum(Enum::new(node, file)),
                Kind::Table => Item::Table(Table::new(node, file)),
                Kind::Toolbox => Item::Toolbox(Toolbox::new(node, file)),
                Kind::Object => Item::Object(Object::new(node, file)),
                Kind::Template => Item::Template(Template::new(node, file)),
                Kind::Device => Item::Device(Device::new(node, file)),
                _ => return None,
            })
        };
        let nodes = self.node.children().flat_map(|node| {
            let inside = inside_of_plan(&node);
            std::iter::once(node).chain(inside)
        });
        nodes.filter_map(item).collect()
    }

    /// The number of `afp 1`.
    pub fn version(&self) -> Option<Name> {
        let node = child(&self.node, Kind::Version)?;
        token(&node, Kind::Int, self.file)
    }
}

/// An item of a file that is in the braces of a plan.
fn inside_of_plan(plan: &Node) -> Vec<Node> {
    // Only the tree's own nodes are compared first, because a plan may have an error on each line.
    let is_error = |node: &GreenNodeData| Afp::kind_from_raw(node.kind()) == Kind::Error;
    let has_nodes = |node: &GreenNodeData| node.children().any(|it| it.as_node().is_some());
    let green = plan.green();
    let mut nodes = green.children().filter_map(NodeOrToken::into_node);
    if plan.kind() != Kind::Plan || !nodes.any(|node| is_error(node) && has_nodes(node)) {
        return Vec::new();
    }
    let errors = plan.children().filter(|node| node.kind() == Kind::Error);
    errors.flat_map(|error| error.children()).collect()
}

impl Use {
    /// Whether it is in a place for items of a file.
    pub fn is_in_place(&self) -> bool {
        self.node.parent().is_some_and(|parent| parent.kind() == Kind::File)
    }

    pub fn toolbox(&self) -> Option<Name> {
        token(&self.node, Kind::Name, self.file)
    }

    /// The short name after `as`.
    pub fn alias(&self) -> Option<Name> {
        let alias = child(&self.node, Kind::Alias)?;
        token(&alias, Kind::Name, self.file)
    }

    /// The name of the file, including the quotes.
    pub fn path(&self) -> Option<Name> {
        token(&self.node, Kind::Text, self.file)
    }
}

impl Enum {
    /// The comment above it.
    pub fn note(&self) -> String {
        note(&self.node)
    }

    pub fn variants(&self) -> Vec<Name> {
        children(&self.node, Kind::Variant)
            .filter_map(|node| token(&node, Kind::Name, self.file))
            .collect()
    }
}

impl Ref {
    /// The name before the dot; `None` without a dot.
    pub fn home(&self) -> Option<Name> {
        let last = self.name_span()?;
        find_token(&self.node, self.file, |kind, text, span| {
            let before = kind == Kind::Name && span != last;
            before.then(|| Name { text: text.to_owned(), span })
        })
    }

    /// The span of [`Ref::name`].
    pub fn name_span(&self) -> Option<Span> {
        last_token(&self.node, Kind::Name, self.file, |_, span| span)
    }

    /// The name, after the dot if there is one.
    pub fn name(&self) -> Option<Name> {
        let name = |text: &str, span| Name { text: text.to_owned(), span };
        last_token(&self.node, Kind::Name, self.file, name)
    }
}

/// A factor of a type.
#[derive(Clone, Debug)]
pub struct Factor {
    /// The name; `None` if the factor is [`Factor::number`].
    pub reference: Option<Ref>,
    /// The number, which should be `1`.
    pub number: Option<Name>,
    pub divides: bool,
    /// The exponent, `1` by default; `None` if it does not fit 8 bits.
    pub exponent: Option<i8>,
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
        let raised = token(node, Kind::Caret, self.file);
        let numbers = tokens(node, Kind::Int, self.file);
        let sign = if token(node, Kind::Minus, self.file).is_some() { "-" } else { "" };
        let exponent = match (&raised, numbers.last()) {
            (Some(_), Some(number)) => format!("{sign}{}", number.text).parse().ok(),
            _ => Some(1),
        };
        let reference = child(node, Kind::Ref).map(|node| Ref::new(node, self.file));
        let number = match reference {
            None => numbers.into_iter().next(),
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

/// The children of a node that starts at a byte, each with its own first byte. They are nodes of
/// the tree, because each step of a cursor costs an allocation.
fn parts(
    node: &GreenNodeData,
    mut start: u32,
) -> impl Iterator<Item = (NodeOrToken<&GreenNodeData, &GreenTokenData>, u32)> {
    node.children().map(move |element| {
        let own = start;
        start += u32::from(element.text_len());
        (element, own)
    })
}

fn kind_of(kind: rowan::SyntaxKind) -> Kind {
    Afp::kind_from_raw(kind)
}

/// A token that starts at a byte, with its text.
fn name(token: &GreenTokenData, start: u32, file: u16) -> Name {
    let end = start + u32::from(token.text_len());
    Name { text: token.text().to_owned(), span: Span { file, start, end } }
}

/// Calls a function for the tokens among the children of a node until it returns something.
fn find_token<R>(
    node: &Node,
    file: u16,
    mut look: impl FnMut(Kind, &str, Span) -> Option<R>,
) -> Option<R> {
    let green = node.green();
    parts(&green, node.text_range().start().into()).find_map(|(element, start)| {
        let token = element.into_token()?;
        let end = start + u32::from(token.text_len());
        look(kind_of(token.kind()), token.text(), Span { file, start, end })
    })
}

/// The span of the first token of a kind.
fn span_of(node: &Node, kind: Kind, file: u16) -> Option<Span> {
    find_token(node, file, |each, _, span| (each == kind).then_some(span))
}

/// The span of the first node of a kind among the children of a node.
fn child_span(node: &Node, kind: Kind, file: u16) -> Option<Span> {
    let green = node.green();
    parts(&green, node.text_range().start().into()).find_map(|(element, start)| {
        let child = element.into_node().filter(|each| kind_of(each.kind()) == kind)?;
        Some(green_span(child, start, file))
    })
}

/// The result of a function for the last token of a kind.
fn last_token<R>(
    node: &Node,
    kind: Kind,
    file: u16,
    read: impl FnOnce(&str, Span) -> R,
) -> Option<R> {
    let mut start = u32::from(node.text_range().end());
    let green = node.green();
    let (text, span) = green.children().rev().find_map(|element| {
        let end = start;
        start -= u32::from(element.text_len());
        let token = element.into_token()?;
        let found = kind_of(token.kind()) == kind;
        found.then_some((token.text(), Span { file, start, end }))
    })?;
    Some(read(text, span))
}

/// The first token of a kind.
fn token(node: &Node, kind: Kind, file: u16) -> Option<Name> {
    find_token(node, file, |each, text, span| {
        (each == kind).then(|| Name { text: text.to_owned(), span })
    })
}

fn tokens(node: &Node, kind: Kind, file: u16) -> Vec<Name> {
    let green = node.green();
    let tokens = parts(&green, node.text_range().start().into())
        .filter_map(|(element, start)| element.into_token().zip(Some(start)));
    let of_kind = tokens.filter(|(token, _)| kind_of(token.kind()) == kind);
    of_kind.map(|(token, start)| name(token, start, file)).collect()
}

/// The span of `live` in a node.
fn live(node: &Node, file: u16) -> Option<Span> {
    let words = tokens(node, Kind::Keyword, file);
    words.iter().skip(1).find(|word| word.text == "live").map(|word| word.span)
}

/// The ends of the range in a node; an end may be missing.
fn range_ends(node: &Node, file: u16) -> Vec<Formula> {
    child(node, Kind::Range).map(|range| Formula::children_of(&range, file)).unwrap_or_default()
}

/// The least and the greatest value in a node, and the span of both.
fn range(node: &Node, file: u16) -> Option<(Formula, Formula, Span)> {
    let mut ends = range_ends(node, file).into_iter();
    let (from, to) = (ends.next()?, ends.next()?);
    let span = from.span().to(to.span());
    Some((from, to, span))
}

impl Parse {
    /// The typed view of the tree.
    pub fn file(&self) -> File {
        File::new(self.root(), self.file)
    }
}

/// Whether a file has a scenario, or may have a scenario that an error hides.
pub fn may_have_scenario(text: &str) -> bool {
    let mut diags = Diagnostics::default();
    let items = parse(text, 0, &mut diags).file().items();
    diags.has_errors() || items.iter().any(|item| matches!(item, Item::Scenario(_)))
}

/// The first word of the grammar in a node.
fn keyword(node: &Node) -> String {
    keyword_as(node, str::to_owned)
}

/// The first word of the grammar in a node, and its span.
fn keyword_token(node: &Node, file: u16) -> Option<Name> {
    let written = token(node, Kind::Keyword, file)?;
    Some(Name { text: keyword(node), span: written.span })
}

/// The role of the first word of the grammar in a node.
fn keyword_as<R>(node: &Node, read: impl Fn(&str) -> R) -> R {
    let own = node.kind();
    let read = |text: &str| read(keywords::of_item(own, text));
    find_token(node, 0, |kind, text, _| (kind == Kind::Keyword).then(|| read(text)))
        .unwrap_or_else(|| read(""))
}
