//! Declared computations: the first state whose condition holds is reached.

use afp_types::{Comparison, Error};

use crate::graph::constant::{Known, evaluate};
use crate::graph::{Formula, Op, Operator, Part};
use crate::types::{Constant, Conversion};

/// A state of a declared computation. Entries in its formulas are input ports, by position.
#[derive(Clone, Debug)]
pub struct Case {
    /// The comparisons that must hold; the last state has none.
    pub when: Vec<Condition>,
    /// The assigned outputs by position, in order, each with its value.
    pub writes: Vec<(u16, Formula)>,
}

/// A comparison of two formulas of one type.
#[derive(Clone, Debug)]
pub struct Condition {
    pub left: Formula,
    pub comparison: Comparison,
    pub right: Formula,
}

pub type KnownInputs<'a> = &'a dyn Fn(u16) -> Option<Constant>;

/// The value of a formula over input ports, if it is known and does not fail.
pub fn value(formula: &Formula, inputs: KnownInputs<'_>) -> Option<Constant> {
    evaluate(formula, inputs).ok()?
}

impl Case {
    /// Its formulas, conditions first.
    pub fn formulas(&self) -> impl Iterator<Item = &Formula> {
        let compared = self.when.iter().flat_map(|one| [&one.left, &one.right]);
        compared.chain(self.writes.iter().map(|(_, formula)| formula))
    }

    /// The value that the state assigns to an output, if it is known.
    pub(crate) fn written(&self, output: u16, inputs: KnownInputs<'_>) -> Option<Constant> {
        let (_, formula) = self.writes.iter().find(|(port, _)| *port == output)?;
        value(formula, inputs)
    }

    /// Whether its formulas cannot fail unless an input fails: they read ports and constants, or
    /// count up to a limit.
    pub fn never_fails(&self) -> bool {
        self.formulas().all(|formula| {
            let part = formula.part();
            is_plain(part) || self.when.first().and_then(|one| one.counted(part)).is_some()
        })
    }

    fn holds(&self, inputs: KnownInputs<'_>) -> Result<bool, Error> {
        for condition in &self.when {
            if !condition.holds(inputs)? {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

impl Condition {
    /// Whether it holds.
    ///
    /// # Errors
    /// Those of the formulas; [`Error::Unknown`] if an input is not known.
    pub fn holds(&self, inputs: KnownInputs<'_>) -> Result<bool, Error> {
        self.comparison.of(self.left.part(), self.right.part(), &Known(inputs))
    }

    /// The port to which a formula adds one, and the port that limits it.
    fn counted(&self, next: Part<'_>) -> Option<(u16, u16)> {
        let (Op::Entry(value), Op::Entry(limit)) = (self.left.op(), self.right.op()) else {
            return None;
        };
        let (counted, one) = next.both()?;
        let adds_one = matches!(
            (counted.op(), next.op(), one.op()),
            (Op::Entry(counted), Op::Binary(Operator::Add), Op::Int(1)) if counted == value
        );
        (adds_one && self.comparison == Comparison::Less).then_some((value.0, limit.0))
    }
}

/// The ports of a computation that is the head of a counting loop.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Counting {
    pub value: u16,
    pub limit: u16,
    /// The output with the value plus one, while the value is below the limit.
    pub next: u16,
}

/// The ports of a computation whose first state counts: it adds one to a port that is less than
/// another port.
pub(crate) fn counting(cases: &[Case]) -> Option<Counting> {
    let [Case { when, writes }, _, ..] = cases else { return None };
    let [condition] = when.as_slice() else { return None };
    writes.iter().find_map(|(next, formula)| {
        let (value, limit) = condition.counted(formula.part())?;
        Some(Counting { value, limit, next: *next })
    })
}

/// Whether a formula reads a port or a constant, possibly converted to a number without loss.
fn is_plain(part: Part<'_>) -> bool {
    use Conversion::{BoolToFloat, BoolToInt, IntToFloat};
    match part.op() {
        Op::Convert(IntToFloat | BoolToInt | BoolToFloat) => part.operand().is_some_and(is_plain),
        op => op.is_literal() || matches!(op, Op::Entry(_)),
    }
}

/// The state that a declared computation reaches, if it is known.
pub(crate) fn reached(cases: &[Case], inputs: KnownInputs<'_>) -> Option<u16> {
    for (state, case) in (0..).zip(cases) {
        if case.holds(inputs).ok()? {
            return Some(state);
        }
    }
    None
}
