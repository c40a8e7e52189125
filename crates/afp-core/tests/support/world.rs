//! A platform whose components answer by script.

use std::cell::Cell;
use std::ops::Range;
use std::rc::Rc;

use afp_core::{Clock, Duration, Environment, Events, Fault, Instant, Platform, Reason};

use super::ms;

/// The fault that scripts cause.
pub const SCRIPTED: Fault = Fault::new(&Reason { code: "scripted", text: "as the script says" });

/// A phase of a component's life.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    Start,
    Poll,
    Interrupt,
    Suspend,
    Resume,
    /// A sub-plan's live inputs at its return.
    Refresh,
    /// An output that cannot be converted.
    Output,
}

#[derive(Clone, Copy)]
enum Act {
    Outcome(u16),
    Fault,
    Panic,
    Cost(Duration),
}

struct Rule {
    who: &'static str,
    phase: Phase,
    during: Range<Instant>,
    act: Act,
}

/// Cost of polls, shown by the clock.
#[derive(Clone, Default)]
pub struct CostClock(Rc<Cell<Instant>>);

impl Clock for CostClock {
    fn now(&self, step: Instant) -> Instant {
        self.0.get().max(step)
    }
}

/// Scripted answers of components, and a record of the calls.
#[derive(Default)]
pub struct World {
    rules: Vec<Rule>,
    /// Random answers instead of rules.
    chance: Option<Chance>,
    /// Every call, as `5 interrupt go`.
    pub calls: Vec<String>,
    /// The actor that moves the robot.
    moving: Option<&'static str>,
    /// Records nothing.
    quiet: bool,
    pub clock: CostClock,
    /// The time of [`Platform::now`].
    pub time: Instant,
    /// Earliest next step.
    pub ready: Instant,
}

/// Random answers: outcomes now and then, or lasting ones, and faults if wanted.
struct Chance {
    dice: Dice,
    faults: bool,
}

/// A small random number generator.
#[derive(Clone)]
pub struct Dice(pub u64);

impl Dice {
    /// A number below `end`.
    pub fn below(&mut self, end: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (self.0 >> 33) % end
    }

    pub fn percent(&mut self, part: u64) -> bool {
        self.below(100) < part
    }
}

impl Chance {
    fn fails(&mut self, phase: Phase) -> bool {
        let part = match phase {
            Phase::Suspend | Phase::Resume => 50,
            Phase::Start => 20,
            Phase::Poll | Phase::Refresh => 5,
            Phase::Interrupt => 1,
            Phase::Output => 0,
        };
        self.faults && self.dice.below(1000) < part
    }

    fn outcome(&mut self, who: &str, wanted: Events, now: Instant) -> Option<u16> {
        // A supervisor whose name ends so reports for stretches of time.
        let lasting = who.ends_with('l');
        let stretch = now.as_nanos() / 40_000_000;
        let holds = |dice: &mut Dice, outcome: u16| match lasting {
            true => (stretch + u64::from(outcome)).is_multiple_of(3),
            false => dice.percent(6),
        };
        (0..2).filter(|n| wanted.contains(*n)).find(|n| holds(&mut self.dice, *n))
    }
}

impl World {
    /// A platform whose components answer at random, with faults if wanted.
    pub fn random(dice: Dice, faults: bool) -> Self {
        World { chance: Some(Chance { dice, faults }), ..World::default() }
    }

    /// A platform that records nothing.
    pub fn quiet() -> Self {
        World { quiet: true, ..World::default() }
    }

    /// Polls return this outcome from `during.start` until before `during.end` (milliseconds).
    pub fn says(self, who: &'static str, outcome: u16, during: Range<u64>) -> Self {
        self.rule(who, Phase::Poll, during, Act::Outcome(outcome))
    }

    pub fn fails(self, who: &'static str, phase: Phase, during: Range<u64>) -> Self {
        self.rule(who, phase, during, Act::Fault)
    }

    pub fn panics(self, who: &'static str, phase: Phase, during: Range<u64>) -> Self {
        self.rule(who, phase, during, Act::Panic)
    }

    /// Polls take `cost` milliseconds.
    pub fn costs(self, who: &'static str, phase: Phase, cost: u64, during: Range<u64>) -> Self {
        self.rule(who, phase, during, Act::Cost(Duration::from_millis(cost)))
    }

    fn rule(mut self, who: &'static str, phase: Phase, during: Range<u64>, act: Act) -> Self {
        let during = ms(during.start)..ms(during.end);
        self.rules.push(Rule { who, phase, during, act });
        self
    }

    fn holding(&self, who: &str, phase: Phase, now: Instant) -> impl Iterator<Item = Act> {
        self.rules
            .iter()
            .filter(move |rule| {
                rule.who == who && rule.phase == phase && rule.during.contains(&now)
            })
            .map(|rule| rule.act)
    }

    fn note(&mut self, now: Instant, what: &str, who: &str) {
        if !self.quiet {
            let millis = now.as_nanos() / 1_000_000;
            self.calls.push(format!("{millis} {what} {who}").trim_end().to_owned());
        }
    }

    /// A component is started, polled or interrupted.
    pub fn call(&mut self, who: &'static str, phase: Phase, now: Instant) -> Result<(), Fault> {
        let what = match phase {
            Phase::Start => "start",
            Phase::Poll => "poll",
            Phase::Interrupt => "interrupt",
            Phase::Suspend => "suspend",
            Phase::Resume => "resume",
            Phase::Refresh => "refresh",
            Phase::Output => return Ok(()),
        };
        self.note(now, what, who);
        let mut cost = Duration::ZERO;
        let mut result = Ok(());
        for act in self.holding(who, phase, now) {
            match act {
                Act::Cost(more) => cost += more,
                Act::Fault => result = Err(SCRIPTED),
                // Bypasses the hook that would print the panic.
                Act::Panic => std::panic::resume_unwind(Box::new("as the script says")),
                Act::Outcome(_) => {}
            }
        }
        let clock = &self.clock.0;
        clock.set(clock.get().max(now) + cost);
        if self.chance.as_mut().is_some_and(|chance| chance.fails(phase)) {
            return Err(SCRIPTED);
        }
        result
    }

    /// A component continues after `away`.
    pub fn resumes(
        &mut self,
        who: &'static str,
        away: Duration,
        now: Instant,
    ) -> Result<(), Fault> {
        let millis = away.as_nanos() / 1_000_000;
        self.note(now, &format!("back after {millis}"), who);
        self.call(who, Phase::Resume, now)
    }

    /// An actor starts or continues, while all others are stationary.
    pub fn moves(&mut self, who: &'static str) {
        let other = self.moving.replace(who);
        assert_eq!(other, None, "{who} moves at the same time");
    }

    /// The actor ends or is suspended.
    pub fn rests(&mut self) {
        self.moving = None;
    }

    /// The result of passing outputs; records nothing.
    pub fn output(&self, who: &str, now: Instant) -> Result<(), Fault> {
        match self.holding(who, Phase::Output, now).next() {
            Some(_) => Err(SCRIPTED),
            None => Ok(()),
        }
    }

    /// Records a value that a component read at a poll.
    pub fn saw(&mut self, now: Instant, who: &str, value: &str) {
        self.note(now, &format!("see {value}"), who);
    }

    /// The outcome of a poll: the first declared outcome that holds and is wanted.
    pub fn outcome(&mut self, who: &str, wanted: Events, now: Instant) -> Option<u16> {
        if let Some(chance) = &mut self.chance {
            return chance.outcome(who, wanted, now);
        }
        let outcomes = self.holding(who, Phase::Poll, now).filter_map(|act| match act {
            Act::Outcome(outcome) if wanted.contains(outcome) => Some(outcome),
            _ => None,
        });
        outcomes.min()
    }
}

impl Environment for World {
    fn stop(&mut self, now: Instant) {
        self.note(now, "stop", "");
    }

    fn emergency_stop(&mut self) {
        if !self.quiet {
            self.calls.push("emergency stop".to_owned());
        }
    }
}

impl Platform for World {
    type Clock = CostClock;

    fn clock(&self) -> CostClock {
        self.clock.clone()
    }

    fn now(&self) -> Instant {
        self.time
    }

    fn advance(&mut self, to: Instant) {
        self.time = self.time.max(to);
    }

    fn ready(&self) -> Instant {
        self.ready
    }
}
