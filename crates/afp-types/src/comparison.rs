//! Comparisons of values.

use core::cmp::Ordering;

use crate::{Error, Part, Shape, Source, Value, ValueOf, finite};

/// A comparison operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    /// `==`
    Equal,
    /// `!=`
    NotEqual,
    /// `<`
    Less,
    /// `<=`
    LessEqual,
    /// `>`
    Greater,
    /// `>=`
    GreaterEqual,
}

impl Comparison {
    const ALL: [Comparison; 6] = [
        Comparison::Equal,
        Comparison::NotEqual,
        Comparison::Less,
        Comparison::LessEqual,
        Comparison::Greater,
        Comparison::GreaterEqual,
    ];

    /// Parses an operator.
    pub fn parse(text: &str) -> Option<Comparison> {
        Comparison::ALL.into_iter().find(|one| one.sign() == text)
    }

    /// The operator in a formula.
    pub fn sign(self) -> &'static str {
        match self {
            Comparison::Equal => "==",
            Comparison::NotEqual => "!=",
            Comparison::Less => "<",
            Comparison::LessEqual => "<=",
            Comparison::Greater => ">",
            Comparison::GreaterEqual => ">=",
        }
    }

    /// Whether it needs an order.
    pub fn is_order(self) -> bool {
        !matches!(self, Comparison::Equal | Comparison::NotEqual)
    }

    /// Compares the values of two formulas.
    ///
    /// # Errors
    /// Those of the formulas; [`Error::NotFinite`] for a number that is not finite.
    pub fn of<C, N, S: Source<C>>(
        self,
        left: Part<'_, C, N>,
        right: Part<'_, C, N>,
        source: &S,
    ) -> Result<bool, Error> {
        // The usual case without copies of whole values.
        if (left.root.shape, right.root.shape) == (Shape::Int, Shape::Int) {
            return Ok(self.accepts(Some(left.int(source)?.cmp(&right.int(source)?))));
        }
        Ok(self.holds(&comparable(left, source)?, &comparable(right, source)?))
    }

    /// Compares two values. Only numbers have an order; an int and a float compare as floats.
    pub fn holds<T: PartialEq>(self, left: &ValueOf<T>, right: &ValueOf<T>) -> bool {
        let order = match (left, right) {
            (ValueOf::Int(left), ValueOf::Int(right)) => left.partial_cmp(right),
            (ValueOf::Float(left), ValueOf::Float(right)) => left.partial_cmp(right),
            (ValueOf::Int(left), ValueOf::Float(right)) => (*left as f64).partial_cmp(right),
            (ValueOf::Float(left), ValueOf::Int(right)) => left.partial_cmp(&(*right as f64)),
            _ if left == right => Some(Ordering::Equal),
            _ => None,
        };
        self.accepts(order)
    }

    /// Whether it holds for two values in this order, if they have one.
    fn accepts(self, order: Option<Ordering>) -> bool {
        match self {
            Comparison::Equal => order.is_some_and(|order| order.is_eq()),
            Comparison::NotEqual => !order.is_some_and(|order| order.is_eq()),
            Comparison::Less => order.is_some_and(|order| order.is_lt()),
            Comparison::LessEqual => order.is_some_and(|order| order.is_le()),
            Comparison::Greater => order.is_some_and(|order| order.is_gt()),
            Comparison::GreaterEqual => order.is_some_and(|order| order.is_ge()),
        }
    }
}

fn comparable<C, N, S: Source<C>>(part: Part<'_, C, N>, source: &S) -> Result<Value, Error> {
    let value = part.value(source)?;
    if let Value::Float(number) = value {
        finite(number)?;
    }
    Ok(value)
}
