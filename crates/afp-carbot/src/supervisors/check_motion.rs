//! Watch for motion in the camera's picture.

use crate::devices::{Flow, FlowCamera, Invalid, Odometry};
use crate::helpers::guard::{Guard, NO_FLOW, NO_ODOMETRY};
use crate::helpers::history::History;
use crate::helpers::own_motion::Step;
use crate::templates;
use crate::templates::check_motion::{Event, Inputs, Live};
use afp_core::quantity::Angle;
use afp_core::{Events, Fault, Instant, Supervisor};
use moving::View;

mod moving;

/// With fewer trackable places a picture counts as blind: a covered lens, darkness.
const SEEN: usize = 4;
/// Pictures in a row that must show the motion, about in the same direction.
const IN_A_ROW: u32 = 2;
/// A larger change of direction between pictures means a different object, radians.
const SAME: f64 = 0.2;

/// Detects objects that move: flow beyond the robot's own motion, by odometry.
///
/// Motion exactly along a line of sight is not detected, nor an object that comes straight towards
/// a robot that drives towards it.
#[derive(Clone, Debug)]
pub struct CheckMotion {
    /// Radians a second.
    speed: f64,
    history: History,
    odometry: Guard,
    guard: Guard,
    last: Instant,
    /// The bearing in the last picture, and the number of pictures in a row.
    before: Option<(f64, u32)>,
}

impl<E: FlowCamera + Odometry + ?Sized> Supervisor<templates::CheckMotion, E> for CheckMotion {
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        let mut history = History::new();
        history.note(env.motion());
        env.flow(now)?;
        Ok(CheckMotion {
            speed: inputs.speed.si(),
            history,
            odometry: Guard::new(NO_ODOMETRY, now),
            guard: Guard::new(NO_FLOW, now),
            last: now,
            before: None,
        })
    }

    fn poll(
        &mut self,
        _: Live,
        wanted: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<Event>, Fault> {
        let counted = env.motion();
        self.history.note(counted);
        self.odometry.current(counted, now)?;
        let lens = env.lens();
        let mut reading = env.flow(now)?;
        let shows = |flow: &Flow<'_>| flow.shifts.iter().flatten().take(SEEN).count() == SEEN;
        if !reading.value.is_ok_and(|flow| shows(&flow)) {
            reading.value = reading.value.and(Err(Invalid::NoAnswer));
        }
        let Some(flow) = self.guard.next(reading, self.last, now)? else { return Ok(None) };
        self.last = reading.time;
        // A picture without odometry is skipped.
        let before = reading.time - flow.span;
        let step = Step::between(&self.history, &lens, before, reading.time);
        let view = step.map(|step| View { lens, step, flow, speed: self.speed });
        let something = match view {
            Some(view) => view.largest()?,
            None => None,
        };
        self.before = something.map(|it| match self.before {
            Some((bearing, times)) if (it.bearing - bearing).abs() < SAME => {
                (it.bearing, times + 1)
            }
            _ => (it.bearing, 1),
        });
        let lasts = self.before.is_some_and(|(_, times)| times >= IN_A_ROW);
        Ok(something.filter(|_| lasts && wanted.contains(0)).map(|it| Event::MotionSeen {
            bearing: Angle::from_si(it.bearing),
            strength: it.strength,
        }))
    }
}

#[cfg(test)]
mod tests;
