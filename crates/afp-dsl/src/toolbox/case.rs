//! What a declared computation does: the first state is reached whose condition holds.

use afp_types::{Comparison, Error};

use crate::graph::Formula;
use crate::graph::constant::{Known, evaluate};
use crate::types::Constant;

/// One state of a declared computation. Entries of its formulas are input ports, by position.
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

/// The values of input ports that are known.
pub(crate) type KnownInputs<'a> = &'a dyn Fn(u16) -> Option<Constant>;

impl Case {
    /// Its formulas, conditions first.
    pub fn formulas(&self) -> impl Iterator<Item = &Formula> {
        let compared = self.when.iter().flat_map(|one| [&one.left, &one.right]);
        compared.chain(self.writes.iter().map(|(_, formula)| formula))
    }

    /// The value that the state assigns to an output, if it is known.
    pub(crate) fn written(&self, output: u16, inputs: KnownInputs<'_>) -> Option<Constant> {
        let (_, formula) = self.writes.iter().find(|(port, _)| *port == output)?;
        evaluate(formula, inputs).ok()?
    }

    fn holds(&self, inputs: KnownInputs<'_>) -> Result<bool, Error> {
        for Condition { left, comparison, right } in &self.when {
            if !comparison.of(left.part(), right.part(), &Known(inputs))? {
                return Ok(false);
            }
        }
        Ok(true)
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
