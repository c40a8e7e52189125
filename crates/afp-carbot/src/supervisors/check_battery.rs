//! Watch the battery.

use crate::devices::Battery;
use crate::helpers::guard::{Guard, NO_BATTERY};
use crate::templates;
use crate::templates::check_battery::{Event, Inputs, Live};
use afp_core::{Events, Fault, Instant, Supervisor};

/// Reports while the charge is below a limit.
///
/// The gauge counts the charge, so a dip of the voltage under load does not cause a report.
#[derive(Clone, Debug)]
pub struct CheckBattery {
    guard: Guard,
}

impl<E: Battery + ?Sized> Supervisor<templates::CheckBattery, E> for CheckBattery {
    fn start(_: Inputs, _: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(CheckBattery { guard: Guard::new(NO_BATTERY, now) })
    }

    fn poll(
        &mut self,
        live: Live,
        wanted: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<Event>, Fault> {
        let charge = self.guard.current(env.charge(), now)?;
        let low = charge.is_some_and(|charge| charge.left < live.charge);
        Ok((low && wanted.contains(0)).then_some(Event::BatteryLow))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;

    fn watch(robot: &mut Fake, wanted: u64) -> Result<Option<Event>, Fault> {
        let live = || Live { charge: 0.2 };
        robot.watch::<templates::CheckBattery, CheckBattery>(Inputs {}, live, wanted, 1000)
    }

    #[test]
    fn only_a_low_battery_is_reported() {
        let mut robot = Fake::new(&[]);
        assert_eq!(watch(&mut robot, 1), Ok(None));
        robot.charge = 0.19;
        assert_eq!(watch(&mut robot, 1), Ok(Some(Event::BatteryLow)));
        assert_eq!(watch(&mut robot, 0), Ok(None));
    }

    #[test]
    fn a_dead_gauge_is_a_fault() {
        let mut robot = Fake::new(&[]);
        robot.dead_battery = true;
        assert_eq!(watch(&mut robot, 1), Err(NO_BATTERY));
    }
}
