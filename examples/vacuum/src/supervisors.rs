//! What the robot watches. A sensor that does not answer is a fault, not "all is well".

use afp::{Duration, Events, Fault, Instant, Reading, Reason, Supervisor};

use crate::Senses;
use crate::templates::{self, check_bumper, check_button, check_cliff, check_dirt};

const SILENT: Fault =
    Fault::new(&Reason { code: "sensor-silent", text: "a sensor gives no current value" });
/// A value that is older says nothing of now.
const MAX_AGE: Duration = Duration::from_millis(100);

fn current<T: Copy>(reading: Reading<T>, now: Instant) -> Result<T, Fault> {
    reading.fresh(now, MAX_AGE).ok_or(SILENT)
}

/// Implements a supervisor that keeps nothing: the event of what is sensed and of the live inputs.
macro_rules! supervisor {
    ($name:ident, $module:ident, |$live:ident, $env:ident, $now:ident| $event:expr) => {
        #[doc = concat!("See `", stringify!($name), "` in `vacuum.afp`.")]
        #[derive(Clone, Debug)]
        pub struct $name;

        impl<E: Senses + ?Sized> Supervisor<templates::$name, E> for $name {
            fn start(
                _: $module::Inputs,
                _: &mut E,
                _: Instant,
            ) -> Result<Self, Fault> {
                Ok($name)
            }

            fn poll(
                &mut self,
                $live: $module::Live,
                wanted: Events,
                $env: &mut E,
                $now: Instant,
            ) -> Result<Option<$module::Event>, Fault> {
                let event: Option<$module::Event> = $event;
                Ok(event.filter(|event| wanted.contains(*event as u16)))
            }
        }
    };
}

supervisor!(CheckBumper, check_bumper, |_live, env, now| match current(env.bumper(), now)? {
    [true, _] => Some(check_bumper::Event::Left),
    [_, true] => Some(check_bumper::Event::Right),
    _ => None,
});
supervisor!(CheckCliff, check_cliff, |_live, env, now| {
    current(env.drop(), now)?.then_some(check_cliff::Event::Drop)
});
supervisor!(CheckDirt, check_dirt, |live, env, now| {
    (current(env.dirt(), now)? > live.limit).then_some(check_dirt::Event::Dirty)
});
supervisor!(CheckButton, check_button, |_live, env, now| {
    current(env.button(), now)?.then_some(check_button::Event::Pressed)
});
