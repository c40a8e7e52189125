//! A switch, whose contacts bounce.

use afp_types::{Duration, Instant};
use embedded_hal::digital::InputPin;

use super::{Broken, pin};

/// After a change, the contacts may bounce for this time.
const BOUNCES: Duration = Duration::from_millis(20);

/// A switch between a pin with a pull-up resistor and ground: the pin is low while it is closed. A
/// broken wire reads as open.
#[derive(Debug)]
pub struct Switch<P> {
    pin: P,
    /// Whether it is closed, and the time of the last change.
    last: Option<(bool, Instant)>,
}

impl<P: InputPin> Switch<P> {
    /// A switch at a pin.
    pub fn new(pin: P) -> Self {
        Switch { pin, last: None }
    }

    /// Whether the switch is closed. A change counts at once, and the next one only after the
    /// contacts are at rest.
    ///
    /// # Errors
    /// The pin cannot be read.
    pub fn is_closed(&mut self, now: Instant) -> Result<bool, Broken> {
        let closed = self.pin.is_low().map_err(pin)?;
        let (before, changed) = *self.last.get_or_insert((closed, now));
        if closed != before && now.since(changed) >= BOUNCES {
            self.last = Some((closed, now));
            return Ok(closed);
        }
        Ok(before)
    }
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use embedded_hal_mock::eh1::digital::{Mock, State, Transaction};

    use super::*;

    #[test]
    fn a_press_counts_at_once_and_bounces_do_not() {
        let levels = [(0, false), (30, true), (31, false), (49, false), (50, false), (70, true)];
        let seen = [true, false, false, false, true, false];
        let state = |high: bool| if high { State::High } else { State::Low };
        let reads: Vec<_> = levels.iter().map(|(_, high)| Transaction::get(state(*high))).collect();
        let mut switch = Switch::new(Mock::new(&reads));
        for ((ms, _), closed) in levels.into_iter().zip(seen) {
            let now = Instant::ZERO + Duration::from_millis(ms);
            assert_eq!(switch.is_closed(now).unwrap(), closed, "{ms} ms");
        }
        switch.pin.done();
    }
}
