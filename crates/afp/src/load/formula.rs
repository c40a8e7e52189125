//! Formulas of a loaded plan: compiled once, evaluated on the configuration.
//!
//! The checker has made every conversion a node of its own, so each function here knows the type
//! of its operands. Anything else would be a bug of the compiler and gives [`Fault::INTERNAL`],
//! not a panic. What conversions need to know about types is looked up when the plan is loaded:
//! evaluation allocates nothing.

mod convert;

use afp_core::rt::{BadValue, finite, int_add, int_mul, int_neg, int_rem, int_sub, join, rem};
use afp_core::{Fault, Text, Value};
use afp_dsl::graph::{self, FormulaKind, Function, Operator};
use afp_dsl::types::Type;

use super::config::Values;
pub use convert::{Converter, spellings};

/// A formula ready to be evaluated.
pub struct Formula {
    node: Node,
    shape: Shape,
}

/// Which kind of value a formula has.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Shape {
    Bool,
    Int,
    Float,
    Text,
    Choice,
    Object,
}

enum Node {
    Bool(bool),
    Int(i64),
    Float(f64),
    Text(Text),
    Choice(u16),
    Entry(u16),
    Neg(Box<Formula>),
    Binary(Operator, Box<Formula>, Box<Formula>),
    Call(Function, Box<[Formula]>),
    Convert(Converter, Box<Formula>),
}

impl Formula {
    /// Compiles a checked formula.
    pub fn new(formula: &graph::Formula) -> Self {
        let inner = |formula: &graph::Formula| Box::new(Formula::new(formula));
        let node = match &formula.kind {
            FormulaKind::Bool(value) => Node::Bool(*value),
            FormulaKind::Int(value) => Node::Int(*value),
            FormulaKind::Float(value) => Node::Float(*value),
            FormulaKind::Text(text) => {
                Node::Text(Text::try_from(text.as_str()).unwrap_or_default())
            }
            FormulaKind::Choice(value) => Node::Choice(*value),
            FormulaKind::Entry(entry) => Node::Entry(entry.0),
            FormulaKind::Neg(operand) => Node::Neg(inner(operand)),
            FormulaKind::Binary(operator, a, b) => Node::Binary(*operator, inner(a), inner(b)),
            FormulaKind::Call(function, operands) => {
                Node::Call(*function, operands.iter().map(Formula::new).collect())
            }
            FormulaKind::Convert(conversion, operand) => {
                Node::Convert(Converter::new(conversion), inner(operand))
            }
        };
        Formula { node, shape: shape(&formula.ty) }
    }

    /// The entry, when the formula is nothing but one.
    pub fn entry(&self) -> Option<u16> {
        match self.node {
            Node::Entry(entry) => Some(entry),
            _ => None,
        }
    }

    /// Whether it computes a text that stands nowhere.
    pub fn makes_text(&self) -> bool {
        self.shape == Shape::Text && matches!(self.node, Node::Binary(..) | Node::Convert(..))
    }

    /// The text, when it stands somewhere.
    pub fn borrow_text<'a>(&'a self, values: &'a Values) -> Option<&'a str> {
        match &self.node {
            Node::Text(text) => Some(text.as_str()),
            Node::Entry(entry) => match values.get(*entry) {
                Value::Text(text) => Some(text.as_str()),
                _ => None,
            },
            _ => None,
        }
    }

    /// The value of a `bool` formula.
    pub fn bool(&self, values: &Values) -> Result<bool, Fault> {
        match &self.node {
            Node::Bool(value) => Ok(*value),
            Node::Entry(entry) => match values.get(*entry) {
                Value::Bool(value) => Ok(*value),
                _ => Err(Fault::INTERNAL),
            },
            Node::Convert(..) => match self.converted(values)? {
                Value::Bool(value) => Ok(value),
                _ => Err(Fault::INTERNAL),
            },
            _ => Err(Fault::INTERNAL),
        }
    }

    /// The value of an `int` formula.
    pub fn int(&self, values: &Values) -> Result<i64, Fault> {
        match &self.node {
            Node::Int(value) => Ok(*value),
            Node::Entry(entry) => match values.get(*entry) {
                Value::Int(value) => Ok(*value),
                _ => Err(Fault::INTERNAL),
            },
            Node::Neg(operand) => int_neg(operand.int(values)?),
            Node::Binary(operator, a, b) => {
                let (a, b) = (a.int(values)?, b.int(values)?);
                match operator {
                    Operator::Add => int_add(a, b),
                    Operator::Sub => int_sub(a, b),
                    Operator::Mul => int_mul(a, b),
                    Operator::Rem => int_rem(a, b),
                    Operator::Div => Err(Fault::INTERNAL),
                }
            }
            Node::Call(function, operands) => {
                let operands = call_with(operands, |operand| operand.int(values))?;
                Ok(function.of_ints(operands)?)
            }
            Node::Convert(..) => match self.converted(values)? {
                Value::Int(value) => Ok(value),
                _ => Err(Fault::INTERNAL),
            },
            _ => Err(Fault::INTERNAL),
        }
    }

    /// The value of a `float` or quantity formula in SI units; perhaps not finite.
    #[inline]
    pub fn float(&self, values: &Values) -> Result<f64, Fault> {
        match &self.node {
            Node::Float(value) => Ok(*value),
            Node::Entry(entry) => match values.get(*entry) {
                Value::Float(value) => Ok(*value),
                _ => Err(Fault::INTERNAL),
            },
            _ => self.float_node(values),
        }
    }

    fn float_node(&self, values: &Values) -> Result<f64, Fault> {
        match &self.node {
            Node::Neg(operand) => Ok(-operand.float(values)?),
            Node::Binary(operator, a, b) => {
                let (a, b) = (a.float(values)?, b.float(values)?);
                match operator {
                    Operator::Add => Ok(a + b),
                    Operator::Sub => Ok(a - b),
                    Operator::Mul => Ok(a * b),
                    Operator::Div => Ok(a / b),
                    Operator::Rem => rem(a, b),
                }
            }
            Node::Call(function, operands) => {
                let operands = call_with(operands, |operand| operand.float(values))?;
                Ok(function.of_floats(operands)?)
            }
            Node::Convert(..) => match self.converted(values)? {
                Value::Float(value) => Ok(value),
                _ => Err(Fault::INTERNAL),
            },
            _ => Err(Fault::INTERNAL),
        }
    }

    /// The value of a `string` formula.
    pub fn text(&self, values: &Values) -> Result<Text, Fault> {
        match &self.node {
            Node::Text(text) => Ok(text.clone()),
            Node::Entry(entry) => match values.get(*entry) {
                Value::Text(text) => Ok(text.clone()),
                _ => Err(Fault::INTERNAL),
            },
            Node::Binary(Operator::Add, a, b) => {
                let (a, b) = (a.text(values)?, b.text(values)?);
                join(a.as_str(), b.as_str())
            }
            Node::Convert(..) => match self.converted(values)? {
                Value::Text(text) => Ok(text),
                _ => Err(Fault::INTERNAL),
            },
            _ => Err(Fault::INTERNAL),
        }
    }

    /// The value of an enum formula, by position.
    pub fn choice(&self, values: &Values) -> Result<u16, Fault> {
        match &self.node {
            Node::Choice(value) => Ok(*value),
            Node::Entry(entry) => match values.get(*entry) {
                Value::Choice(value) => Ok(*value),
                _ => Err(Fault::INTERNAL),
            },
            Node::Convert(..) => match self.converted(values)? {
                Value::Choice(value) => Ok(value),
                _ => Err(Fault::INTERNAL),
            },
            _ => Err(Fault::INTERNAL),
        }
    }

    /// The value of a formula of any type; of an object, the number of the commit that wrote it.
    pub fn value(&self, values: &Values) -> Result<Value, Fault> {
        match self.shape {
            Shape::Bool => self.bool(values).map(Value::Bool),
            Shape::Int => self.int(values).map(Value::Int),
            Shape::Float => self.float(values).map(Value::Float),
            Shape::Text => self.text(values).map(Value::Text),
            Shape::Choice => self.choice(values).map(Value::Choice),
            Shape::Object => match self.entry() {
                Some(entry) => Ok(values.get(entry).clone()),
                None => Err(Fault::INTERNAL),
            },
        }
    }

    /// The value that an entry may hold: as [`Formula::value`], and finite.
    pub fn finite(&self, values: &Values) -> Result<Value, BadValue> {
        finite(self.value(values)?)
    }

    fn converted(&self, values: &Values) -> Result<Value, Fault> {
        match &self.node {
            Node::Convert(converter, operand) => converter.convert(operand.value(values)?),
            _ => Err(Fault::INTERNAL),
        }
    }
}

/// The values of the operands of a function.
fn call_with<T: Copy + Default>(
    operands: &[Formula],
    value: impl Fn(&Formula) -> Result<T, Fault>,
) -> Result<[T; 3], Fault> {
    let mut values = [T::default(); 3];
    for (slot, operand) in values.iter_mut().zip(operands) {
        *slot = value(operand)?;
    }
    Ok(values)
}

fn shape(ty: &Type) -> Shape {
    match ty {
        Type::Bool => Shape::Bool,
        Type::Int => Shape::Int,
        Type::Quantity(_) | Type::Any | Type::Number | Type::Discrete => Shape::Float,
        Type::Text => Shape::Text,
        Type::Enum(_) => Shape::Choice,
        Type::Object(_) => Shape::Object,
    }
}
