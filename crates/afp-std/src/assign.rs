//! Write a value to an entry.

use core::marker::PhantomData;

use afp_core::rt::Any;
use afp_core::{Computation, Fault};

use crate::templates;
use crate::templates::assign::{Inputs, State};

/// Gives its input out again.
#[derive(Clone, Copy, Debug)]
pub struct Assign<V>(PhantomData<V>);

impl<V: Any> Computation<templates::Assign<V>> for Assign<V> {
    fn compute(inputs: Inputs<V>) -> Result<State<V>, Fault> {
        Ok(State::Done { result: inputs.value })
    }
}

#[cfg(test)]
mod tests {
    use super::{Assign, Computation, Inputs, State};

    #[test]
    fn the_value_comes_out_as_it_went_in() {
        let done = Assign::compute(Inputs { value: 2.5 });
        assert_eq!(done, Ok(State::Done { result: 2.5 }));
    }
}
