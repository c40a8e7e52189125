//! Show a value in the log.

use core::marker::PhantomData;

use afp_core::rt::Any;
use afp_core::{Computation, Fault};

use crate::templates;
use crate::templates::log::{Inputs, State};

/// Does nothing: the trace shows the inputs of everything that starts, and so its value.
#[derive(Clone, Copy, Debug)]
pub struct Log<V>(PhantomData<V>);

impl<V: Any> Computation<templates::Log<V>> for Log<V> {
    fn compute(_: Inputs<V>) -> Result<State, Fault> {
        Ok(State::Done)
    }
}

#[cfg(test)]
mod tests {
    use super::{Computation, Inputs, Log, State};

    #[test]
    fn it_is_done_at_once() {
        assert_eq!(Log::compute(Inputs { value: true }), Ok(State::Done));
    }
}
