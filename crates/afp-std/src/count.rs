//! Count up to a limit.

use afp_core::{Computation, Fault};

use crate::templates;
use crate::templates::count::{Inputs, State};

/// The head of a counting loop.
#[derive(Clone, Copy, Debug)]
pub struct Count;

impl Computation<templates::Count> for Count {
    fn compute(inputs: Inputs) -> Result<State, Fault> {
        if inputs.value < inputs.limit {
            let next = inputs.value.checked_add(1).ok_or(Fault::ARITHMETIC)?;
            Ok(State::Again { next })
        } else {
            Ok(State::Done { next: 0 })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Computation, Count, Inputs, State};

    #[test]
    fn a_loop_goes_round_as_often_as_its_limit_says_and_starts_again_at_zero() {
        let mut value = 0;
        let mut rounds = 0;
        while let Ok(State::Again { next }) = Count::compute(Inputs { value, limit: 4 }) {
            value = next;
            rounds += 1;
        }
        assert_eq!(rounds, 4);
        assert_eq!(Count::compute(Inputs { value, limit: 4 }), Ok(State::Done { next: 0 }));
    }

    #[test]
    fn a_limit_below_the_count_is_reached() {
        assert_eq!(Count::compute(Inputs { value: 9, limit: -1 }), Ok(State::Done { next: 0 }));
    }
}
