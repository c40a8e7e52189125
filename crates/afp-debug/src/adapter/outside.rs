//! Requests that act from outside: buttons, faults, moves, speed.

use std::time::Duration as Wall;

use afp_core::Duration;
use afp_core::devices::{find_control, find_fault};
use afp_session::{HOLD, Pose2, Put, Request};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Deserialize;
use serde_json::{Value, json};

use super::mode::Pace;
use super::{Adapter, Answer, Refusal};
use crate::log_target::READ_ONLY;
use crate::target::Target;

#[derive(Deserialize)]
pub(super) struct Press {
    control: String,
    held: Option<bool>,
}

#[derive(Deserialize)]
pub(super) struct Break {
    fault: String,
    amount: Option<f64>,
    seconds: Option<f64>,
}

#[derive(Deserialize)]
pub(super) struct Move {
    /// A thing of the world; the default is the robot.
    thing: Option<String>,
    to: [f64; 3],
}

#[derive(Deserialize)]
pub(super) struct Drop {
    shape: String,
    to: [f64; 3],
}

#[derive(Deserialize)]
pub(super) struct Speed {
    factor: Option<f64>,
}

impl<'h> Adapter<'h> {
    /// The running target, for a change.
    fn changeable(&mut self) -> Answer<&mut (dyn Target + 'h)> {
        let target = &mut *self.run()?.target;
        match target.is_recorded() {
            true => Err(READ_ONLY.into()),
            false => Ok(target),
        }
    }

    pub(super) fn press(&mut self, press: Press) -> Answer<()> {
        let target = self.changeable()?;
        let devices = target.devices();
        let unknown = || Refusal(format!("the robot has no control '{}'", press.control));
        let id = find_control(devices, &press.control).ok_or_else(unknown)?;
        let hold = Request::Hold(id, HOLD);
        target.ask(Duration::ZERO, press.held.map_or(hold, |held| Request::Press(id, held)))?;
        Ok(())
    }

    pub(super) fn fault(&mut self, fault: Break) -> Answer<()> {
        let target = self.changeable()?;
        let named = fault.fault.split_once('.');
        let found = named.and_then(|(device, name)| find_fault(target.devices(), device, name));
        let unknown = || Refusal(format!("the robot has no fault '{}'", fault.fault));
        let id = found.ok_or_else(unknown)?;
        let lasting = match fault.seconds {
            None => Duration::MAX,
            Some(seconds) if seconds > 0.0 && seconds < 1e9 => Duration::from_secs_f64(seconds),
            Some(_) => return Err("'seconds' is a number above 0".into()),
        };
        target.ask(Duration::ZERO, Request::Break(id, fault.amount, lasting))?;
        Ok(())
    }

    /// Moves the robot or a thing.
    pub(super) fn carry(&mut self, wanted: Move) -> Answer<()> {
        self.put(wanted.thing.map_or(Put::Robot, Put::Thing), wanted.to)
    }

    /// Adds a thing to the world.
    pub(super) fn drop_into(&mut self, wanted: Drop) -> Answer<()> {
        self.put(Put::New(wanted.shape), wanted.to)
    }

    pub(super) fn picture(&mut self) -> Answer<Value> {
        let target = &self.run()?.target;
        let (width, height, rgb) = target.picture().ok_or("there is no picture yet")?;
        let at = target.now().as_secs_f64();
        Ok(json!({"at": at, "width": width, "height": height, "rgb": STANDARD.encode(rgb)}))
    }

    fn put(&mut self, what: Put, [x, y, heading]: [f64; 3]) -> Answer<()> {
        let at = Pose2 { x, y, heading };
        self.changeable()?.ask(Duration::ZERO, Request::Put(what, at))?;
        Ok(())
    }

    pub(super) fn speed(&mut self, speed: Speed, now: Wall) -> Answer<()> {
        if speed.factor.is_some_and(|factor| !(factor > 0.0 && factor.is_finite())) {
            return Err("'factor' is a number above 0; leave it out for full speed".into());
        }
        let run = self.run()?;
        run.pace = Pace::new(speed.factor, run.target.now(), now);
        Ok(())
    }
}
