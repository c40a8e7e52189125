use super::bind::{Bind, binds};
use super::{
    Formula, Name, Ref, Timing, Type, child, child_span, children, doc, keyword, keyword_as,
    kind_of, last_token, live, name, named, note, parts, range, range_ends, span_of, token, tokens,
    views,
};
use crate::kind::Kind;
use crate::source::Span;
use crate::{Node, node_span};
use rowan::{GreenNodeData, NodeOrToken};

views! {
    Plan
    /// `in`, `out`, `var` or `const`
    Entry
    /// `start first`
    Start
    /// An actor, a computation or a sub-plan.
    Element
    Guard
    /// `on keys { Start -> drive }`
    Reactions
}

named! { Plan Entry Element Guard Reactions }

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElementKind {
    Actor,
    Computation,
    SubPlan,
}

/// `State -> target`, or `-> target` without braces.
#[derive(Clone, Debug)]
pub struct Edge {
    /// The states or events of the edge. An empty list means the only state of the element.
    pub names: Vec<Name>,
    pub arrow: Option<Span>,
    /// The word `suspend` before the target, if written.
    pub suspends: Option<Span>,
    pub target: Option<Name>,
    /// The text after `fail`, quotes included.
    pub reason: Option<Name>,
}

/// The parts around the body of an element or supervisor.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Its `///` lines.
    pub doc: String,
    /// The comment above it.
    pub note: String,
    /// Its place, without comments around it.
    pub span: Span,
    /// The place of the brackets with its bindings.
    pub args_span: Option<Span>,
    /// The place of its closing brace.
    pub end_span: Option<Span>,
}

impl Plan {
    /// The comment above it.
    pub fn note(&self) -> String {
        note(&self.node)
    }

    /// The place of `forever`, if written.
    pub fn forever(&self) -> Option<Span> {
        let mut words = tokens(&self.node, Kind::Keyword, self.file).into_iter().skip(1);
        words.find(|word| word.text == "forever").map(|word| word.span)
    }

    /// All names in it, of any kind.
    pub fn names(&self) -> impl Iterator<Item = String> + use<> {
        let tokens = self.node.descendants_with_tokens().filter_map(|each| each.into_token());
        tokens.filter(|token| token.kind() == Kind::Name).map(|token| token.text().to_owned())
    }

    pub fn entries(&self) -> Vec<Entry> {
        children(&self.node, Kind::Entry).map(|node| Entry::new(node, self.file)).collect()
    }

    /// Its `start` lines; a correct plan has one.
    pub fn starts(&self) -> Vec<Start> {
        children(&self.node, Kind::Start).map(|node| Start::new(node, self.file)).collect()
    }

    /// Its global supervisors.
    pub fn guards(&self) -> Vec<Guard> {
        guards(&self.node, self.file)
    }

    pub fn elements(&self) -> Vec<Element> {
        children(&self.node, Kind::Element).map(|node| Element::new(node, self.file)).collect()
    }
}

impl Entry {
    /// `in`, `out`, `var` or `const`.
    pub fn keyword(&self) -> String {
        keyword(&self.node)
    }

    /// The place of `live`, if written.
    pub fn live(&self) -> Option<Span> {
        live(&self.node, self.file)
    }

    /// The comment above it.
    pub fn note(&self) -> String {
        note(&self.node)
    }

    pub fn ty(&self) -> Option<Type> {
        child(&self.node, Kind::Type).map(|node| Type::new(node, self.file))
    }

    pub fn init(&self) -> Option<Formula> {
        Formula::child_of(&self.node, self.file)
    }

    /// The bounds, and the place of both.
    pub fn range(&self) -> Option<(Formula, Formula, Span)> {
        range(&self.node, self.file)
    }

    /// The bounds, as far as written.
    pub fn ends(&self) -> Vec<Formula> {
        range_ends(&self.node, self.file)
    }
}

impl Start {
    pub fn target(&self) -> Option<Name> {
        token(&self.node, Kind::Name, self.file)
    }
}

/// Methods of items that have edges, and of items that are made from templates.
macro_rules! components {
    ($($name:ident)*; $($made:ident)*) => {
        $(impl $name {
            pub fn edges(&self) -> Vec<Edge> {
                edges(&self.node, self.file)
            }

            pub fn frame(&self) -> Frame {
                frame(&self.node, self.file)
            }
        })*

        $(impl $made {
            pub fn template(&self) -> Option<Ref> {
                child(&self.node, Kind::Ref).map(|node| Ref::new(node, self.file))
            }

            pub fn binds(&self) -> Vec<Bind> {
                binds(&self.node, self.file)
            }
        })*
    };
}

components! { Element Guard Reactions; Element Guard }

impl Element {
    pub fn kind(&self) -> ElementKind {
        keyword_as(&self.node, |word| match word {
            "computation" => ElementKind::Computation,
            "subplan" => ElementKind::SubPlan,
            _ => ElementKind::Actor,
        })
    }

    pub fn keyword_span(&self) -> Span {
        span_of(&self.node, Kind::Keyword, self.file).unwrap_or_else(|| self.span())
    }

    /// Its local supervisors.
    pub fn guards(&self) -> Vec<Guard> {
        guards(&self.node, self.file)
    }

    pub fn reactions(&self) -> Vec<Reactions> {
        children(&self.node, Kind::Reactions).map(|node| Reactions::new(node, self.file)).collect()
    }
}

impl Guard {
    /// `every` and `deadline`.
    pub fn timings(&self) -> Vec<Timing> {
        children(&self.node, Kind::Timing).map(|node| Timing::new(node, self.file)).collect()
    }
}

impl Edge {
    /// From its first part to the last one that exists.
    pub fn span(&self) -> Option<Span> {
        let first = self.names.first().map(|name| name.span).or(self.arrow)?;
        Some(first.to(self.end().unwrap_or(first)))
    }

    /// The place of the last part after its names.
    pub fn end(&self) -> Option<Span> {
        let last = self.reason.as_ref().or(self.target.as_ref());
        last.map(|last| last.span).or(self.suspends).or(self.arrow)
    }

    /// Whether its target is a keyword such as `terminate`.
    pub fn leads_to(&self, word: &str) -> bool {
        let target = self.target.as_ref().filter(|_| self.suspends.is_none());
        target.is_some_and(|target| target.text == word)
    }
}

fn frame(node: &Node, file: u16) -> Frame {
    Frame {
        doc: doc(node),
        note: note(node),
        span: node_span(node, file),
        args_span: child_span(node, Kind::Args, file),
        end_span: last_token(node, Kind::CloseBrace, file, |_, span| span),
    }
}

fn guards(node: &Node, file: u16) -> Vec<Guard> {
    children(node, Kind::Guard).map(|node| Guard::new(node, file)).collect()
}

/// The edges among the children of a node. Reads the green tree for speed, because edges are the
/// most frequent nodes.
fn edges(node: &Node, file: u16) -> Vec<Edge> {
    let green = node.green();
    let nodes = parts(&green, node.text_range().start().into()).filter_map(|(child, start)| {
        child.into_node().filter(|child| kind_of(child.kind()) == Kind::Edge).zip(Some(start))
    });
    nodes.map(|(edge, start)| self::edge(edge, start, file)).collect()
}

fn edge(node: &GreenNodeData, start: u32, file: u16) -> Edge {
    let names = Vec::with_capacity(1);
    let mut edge = Edge { names, arrow: None, suspends: None, target: None, reason: None };
    for (child, start) in parts(node, start) {
        match child {
            NodeOrToken::Token(token) => match kind_of(token.kind()) {
                Kind::Name => edge.names.push(name(token, start, file)),
                Kind::Arrow if edge.arrow.is_none() => {
                    let end = start + u32::from(token.text_len());
                    edge.arrow = Some(Span { file, start, end });
                }
                _ => {}
            },
            NodeOrToken::Node(node) if kind_of(node.kind()) == Kind::Target => {
                let tokens = parts(node, start).filter_map(|(t, at)| t.into_token().zip(Some(at)));
                for (token, start) in tokens {
                    let part = match kind_of(token.kind()) {
                        Kind::Name => &mut edge.target,
                        Kind::Text => &mut edge.reason,
                        Kind::Keyword => {
                            edge.suspends.get_or_insert(name(token, start, file).span);
                            continue;
                        }
                        _ => continue,
                    };
                    part.get_or_insert_with(|| name(token, start, file));
                }
            }
            NodeOrToken::Node(_) => {}
        }
    }
    edge
}
