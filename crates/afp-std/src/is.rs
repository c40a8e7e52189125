//! Go one of two ways: whether two values are equal.

use core::marker::PhantomData;

use afp_core::rt::Discrete;
use afp_core::{Computation, Fault};

use crate::templates;
use crate::templates::is::{Inputs, State};

/// Compares two values of one type; texts byte by byte.
#[derive(Clone, Copy, Debug)]
pub struct Is<V>(PhantomData<V>);

impl<V: Discrete> Computation<templates::Is<V>> for Is<V> {
    fn compute(inputs: Inputs<V>) -> Result<State, Fault> {
        Ok(if inputs.value == inputs.equals { State::Yes } else { State::No })
    }
}

#[cfg(test)]
mod tests {
    use super::{Computation, Inputs, Is, State};
    use afp_core::Text;

    #[test]
    fn equal_values_go_one_way_and_others_the_other_one() {
        assert_eq!(Is::compute(Inputs { value: 3, equals: 3 }), Ok(State::Yes));
        assert_eq!(Is::compute(Inputs { value: true, equals: false }), Ok(State::No));
        let text = |text| Text::try_from(text).unwrap();
        assert_eq!(Is::compute(Inputs { value: text("a"), equals: text("a") }), Ok(State::Yes));
        assert_eq!(Is::compute(Inputs { value: text("a"), equals: text("A") }), Ok(State::No));
    }
}
