//! The robot's supervisors. A sensor without a value is a fault, not "all is well".

use afp::core::Invalid;
use afp::{Duration, Events, Fault, Instant, Reading, Reason, Supervisor};

use crate::Senses;
use crate::templates::{self, check_bumper, check_button, check_cliff, check_dirt};

const SILENT: Fault =
    Fault::new(&Reason { code: "sensor-silent", text: "a sensor gives no current value" });
const RESTARTED: Fault =
    Fault::new(&Reason { code: "controller-restarted", text: "the controller has restarted" });
/// The largest age of a usable value.
const MAX_AGE: Duration = Duration::from_millis(100);

/// The value of a reading that is not older than 100 ms.
pub(crate) fn current<T: Copy>(reading: Reading<T>, now: Instant) -> Result<T, Fault> {
    match reading.value {
        Err(Invalid::Restarted) => Err(RESTARTED),
        _ => reading.fresh(now, MAX_AGE).ok_or(SILENT),
    }
}

/// Implements a stateless supervisor: its events in order of priority, and whether each holds now.
macro_rules! supervisor {
    ($name:ident, $module:ident, |$live:ident, $env:ident, $now:ident| $events:expr) => {
        #[doc = concat!("See `", stringify!($name), "` in `vacuum.afp`.")]
        #[derive(Clone, Debug)]
        pub struct $name;

        impl<E: Senses + ?Sized> Supervisor<templates::$name, E> for $name {
            fn start(_: $module::Inputs, _: &mut E, _: Instant) -> Result<Self, Fault> {
                Ok($name)
            }

            fn poll(
                &mut self,
                $live: $module::Live,
                wanted: Events,
                $env: &mut E,
                $now: Instant,
            ) -> Result<Option<$module::Event>, Fault> {
                // An unwanted event does not hide the others.
                let said = $events.into_iter().find(|(event, holds): &($module::Event, bool)| {
                    *holds && wanted.contains(*event as u16)
                });
                Ok(said.map(|(event, _)| event))
            }
        }
    };
}

supervisor!(CheckBumper, check_bumper, |_live, env, now| {
    let [left, right] = current(env.bumper(), now)?;
    [(check_bumper::Event::Left, left), (check_bumper::Event::Right, right)]
});
supervisor!(CheckCliff, check_cliff, |_live, env, now| {
    [(check_cliff::Event::Drop, current(env.drop(), now)?)]
});
supervisor!(CheckDirt, check_dirt, |live, env, now| {
    [(check_dirt::Event::Dirty, current(env.dirt(), now)? > live.limit)]
});
supervisor!(CheckButton, check_button, |_live, env, now| {
    [(check_button::Event::Pressed, current(env.button(), now)?)]
});
