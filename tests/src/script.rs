//! Scripts: outcomes of components, writes from outside, times of steps.
//!
//! ```text
//! set size = 2.5                      an 'in' entry, before the start; numbers are SI
//! at 10 ms: g First = 7               from 10 ms until before 11 ms, 'g' reports 'First'
//! from 10 ms to 50 ms: a Done
//! always: g costs 6 ms                polls take their time
//! at 10 ms: a interrupt fault         'start', 'poll' (the default), 'suspend',
//!                                     'resume' or 'interrupt'
//! at 10 ms: a panic
//! at 15 ms: write x = 3
//! at 20 ms: stop
//! at 20 ms: hold                      'hold', 'continue' or 'go to the next', as a debugger
//! step at 10 ms 13 ms                 default: at the plan's wakes
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

use afp_core::{Duration, Instant, Release, Value};

pub use parse::ScriptError;

#[derive(Clone, Debug, Default)]
pub struct Script {
    /// Values of `in` entries before the start.
    pub inputs: Vec<(String, Value)>,
    /// The outcomes of components.
    pub signals: Vec<Signal>,
    /// The stimuli, in the order of the text.
    pub outside: Vec<(Instant, Outside)>,
    pub steps: Option<Vec<Instant>>,
    /// The last instant for a step.
    pub until: Instant,
    /// Whether polls of actors are logged.
    pub show_polls: bool,
    /// Whether the result of each step is logged.
    pub show_wakes: bool,
    /// Whether the names of all ids are logged first.
    pub show_names: bool,
    /// Whether requests to the platform are hidden.
    pub show_nothing: bool,
    /// Whether each step runs on a copy of the plan; scripts cannot set it.
    pub copied: bool,
    /// The number of last lines to keep, after the number of the others.
    pub show_last: Option<usize>,
}

/// The behaviour of a component for a while.
#[derive(Clone, Debug)]
pub struct Signal {
    /// The component's `name` input.
    pub channel: String,
    /// The affected call.
    pub phase: Phase,
    /// The affected time.
    pub during: Range<Instant>,
    /// The behaviour.
    pub act: Act,
}

/// A call of a component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    Start,
    Poll,
    Suspend,
    Resume,
    Interrupt,
}

/// The behaviour of a component in a call.
#[derive(Clone, Debug)]
pub enum Act {
    /// It reports a state or an event, possibly with a number.
    Outcome(String, Option<f64>),
    /// It fails.
    Fault,
    Panic,
    /// It takes time.
    Cost(Duration),
}

/// A stimulus.
#[derive(Clone, Debug)]
pub enum Outside {
    Write(String, Value),
    Stop,
    Hold,
    Release(Release),
}

impl Script {
    /// A component's behaviour in a call at an instant, in the order of the script.
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
            Phase::Suspend => "suspend",
            Phase::Resume => "resume",
            Phase::Interrupt => "interrupt",
        })
    }
}
