//! Typed formulas: nodes of `afp-types` with types and places.

use std::ops::Deref;

use afp_types::{EntryId, Op, Shape};

use crate::types::{Conversion, Type};
use afp_syntax::source::Span;

pub type Node = afp_types::Node<Conversion, Note>;
/// A formula or a part of it, with the fields of [`Note`].
pub type Part<'a> = afp_types::Part<'a, Conversion, Note>;

/// A typed formula, with the fields of [`Note`].
#[derive(Clone, Debug)]
pub struct Formula {
    root: Node,
    /// The nodes of the operands, in the order of [`afp_types::Part`].
    below: Vec<Node>,
}

/// Type and place of a part of a formula.
#[derive(Clone, Debug)]
pub struct Note {
    pub ty: Type,
    /// Its place; for a default, the port's declaration.
    pub span: Span,
}

impl Formula {
    /// A formula of operands. The checker limits the number of nodes.
    pub(crate) fn new(
        op: Op<Conversion>,
        operands: impl IntoIterator<Item = Formula>,
        ty: Type,
        span: Span,
    ) -> Formula {
        let mut below = Vec::new();
        for operand in operands {
            if below.is_empty() {
                below = operand.below;
            } else {
                below.extend(operand.below);
            }
            below.push(operand.root);
        }
        let len = u16::try_from(below.len() + 1).unwrap_or(u16::MAX);
        Formula { root: Node { op, shape: shape(&ty), len, note: Note { ty, span } }, below }
    }

    pub(crate) fn at(mut self, span: Span) -> Formula {
        self.root.note.span = span;
        self
    }

    pub fn part(&self) -> Part<'_> {
        Part { root: &self.root, below: &self.below }
    }

    pub fn op(&self) -> &Op<Conversion> {
        &self.root.op
    }

    /// All parts, operands before their users.
    pub(crate) fn parts(&self) -> impl Iterator<Item = Part<'_>> {
        let below = (1..=self.below.len()).filter_map(|end| Part::last(self.below.get(..end)?));
        below.chain([self.part()])
    }

    /// All nodes, operands before their users.
    pub fn nodes(&self) -> impl Iterator<Item = &Node> {
        self.below.iter().chain([&self.root])
    }

    /// The entries that it reads, with places.
    pub fn entries(&self) -> impl Iterator<Item = (EntryId, Span)> {
        self.nodes().filter_map(|node| match node.op {
            Op::Entry(id) => Some((id, node.note.span)),
            _ => None,
        })
    }
}

impl Deref for Formula {
    type Target = Note;

    fn deref(&self) -> &Note {
        &self.root.note
    }
}

fn shape(ty: &Type) -> Shape {
    match ty {
        Type::Bool => Shape::Bool,
        Type::Int => Shape::Int,
        Type::Quantity(_) => Shape::Float,
        Type::Text => Shape::Text,
        Type::Enum(_) => Shape::Choice,
        Type::Object(_) | Type::Any | Type::Number | Type::Discrete => Shape::Object,
    }
}
