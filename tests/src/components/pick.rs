//! A computation whose input selects its state.

use afp_core::{Computation, Fault, Reason, Text};

use crate::templates::{self, pick};

const NO_SUCH_WAY: Fault = Fault::new(&Reason { code: "no-such-way", text: "choose 0, 1 or 2" });

/// Reaches the state with the given number.
#[derive(Debug)]
pub struct Pick;

impl Computation<templates::Pick> for Pick {
    fn compute(inputs: pick::Inputs<'_>) -> Result<pick::State, Fault> {
        let (result, text) = (inputs.value, Text::try_from(inputs.label)?);
        match inputs.choice {
            0 => Ok(pick::State::One { result, text, next: 1 }),
            1 => Ok(pick::State::Two { result, text }),
            2 => Ok(pick::State::Three { result, text }),
            _ => Err(NO_SUCH_WAY),
        }
    }
}
