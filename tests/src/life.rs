//! The calls of actors: start, then any number of suspend and resume, then one end.

use std::collections::BTreeMap;

use afp_core::{Instant, Text};

use crate::script::Phase;

/// A started actor.
#[derive(Clone, Debug)]
pub struct Life {
    name: Text,
    number: u64,
}

/// All actors that have started and not ended.
#[derive(Clone, Default)]
pub struct Lives {
    started: u64,
    alive: BTreeMap<u64, Alive>,
}

#[derive(Clone)]
struct Alive {
    name: Text,
    state: State,
    /// The instant of the start or the last resume.
    since: Instant,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    Running,
    Suspended,
    /// Its outputs may still fail; then it is interrupted.
    Ready,
}

impl Life {
    pub fn name(&self) -> &str {
        self.name.as_str()
    }
}

impl Lives {
    /// A started actor, and the reason why it may not start.
    pub fn begin(&mut self, name: Text, now: Instant) -> (Life, Option<String>) {
        let wrong = self.beside(&name, "start");
        self.alive.retain(|_, alive| alive.state != State::Ready);
        self.started += 1;
        let life = Life { name: name.clone(), number: self.started };
        self.alive.insert(life.number, Alive { name, state: State::Running, since: now });
        (life, wrong)
    }

    /// The reason why a call may not happen.
    pub fn call(&self, life: &Life, phase: Phase, now: Instant) -> Option<String> {
        let Some(alive) = self.alive.get(&life.number) else {
            return Some(format!("{phase} of {}, which has ended", life.name()));
        };
        let fits = match phase {
            Phase::Start => false,
            Phase::Poll => alive.state == State::Running && alive.since < now,
            Phase::Suspend => alive.state == State::Running,
            Phase::Resume => alive.state == State::Suspended,
            Phase::Interrupt => true,
        };
        match phase {
            _ if !fits => Some(format!("{phase} of {}, {:?}", life.name(), alive.state)),
            Phase::Resume => self.beside(&life.name, "resume"),
            _ => None,
        }
    }

    /// Another actor that is running while one starts or resumes.
    fn beside(&self, name: &Text, what: &str) -> Option<String> {
        let running = self.alive.values().find(|alive| alive.state == State::Running)?;
        Some(format!("{what} of {} while {} is running", name.as_str(), running.name.as_str()))
    }

    /// A call succeeded.
    pub fn called(&mut self, life: &Life, phase: Phase, now: Instant) {
        let state = match phase {
            Phase::Start | Phase::Poll => return,
            Phase::Suspend => State::Suspended,
            Phase::Resume => State::Running,
            Phase::Interrupt => {
                self.alive.remove(&life.number);
                return;
            }
        };
        if let Some(alive) = self.alive.get_mut(&life.number) {
            (alive.state, alive.since) = (state, now);
        }
    }

    pub fn ready(&mut self, life: &Life) {
        if let Some(alive) = self.alive.get_mut(&life.number) {
            alive.state = State::Ready;
        }
    }

    /// An actor that has not ended, after the run.
    pub fn left(&self) -> Option<String> {
        let left = self.alive.values().find(|alive| alive.state != State::Ready)?;
        Some(format!("{} is left, {:?}", left.name.as_str(), left.state))
    }
}
