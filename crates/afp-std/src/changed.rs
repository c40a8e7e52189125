//! Report changes of a value.

use afp_core::rt::Any;
use afp_core::{Events, Fault, Instant, Supervisor};

use crate::templates;
use crate::templates::changed::{Event, Inputs, Live};

const CHANGED: u16 = 0;

/// Compares a value with that of the previous poll; the first poll only stores it.
#[derive(Clone, Copy, Debug)]
pub struct Changed<V> {
    before: Option<V>,
}

impl<V: Any, E: ?Sized> Supervisor<templates::Changed<V>, E> for Changed<V> {
    fn start(_: Inputs, _: &mut E, _: Instant) -> Result<Self, Fault> {
        Ok(Changed { before: None })
    }

    fn poll(
        &mut self,
        live: Live<V>,
        wanted: Events,
        _: &mut E,
        _: Instant,
    ) -> Result<Option<Event>, Fault> {
        let changed = self.before.as_ref().is_some_and(|before| *before != live.value);
        self.before = Some(live.value);
        Ok((changed && wanted.contains(CHANGED)).then_some(Event::Changed))
    }
}

#[cfg(test)]
mod tests {
    use super::{Changed, Event, Events, Inputs, Instant, Live, Supervisor};

    #[test]
    fn a_change_is_reported_once_and_the_first_value_is_not_a_change() {
        let mut watch: Changed<i64> = Supervisor::start(Inputs {}, &mut (), Instant::ZERO).unwrap();
        let mut sees = |value| {
            let said = watch.poll(Live { value }, Events::from_bits(1), &mut (), Instant::ZERO);
            said == Ok(Some(Event::Changed))
        };
        assert_eq!([1, 1, 2, 2, 1].map(&mut sees), [false, false, true, false, true]);
    }
}
