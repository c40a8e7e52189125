//! The test platform: it answers for every component by script, and logs all requests.

use std::cell::{Cell, RefCell};
use std::panic::resume_unwind;
use std::rc::Rc;

use afp_core::{Clock, Duration, Environment, Fault, Instant, Reason, Text};

use crate::life::Lives;
use crate::script::{Act, Phase, Script};

pub use crate::life::Life;

pub const SCRIPTED: Fault = Fault::new(&Reason { code: "scripted", text: "as the script says" });

/// The beginning of a line about a call that may not happen.
pub const WRONG_CALL: &str = "[wrong call:";

/// Lines written alternately by trace and platform.
#[derive(Clone, Default)]
pub struct Log(Rc<RefCell<Vec<String>>>);

/// A virtual clock, advanced only by the cost of polls.
#[derive(Clone, Default)]
pub struct CostClock(Rc<Cell<Instant>>);

/// The robot of the toolbox's components.
pub struct Platform {
    script: Script,
    log: Log,
    clock: CostClock,
    lives: Lives,
}

impl Log {
    pub fn note(&self, line: String) {
        self.0.borrow_mut().push(line);
    }

    /// All lines so far.
    pub fn lines(&self) -> Vec<String> {
        self.0.borrow().clone()
    }
}

impl CostClock {
    /// The latest time that it has shown.
    pub fn latest(&self) -> Instant {
        self.0.get()
    }
}

impl Clock for CostClock {
    fn now(&self, step: Instant) -> Instant {
        self.0.set(self.0.get().max(step));
        self.0.get()
    }
}

impl Platform {
    pub fn new(script: Script, log: Log, clock: CostClock) -> Self {
        Platform { script, log, clock, lives: Lives::default() }
    }

    /// The platform of a copied plan, whose actors continue.
    pub fn copied(&self, log: Log, clock: CostClock) -> Self {
        Platform { script: self.script.clone(), log, clock, lives: self.lives.clone() }
    }

    /// Starts, polls or interrupts a component: it may fail, panic or take time.
    ///
    /// # Errors
    /// The script's fault.
    pub fn call(&mut self, channel: &str, phase: Phase, now: Instant) -> Result<(), Fault> {
        let shown = match phase {
            Phase::Start => false,
            Phase::Poll => self.script.show_polls,
            Phase::Suspend | Phase::Resume | Phase::Interrupt => true,
        };
        if shown && !self.script.show_nothing {
            self.log.note(format!("{now} [{phase} {channel}]"));
        }
        let mut cost = Duration::ZERO;
        let mut result = Ok(());
        for act in self.script.acts(channel, phase, now) {
            match act {
                Act::Cost(more) => cost += *more,
                Act::Fault => result = Err(SCRIPTED),
                // Without the hook that would print it.
                Act::Panic => resume_unwind(Box::new("as the script says")),
                Act::Outcome(..) => {}
            }
        }
        self.clock.0.set(self.clock.0.get().max(now) + cost);
        result
    }

    /// Starts an actor.
    ///
    /// # Errors
    /// The script's fault.
    pub fn begin(&mut self, channel: &str, now: Instant) -> Result<Life, Fault> {
        let name = Text::try_from(channel)?;
        self.call(channel, Phase::Start, now)?;
        let (life, wrong) = self.lives.begin(name, now);
        self.note(wrong);
        Ok(life)
    }

    /// A call of a started actor.
    ///
    /// # Errors
    /// The script's fault.
    pub fn act(&mut self, life: &Life, phase: Phase, now: Instant) -> Result<(), Fault> {
        let wrong = self.lives.call(life, phase, now);
        self.note(wrong);
        let result = self.call(life.name(), phase, now);
        if result.is_ok() {
            self.lives.called(life, phase, now);
        }
        result
    }

    /// An actor is ready.
    pub fn end(&mut self, life: &Life) {
        self.lives.ready(life);
    }

    /// Checks that every actor has ended.
    pub fn check_end(&self) {
        self.note(self.lives.left());
    }

    fn note(&self, wrong: Option<String>) {
        if let Some(wrong) = wrong {
            self.log.note(format!("{WRONG_CALL} {wrong}]"));
        }
    }

    /// The current outcomes, each with its number, in the order of the script.
    pub fn outcomes(
        &self,
        channel: &str,
        now: Instant,
    ) -> impl Iterator<Item = (&str, Option<f64>)> {
        self.script.acts(channel, Phase::Poll, now).filter_map(|act| match act {
            Act::Outcome(outcome, number) => Some((outcome.as_str(), *number)),
            _ => None,
        })
    }
}

impl Environment for Platform {
    fn stop(&mut self, now: Instant) {
        self.log.note(format!("{now} [stop]"));
    }

    fn hold(&mut self, now: Instant) {
        self.log.note(format!("{now} [hold]"));
    }

    fn emergency_stop(&mut self) {
        self.log.note("[emergency stop]".to_owned());
    }
}
