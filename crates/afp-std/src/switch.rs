//! Branch by an enum value.

use core::marker::PhantomData;

use afp_core::rt::Discrete;
use afp_core::{Computation, Fault, ValueRef};

use crate::templates;
use crate::templates::switch::{Inputs, State};

/// Ends in the state of the value.
#[derive(Clone, Copy, Debug)]
pub struct Switch<V>(PhantomData<V>);

impl<V: Discrete> Computation<templates::Switch<V>> for Switch<V> {
    /// # Errors
    /// [`Fault::INTERNAL`] for a value that is not an enum, which the checker excludes.
    fn compute(inputs: Inputs<V>) -> Result<State, Fault> {
        match inputs.value.as_value() {
            ValueRef::Choice(place) => Ok(State(place)),
            _ => Err(Fault::INTERNAL),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Computation, Fault, Inputs, State, Switch};
    use afp_core::Value;

    #[test]
    fn the_state_is_the_position_of_the_value() {
        assert_eq!(Switch::compute(Inputs { value: Value::Choice(2) }), Ok(State(2)));
        assert_eq!(Switch::compute(Inputs { value: 2 }), Err(Fault::INTERNAL));
    }
}
