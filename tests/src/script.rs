//! What happens to a plan: answers of components, writes from outside, times of steps.
//!
//! ```text
//! set size = 2.5                      an 'in' entry, before the start; numbers are SI
//! at 10 ms: g First = 7               from 10 ms until before 11 ms, 'g' reports 'First'
//! from 10 ms to 50 ms: a Done
//! always: g costs 6 ms                polls take their time
//! at 10 ms: a interrupt fault         'start', 'poll' (if nothing is said) or 'interrupt'
//! at 10 ms: a panic
//! at 15 ms: write x = 3
//! at 20 ms: stop
//! step at 10 ms 13 ms                 else at the instants that the plan asks for
//! show polls                          also of actors
//! show wakes
//! show names                          of all components and entries, first
//! show nothing                        not even interrupts
//! show last 4                         of all lines
//! until 100 ms
//! ```

mod parse;

use std::fmt;
use std::ops::Range;

use afp_core::{Duration, Instant, Value};

pub use parse::ScriptError;

/// Everything that happens to a plan.
#[derive(Clone, Debug, Default)]
pub struct Script {
    /// Values of `in` entries before the start.
    pub inputs: Vec<(String, Value)>,
    /// What components answer.
    pub signals: Vec<Signal>,
    /// What comes from outside, as written.
    pub outside: Vec<(Instant, Outside)>,
    /// Steps at these instants and no others.
    pub steps: Option<Vec<Instant>>,
    /// No step after this instant.
    pub until: Instant,
    /// Polls of actors are noted too.
    pub show_polls: bool,
    /// What each step returns is noted too.
    pub show_wakes: bool,
    /// The names behind all ids are noted first.
    pub show_names: bool,
    /// What the platform is asked is not noted.
    pub show_nothing: bool,
    /// Before each step the plan is exchanged for a copy of itself; no line of a script says so.
    pub copied: bool,
    /// Of all lines, only the last ones and the number of the others are kept.
    pub show_last: Option<usize>,
}

/// What one component does for a while.
#[derive(Clone, Debug)]
pub struct Signal {
    /// The component's `name` input.
    pub channel: String,
    /// The call that it is about.
    pub phase: Phase,
    /// When.
    pub during: Range<Instant>,
    /// What it does.
    pub act: Act,
}

/// A call of a component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// It is started.
    Start,
    /// It is polled.
    Poll,
    /// It is interrupted.
    Interrupt,
}

/// What a component does in a call.
#[derive(Clone, Debug)]
pub enum Act {
    /// It reports a state or an event, perhaps with a number.
    Outcome(String, Option<f64>),
    /// It fails.
    Fault,
    /// It panics.
    Panic,
    /// It takes its time.
    Cost(Duration),
}

/// What comes from outside.
#[derive(Clone, Debug)]
pub enum Outside {
    /// A write to an entry.
    Write(String, Value),
    /// A stop request.
    Stop,
}

impl Script {
    /// What a component does in a call at an instant, in the order of the script.
    pub fn acts(&self, channel: &str, phase: Phase, now: Instant) -> impl Iterator<Item = &Act> {
        self.signals
            .iter()
            .filter(move |signal| {
                signal.channel == channel && signal.phase == phase && signal.during.contains(&now)
            })
            .map(|signal| &signal.act)
    }
}

impl fmt::Display for Phase {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Phase::Start => "start",
            Phase::Poll => "poll",
            Phase::Interrupt => "interrupt",
        })
    }
}
