//! Formulas as flat arrays of nodes, and their evaluation.
//!
//! Operands come before the node that uses them, so each part of a formula is a slice whose last
//! node is the root. The compiler folds constants with this evaluation, the interpreter runs it,
//! and code generation walks the same nodes. Nothing allocates.

use core::ops::Deref;

use crate::{
    EntryId, Error, Function, Text, Value, finite, int_add, int_mul, int_neg, int_rem, int_sub, rem,
};

/// An operation on two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// `+`
    Add,
    /// `-`
    Sub,
    /// `*`
    Mul,
    /// `/`, always on floats
    Div,
    /// `%`, with the sign of the dividend
    Rem,
}

/// The operation of a node. Operands have the required types: conversions are separate nodes. `C`
/// describes a conversion.
#[derive(Clone, Debug)]
pub enum Op<C> {
    /// `true` or `false`.
    Bool(bool),
    /// An integer.
    Int(i64),
    /// A number or a quantity in SI units.
    Float(f64),
    /// A string.
    Text(Text),
    /// A value of an enum, by position.
    Choice(u16),
    /// The value of an entry of the same plan.
    Entry(EntryId),
    /// A sign change of one operand.
    Neg,
    /// An operation on two operands; on strings, `+` joins.
    Binary(Operator),
    /// A function of at most three operands; functions that take any number have two.
    Call(Function),
    /// A conversion of one operand.
    Convert(C),
}

/// The kind of a node's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A truth value.
    Bool,
    /// An integer.
    Int,
    /// A number or a quantity.
    Float,
    /// A string.
    Text,
    /// A value of an enum.
    Choice,
    /// An object, or a value whose type depends on the use of a computation.
    Object,
}

/// One node of a formula, with a note of the compiler phase.
#[derive(Clone, Debug)]
pub struct Node<C, N = ()> {
    /// The operation.
    pub op: Op<C>,
    /// The kind of its value.
    pub shape: Shape,
    /// Number of nodes of the part that ends here.
    pub len: u16,
    /// The note of the compiler phase.
    pub note: N,
}

/// A formula or a part of it: the root, and the nodes of its operands before it.
///
/// It dereferences to the note of its root.
#[derive(Debug)]
pub struct Part<'a, C, N = ()> {
    /// The last node.
    pub root: &'a Node<C, N>,
    /// The nodes of its operands.
    pub below: &'a [Node<C, N>],
}

/// The entries and conversions for an evaluation.
pub trait Source<C> {
    /// Whether constants are folded, as in the compiler. Then each operation without a finite
    /// result is an error, as well as a division by a constant zero, even of an unknown number.
    ///
    /// Otherwise a number that is not finite is passed on and detected later. It is an error
    /// earlier if the next operation could have a finite result.
    const FOLDS: bool = false;

    /// Reads the value of an entry.
    ///
    /// # Errors
    /// [`Error::Unknown`] for an entry without a value, [`Error::Mistyped`] if `read` returns
    /// `None`.
    fn entry<V>(&self, entry: EntryId, read: impl FnOnce(&Value) -> Option<V>) -> Result<V, Error>;

    /// Converts a value.
    ///
    /// # Errors
    /// Those of the conversion.
    fn convert(&self, conversion: &C, value: Value) -> Result<Value, Error>;
}

impl<C, N> Clone for Part<'_, C, N> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<C, N> Copy for Part<'_, C, N> {}

impl<C, N> Deref for Part<'_, C, N> {
    type Target = N;

    fn deref(&self) -> &N {
        &self.root.note
    }
}

impl Operator {
    /// The character in formulas.
    pub fn sign(self) -> char {
        match self {
            Operator::Add => '+',
            Operator::Sub => '-',
            Operator::Mul => '*',
            Operator::Div => '/',
            Operator::Rem => '%',
        }
    }
}

impl<C> Op<C> {
    /// Converts the conversions.
    pub fn map<D>(&self, convert: impl FnOnce(&C) -> D) -> Op<D> {
        match self {
            Op::Bool(value) => Op::Bool(*value),
            Op::Int(value) => Op::Int(*value),
            Op::Float(value) => Op::Float(*value),
            Op::Text(text) => Op::Text(text.clone()),
            Op::Choice(value) => Op::Choice(*value),
            Op::Entry(entry) => Op::Entry(*entry),
            Op::Neg => Op::Neg,
            Op::Binary(operator) => Op::Binary(*operator),
            Op::Call(function) => Op::Call(*function),
            Op::Convert(conversion) => Op::Convert(convert(conversion)),
        }
    }
}

impl<C> Op<C> {
    /// Whether it is a literal.
    pub fn is_literal(&self) -> bool {
        matches!(self, Op::Bool(_) | Op::Int(_) | Op::Float(_) | Op::Text(_) | Op::Choice(_))
    }
}

impl<'a, C, N> Part<'a, C, N> {
    /// The part that ends with the last node.
    pub fn last(nodes: &'a [Node<C, N>]) -> Option<Self> {
        let (root, before) = nodes.split_last()?;
        let first = nodes.len().saturating_sub(usize::from(root.len));
        Some(Part { root, below: before.get(first..)? })
    }

    /// The operation.
    pub fn op(self) -> &'a Op<C> {
        &self.root.op
    }

    /// The operands, last to first.
    fn backward(self) -> impl Iterator<Item = Self> {
        let mut nodes = self.below;
        core::iter::from_fn(move || {
            let last = Part::last(nodes)?;
            nodes = nodes.get(..nodes.len() - last.below.len() - 1)?;
            Some(last)
        })
    }

    /// The operands in order, at most three.
    pub fn operands(self) -> impl DoubleEndedIterator<Item = Self> {
        let mut found = [None; 3];
        for (slot, part) in found.iter_mut().rev().zip(self.backward()) {
            *slot = Some(part);
        }
        found.into_iter().flatten()
    }

    /// The operand of a sign change or a conversion.
    pub fn operand(self) -> Option<Self> {
        Part::last(self.below)
    }

    /// Both operands of an operation.
    pub fn both(self) -> Option<(Self, Self)> {
        let mut operands = self.backward();
        let right = operands.next()?;
        Some((operands.next()?, right))
    }
}

macro_rules! typed {
    ($($(#[$doc:meta])* $name:ident $kind:ident $to:ty, $other:ident, $computed:ident;)*) => {$(
        $(#[$doc])*
        ///
        /// # Errors
        /// Those of the formula.
        #[inline]
        pub fn $name<S: Source<C>>(self, source: &S) -> Result<$to, Error> {
            match &self.root.op {
                Op::$kind(value) => Ok(*value),
                Op::Entry(entry) => source.entry(*entry, |value| match value {
                    Value::$kind(value) => Some(*value),
                    _ => None,
                }),
                _ => self.$other(source),
            }
        }

        /// The value of a formula that is neither a literal nor an entry. It is separate, so that
        /// the usual formulas are evaluated in place.
        #[inline(never)]
        fn $other<S: Source<C>>(self, source: &S) -> Result<$to, Error> {
            match &self.root.op {
                Op::Convert(conversion) => match self.converted(conversion, source)? {
                    Value::$kind(value) => Ok(value),
                    _ => Err(Error::Mistyped),
                },
                _ => self.$computed(source),
            }
        }
    )*};
}

impl<C, N> Part<'_, C, N> {
    typed! {
        /// The value of a `bool` formula.
        bool Bool bool, other_bool, not_computed;
        /// The value of an `int` formula.
        int Int i64, other_int, int_computed;
        /// The value of a `float` or quantity formula in SI units; may be infinite or NaN.
        float Float f64, other_float, float_computed;
        /// The value of an enum formula, by position.
        choice Choice u16, other_choice, not_computed;
    }

    /// The value of a `string` formula.
    ///
    /// # Errors
    /// Those of the formula.
    pub fn text<S: Source<C>>(self, source: &S) -> Result<Text, Error> {
        match &self.root.op {
            Op::Text(text) => Ok(text.clone()),
            Op::Entry(entry) => source.entry(*entry, |value| match value {
                Value::Text(text) => Some(text.clone()),
                _ => None,
            }),
            Op::Convert(conversion) => match self.converted(conversion, source)? {
                Value::Text(text) => Ok(text),
                _ => Err(Error::Mistyped),
            },
            Op::Binary(Operator::Add) => {
                let (mut text, more) =
                    self.pair::<S, _>(Operator::Add, |part| part.text(source))?;
                text.push(more.as_str())?;
                Ok(text)
            }
            _ => Err(Error::Mistyped),
        }
    }

    /// The value of a formula of any type; for an object, the number of the commit that wrote it.
    ///
    /// # Errors
    /// Those of the formula.
    pub fn value<S: Source<C>>(self, source: &S) -> Result<Value, Error> {
        match (self.root.shape, &self.root.op) {
            (Shape::Bool, _) => self.bool(source).map(Value::Bool),
            (Shape::Int, _) => self.int(source).map(Value::Int),
            (Shape::Float, _) => self.float(source).map(Value::Float),
            (Shape::Text, _) => self.text(source).map(Value::Text),
            (Shape::Choice, _) => self.choice(source).map(Value::Choice),
            (Shape::Object, Op::Entry(entry)) => source.entry(*entry, |value| Some(value.clone())),
            (Shape::Object, _) => Err(Error::Mistyped),
        }
    }

    fn converted<S: Source<C>>(self, conversion: &C, source: &S) -> Result<Value, Error> {
        source.convert(conversion, self.operand().ok_or(Error::Mistyped)?.value(source)?)
    }

    fn not_computed<S: Source<C>, V>(self, _: &S) -> Result<V, Error> {
        Err(Error::Mistyped)
    }

    fn int_computed<S: Source<C>>(self, source: &S) -> Result<i64, Error> {
        match &self.root.op {
            Op::Neg => int_neg(self.operand().ok_or(Error::Mistyped)?.int(source)?),
            Op::Binary(operator) => {
                let (a, b) = self.pair::<S, _>(*operator, |part| part.int(source))?;
                match operator {
                    Operator::Add => int_add(a, b),
                    Operator::Sub => int_sub(a, b),
                    Operator::Mul => int_mul(a, b),
                    Operator::Rem => int_rem(a, b),
                    // The checker converts both sides of `/` to floats.
                    Operator::Div => Err(Error::Mistyped),
                }
            }
            Op::Call(function) => {
                let call = |operands| function.of_ints(operands);
                self.called(*function, |part| part.int(source), call)
            }
            _ => Err(Error::Mistyped),
        }
    }

    fn float_computed<S: Source<C>>(self, source: &S) -> Result<f64, Error> {
        let value = match &self.root.op {
            Op::Neg => -self.operand().ok_or(Error::Mistyped)?.float(source)?,
            Op::Binary(operator) => {
                let (a, b) = self.pair::<S, _>(*operator, |part| part.float(source))?;
                match operator {
                    Operator::Add => a + b,
                    Operator::Sub => a - b,
                    Operator::Mul => a * b,
                    Operator::Div => a / finite(b)?,
                    Operator::Rem => rem(a, b)?,
                }
            }
            Op::Call(function) => {
                let call = |operands| function.of_floats(operands);
                self.called(*function, |part| part.float(source), call)?
            }
            _ => return Err(Error::Mistyped),
        };
        if S::FOLDS { finite(value) } else { Ok(value) }
    }

    /// The values of both operands, or the first error. Any other error takes precedence over
    /// [`Error::Unknown`], because the plan can never run.
    fn pair<S: Source<C>, V: Default + PartialEq>(
        self,
        operator: Operator,
        value: impl Fn(Self) -> Result<V, Error>,
    ) -> Result<(V, V), Error> {
        let (left, right) = self.both().ok_or(Error::Mistyped)?;
        let divides = matches!(operator, Operator::Div | Operator::Rem);
        match (value(left), value(right)) {
            (Ok(_) | Err(Error::Unknown), Ok(zero))
                if S::FOLDS && divides && zero == V::default() =>
            {
                Err(Error::DivisionByZero)
            }
            (Ok(left), Ok(right)) => Ok((left, right)),
            (Err(Error::Unknown), Err(error)) | (Err(error), _) | (_, Err(error)) => Err(error),
        }
    }

    /// The value of a function. Bounds in the wrong order are an error for every value.
    fn called<V: Copy + Default>(
        self,
        function: Function,
        value: impl Fn(Self) -> Result<V, Error>,
        call: impl Fn([V; 3]) -> Result<V, Error>,
    ) -> Result<V, Error> {
        let (mut values, mut unknown) = ([V::default(); 3], [false; 3]);
        for ((slot, unknown), operand) in values.iter_mut().zip(&mut unknown).zip(self.operands()) {
            match value(operand) {
                Ok(value) => *slot = value,
                Err(Error::Unknown) => *unknown = true,
                Err(error) => return Err(error),
            }
        }
        match (function, unknown) {
            (_, [false, false, false]) => call(values),
            (Function::Clamp, [true, false, false]) => {
                let [_, low, high] = values;
                call([low, low, high]).and(Err(Error::Unknown))
            }
            _ => Err(Error::Unknown),
        }
    }
}

#[cfg(test)]
mod tests;
