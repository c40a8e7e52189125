//! A target that replays the events of a log and cannot change them.

use std::sync::Arc;

use afp_core::devices::DeviceRow;
use afp_core::trace::ComponentId;
use afp_core::{Duration, Instant};
use afp_session::{Pose2, Request, RunEvent, Stimulus};

use crate::program::Program;
use crate::sensed::Sensed;
use crate::state::State;
use crate::target::{Advance, Happened, Position, Target};

/// The moments between two saved states, and so the most moments replayed after a jump back.
const KEYFRAMES: usize = 1024;

/// The error for a change of a recorded run.
pub(crate) const READ_ONLY: &str = "a log cannot be changed: launch its plan instead";

/// The last camera picture at a time: width, height, and a byte for each of red, green and blue.
type Pictures = Box<dyn Fn(Instant) -> Option<(u32, u32, Vec<u8>)> + Send>;

/// The robot's signals at a time and a pose.
type Senses = Box<dyn Fn(Instant, Option<Pose2>) -> Vec<Sensed> + Send>;

/// A recorded run. All events of an instant are one step.
pub struct LogTarget {
    program: Arc<Program>,
    events: Vec<RunEvent>,
    /// The end of each moment in the events.
    moments: Vec<usize>,
    /// The state before each [`KEYFRAMES`]th moment.
    keyframes: Vec<State>,
    /// The number of past moments.
    passed: usize,
    /// The robot's pose by time.
    poses: Vec<(Instant, Pose2)>,
    /// The last camera picture at a time.
    picture: Pictures,
    /// The robot's signals at a time.
    senses: Senses,
    now: Instant,
    state: State,
}

impl LogTarget {
    /// Makes a recorded run of a program from its events. Events are sorted by time, and those of
    /// one instant stay in order.
    ///
    /// # Errors
    /// The reason if the events belong to a different program.
    pub fn new(program: Arc<Program>, mut events: Vec<RunEvent>) -> Result<LogTarget, String> {
        let known = |event: &RunEvent| match program.unit(event.component.id) {
            Some(unit) => event.component.path.is_empty() || unit.path == event.component.path,
            None => event.component.id == afp_session::OUTSIDE,
        };
        if let Some(stranger) = events.iter().find(|event| !known(event)) {
            let name = &stranger.component.path;
            return Err(format!(
                "the log has '{name}', but its plan no longer does: the toolboxes have changed since"
            ));
        }
        events.sort_by_key(|event| event.at);
        let mut moments: Vec<_> = events
            .windows(2)
            .zip(1..)
            .filter_map(|(pair, next)| (pair[0].at != pair[1].at).then_some(next))
            .collect();
        moments.extend((!events.is_empty()).then_some(events.len()));
        let (now, state) = (Instant::ZERO, State::default());
        let keyframes = vec![state.clone()];
        let (poses, picture): (_, Pictures) = (Vec::new(), Box::new(|_| None));
        let senses: Senses = Box::new(|_, _| Vec::new());
        let passed = 0;
        Ok(LogTarget {
            program,
            events,
            moments,
            keyframes,
            passed,
            poses,
            picture,
            senses,
            now,
            state,
        })
    }

    /// Adds the robot's pose by time.
    pub fn with_poses(self, poses: Vec<(Instant, Pose2)>) -> LogTarget {
        LogTarget { poses, ..self }
    }

    /// Adds the last camera picture at a time.
    pub fn with_pictures(
        self,
        picture: impl Fn(Instant) -> Option<(u32, u32, Vec<u8>)> + Send + 'static,
    ) -> LogTarget {
        LogTarget { picture: Box::new(picture), ..self }
    }

    /// Adds the robot's signals at a time and a pose.
    pub fn with_senses(
        self,
        senses: impl Fn(Instant, Option<Pose2>) -> Vec<Sensed> + Send + 'static,
    ) -> LogTarget {
        LogTarget { senses: Box::new(senses), ..self }
    }

    /// The events of the next moment.
    fn next(&self) -> Option<std::ops::Range<usize>> {
        let end = *self.moments.get(self.passed)?;
        let begin = self.passed.checked_sub(1).and_then(|before| self.moments.get(before));
        Some(begin.copied().unwrap_or(0)..end)
    }

    /// Replays the next moment.
    fn pass(&mut self, report: &mut dyn FnMut(&Happened, &State)) {
        let Some(events) = self.next() else { return };
        for event in &self.events[events] {
            self.state.apply(event, &self.program);
            self.now = event.at;
            report(&Happened::new(event.clone()), &self.state);
        }
        self.passed += 1;
        if self.passed.is_multiple_of(KEYFRAMES) && self.passed / KEYFRAMES == self.keyframes.len()
        {
            self.keyframes.push(self.state.clone());
        }
    }

    /// Goes to after the given number of moments.
    fn go(&mut self, passed: usize) {
        let passed = passed.min(self.moments.len());
        let frame = (passed / KEYFRAMES).min(self.keyframes.len() - 1);
        if passed < self.passed || frame * KEYFRAMES > self.passed {
            self.state = self.keyframes[frame].clone();
            self.passed = frame * KEYFRAMES;
            self.now = self.at(self.passed);
        }
        while self.passed < passed {
            self.pass(&mut |_, _| {});
        }
    }

    /// The instant of the last of this number of moments.
    fn at(&self, passed: usize) -> Instant {
        let last = passed.checked_sub(1).and_then(|last| self.moments.get(last));
        last.and_then(|end| self.events.get(end - 1)).map_or(Instant::ZERO, |event| event.at)
    }
}

impl Target for LogTarget {
    fn program(&self) -> &Arc<Program> {
        &self.program
    }

    fn state(&self) -> &State {
        &self.state
    }

    fn now(&self) -> Instant {
        self.now
    }

    fn steps(&self) -> u64 {
        self.passed as u64
    }

    fn is_recorded(&self) -> bool {
        true
    }

    fn advance(
        &mut self,
        limit: Instant,
        report: &mut dyn FnMut(&Happened, &State),
    ) -> Result<Advance, String> {
        let Some(events) = self.next() else { return Ok(Advance::Ended) };
        if self.events[events.start].at > limit {
            self.now = self.now.max(limit);
            return Ok(Advance::Limit);
        }
        self.pass(report);
        Ok(if self.passed == self.moments.len() { Advance::Ended } else { Advance::On })
    }

    fn seek(&mut self, to: Position) -> Result<(), String> {
        let over = |at: Instant| {
            self.moments
                .partition_point(|end| self.events.get(end - 1).is_some_and(|it| it.at <= at))
        };
        match to {
            Position::Step(step) => self.go(usize::try_from(step).unwrap_or(usize::MAX)),
            Position::At(at) => {
                self.go(over(at));
                self.now = at.min(self.at(self.moments.len()));
            }
        }
        Ok(())
    }

    fn past(&mut self, at: Instant) -> Result<State, String> {
        let (here, now) = (self.passed, self.now);
        self.seek(Position::At(at))?;
        let state = self.state.clone();
        self.go(here);
        self.now = now;
        Ok(state)
    }

    fn pose(&self) -> Option<Pose2> {
        let later = self.poses.partition_point(|(at, _)| *at <= self.now);
        self.poses.get(later.saturating_sub(1)).map(|(_, pose)| *pose)
    }

    fn sensed(&self) -> Vec<Sensed> {
        (self.senses)(self.now, self.pose())
    }

    fn picture(&self) -> Option<(u32, u32, Vec<u8>)> {
        (self.picture)(self.now)
    }

    fn set(&mut self, _: &str, _: &str) -> Result<String, String> {
        Err(READ_ONLY.to_owned())
    }

    fn devices(&self) -> &'static [DeviceRow] {
        &[]
    }

    fn ask(&mut self, _: Duration, _: Request) -> Result<Instant, String> {
        Err(READ_ONLY.to_owned())
    }

    fn repeat(&mut self, _: Instant, _: &Stimulus) -> Result<(), String> {
        Err(READ_ONLY.to_owned())
    }

    fn fire(&mut self, _: ComponentId, _: &str) -> Result<(), String> {
        Err(READ_ONLY.to_owned())
    }

    fn stop(&mut self, _: &mut dyn FnMut(&Happened, &State)) {}
}
