//! Watch a value.

use core::cmp::Ordering;
use core::marker::PhantomData;

use afp_core::rt::Number;
use afp_core::{Events, Fault, Instant, Supervisor};

use crate::templates;
use crate::templates::check_value::{Event, Inputs, Live};

const BELOW: u16 = 0;
const ABOVE: u16 = 1;

/// Compares a value with a limit at every poll.
#[derive(Clone, Copy, Debug)]
pub struct CheckValue<V> {
    value: PhantomData<V>,
}

impl<V: Number, E: ?Sized> Supervisor<templates::CheckValue<V>, E> for CheckValue<V> {
    fn start(_: Inputs, _: &mut E, _: Instant) -> Result<Self, Fault> {
        Ok(CheckValue { value: PhantomData })
    }

    fn poll(
        &mut self,
        live: Live<V>,
        wanted: Events,
        _: &mut E,
        _: Instant,
    ) -> Result<Option<Event>, Fault> {
        let (number, event) = match live.value.partial_cmp(&live.limit) {
            Some(Ordering::Less) => (BELOW, Event::Below),
            Some(Ordering::Greater) => (ABOVE, Event::Above),
            Some(Ordering::Equal) => return Ok(None),
            None => return Err(Fault::ARITHMETIC),
        };
        Ok(wanted.contains(number).then_some(event))
    }
}

#[cfg(test)]
mod tests {
    use super::{ABOVE, BELOW, CheckValue, Event, Events, Inputs, Instant, Live, Supervisor};

    fn poll(wanted: u64, value: i64, limit: i64) -> Option<Event> {
        let wanted = Events::from_bits(wanted);
        let mut watch: CheckValue<i64> =
            Supervisor::start(Inputs {}, &mut (), Instant::ZERO).unwrap();
        watch.poll(Live { value, limit }, wanted, &mut (), Instant::ZERO).unwrap()
    }

    #[test]
    fn either_side_of_the_limit_is_an_event() {
        assert_eq!(poll(0b11, 1, 2), Some(Event::Below));
        assert_eq!(poll(0b11, 2, 2), None);
        assert_eq!(poll(0b11, 3, 2), Some(Event::Above));
    }

    #[test]
    fn an_ignored_side_is_not_reported() {
        assert_eq!(poll(1 << BELOW, 3, 2), None);
        assert_eq!(poll(1 << ABOVE, 1, 2), None);
    }
}
