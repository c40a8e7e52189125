//! Formulas of a loaded plan: prepared once, evaluated on the configuration.
//!
//! The nodes are those of the graph, with conversions whose type information is already looked up.
//! The checker has made every conversion a separate node, so each operand has the required type.
//! Anything else is a compiler bug and gives [`Error::Mistyped`] instead of a panic. Evaluation
//! allocates nothing.

use afp_core::Value;
use afp_core::rt::{BadValue, finite};
use afp_dsl::graph;
use afp_dsl::types::converter::Converter;
use afp_types::{EntryId, Error, Op, Operator, Shape, Source};

use super::config::Values;

type Node = afp_types::Node<Converter>;
type Part<'a> = afp_types::Part<'a, Converter>;

/// A prepared formula.
pub struct Formula {
    root: Node,
    below: Box<[Node]>,
}

impl Formula {
    /// Prepares a checked formula.
    pub fn new(formula: &graph::Formula) -> Self {
        let ready = |node: &graph::Node| Node {
            op: node.op.map(Converter::new),
            shape: node.shape,
            len: node.len,
            note: (),
        };
        let graph::Part { root, below } = formula.part();
        Formula { root: ready(root), below: below.iter().map(ready).collect() }
    }

    /// The whole formula as a part.
    #[inline]
    pub fn part(&self) -> Part<'_> {
        Part { root: &self.root, below: &self.below }
    }

    /// The entry, if the formula is only an entry.
    pub fn entry(&self) -> Option<u16> {
        match self.root.op {
            Op::Entry(entry) => Some(entry.0),
            _ => None,
        }
    }

    /// Whether it computes a string that is not stored in an entry or literal.
    pub fn makes_text(&self) -> bool {
        self.root.shape == Shape::Text
            && matches!(self.root.op, Op::Binary(Operator::Add) | Op::Convert(_))
    }

    /// The string, if it is stored in an entry or literal.
    pub fn borrow_text<'a>(&'a self, values: &'a Values) -> Option<&'a str> {
        match &self.root.op {
            Op::Text(text) => Some(text),
            Op::Entry(entry) => match values.get(entry.0) {
                Value::Text(text) => Some(text.as_str()),
                _ => None,
            },
            _ => None,
        }
    }

    /// The value, if it is finite.
    pub fn finite(&self, values: &Values) -> Result<Value, BadValue> {
        finite(self.part().value(values)?)
    }
}

impl Source<Converter> for Values {
    #[inline]
    fn entry<V>(&self, entry: EntryId, read: impl FnOnce(&Value) -> Option<V>) -> Result<V, Error> {
        read(self.get(entry.0)).ok_or(Error::Mistyped)
    }

    fn convert(&self, converter: &Converter, value: Value) -> Result<Value, Error> {
        converter.convert(value)
    }
}
