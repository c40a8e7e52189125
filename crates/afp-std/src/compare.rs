//! Go one of three ways.

use core::cmp::Ordering;
use core::marker::PhantomData;

use afp_core::rt::Number;
use afp_core::{Computation, Fault};

use crate::templates;
use crate::templates::compare::{Inputs, State};

/// Compares two numbers of one type.
#[derive(Clone, Copy, Debug)]
pub struct Compare<V>(PhantomData<V>);

impl<V: Number> Computation<templates::Compare<V>> for Compare<V> {
    /// # Errors
    /// [`Fault::ARITHMETIC`] when the numbers have no order, as with one that is not finite.
    fn compute(inputs: Inputs<V>) -> Result<State, Fault> {
        match inputs.left.partial_cmp(&inputs.right) {
            Some(Ordering::Less) => Ok(State::Less),
            Some(Ordering::Equal) => Ok(State::Equal),
            Some(Ordering::Greater) => Ok(State::Greater),
            None => Err(Fault::ARITHMETIC),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Compare, Computation, Fault, Inputs, State};
    use afp_core::quantity::Length;

    #[test]
    fn numbers_and_quantities_go_their_way() {
        let ints = |left: i64, right| Compare::compute(Inputs { left, right });
        assert_eq!(ints(1, 2), Ok(State::Less));
        assert_eq!(ints(2, 2), Ok(State::Equal));
        assert_eq!(ints(3, 2), Ok(State::Greater));
        let lengths = Inputs { left: Length::from_si(0.3), right: Length::from_si(0.2) };
        assert_eq!(Compare::compute(lengths), Ok(State::Greater));
    }

    #[test]
    fn what_has_no_order_is_a_fault() {
        assert_eq!(Compare::compute(Inputs { left: f64::NAN, right: 1.0 }), Err(Fault::ARITHMETIC));
    }
}
