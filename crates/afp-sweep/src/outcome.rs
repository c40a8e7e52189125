//! What a run came to.

use serde::{Deserialize, Serialize};

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// By a state or a computation of the plan.
    Ok,
    /// By an event.
    Interrupted,
    /// By the end of its time.
    TimeLimit,
    /// The plan ended in `Error`; a component that panics ends it so.
    Error,
    /// The run could not begin: a robot that would stand in something, a value that makes no sense.
    NotStarted,
    /// The simulator or the engine panicked.
    Panicked,
}

impl Ending {
    /// Every ending, the good ones first.
    pub const ALL: [Ending; 6] = [
        Ending::Ok,
        Ending::Interrupted,
        Ending::TimeLimit,
        Ending::Error,
        Ending::NotStarted,
        Ending::Panicked,
    ];

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Ending::Ok => "ok",
            Ending::Interrupted => "interrupted",
            Ending::TimeLimit => "time_limit",
            Ending::Error => "error",
            Ending::NotStarted => "not_started",
            Ending::Panicked => "panicked",
        }
    }

    /// Whether nothing good can be said of such a run.
    pub fn is_failure(self) -> bool {
        matches!(self, Ending::Error | Ending::NotStarted | Ending::Panicked)
    }
}

/// What a run came to. All but `took_s` is the same on every machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// The run's number in its sweep.
    pub run: u64,
    /// How it ended.
    pub ending: Ending,
    /// Where: the path of the component that was active or failed last.
    #[serde(rename = "where")]
    pub place: String,
    /// Why: the state or event, the fault, or what was refused.
    pub why: String,
    /// Simulated time, seconds.
    pub time_s: f64,
    /// The way that the robot went, metres.
    pub distance_m: f64,
    /// How often it ran into something.
    pub collisions: u64,
    /// How often an actor was interrupted.
    pub interruptions: u64,
    /// Deadlines that were missed.
    pub deadline_misses: u64,
    /// The mean error of following a wall, metres, where one was followed.
    pub wall_error_mean_m: Option<f64>,
    /// The greatest.
    pub wall_error_max_m: Option<f64>,
    /// The hash of the trace, 16 hexadecimal digits; empty for a run without one.
    pub trace: String,
    /// How long it took by the wall clock, seconds.
    pub took_s: f64,
}

impl Outcome {
    /// A run that has no more to tell than why it failed.
    pub(crate) fn failed(run: u64, ending: Ending, why: String) -> Self {
        Outcome {
            run,
            ending,
            place: String::new(),
            why,
            time_s: 0.0,
            distance_m: 0.0,
            collisions: 0,
            interruptions: 0,
            deadline_misses: 0,
            wall_error_mean_m: None,
            wall_error_max_m: None,
            trace: String::new(),
            took_s: 0.0,
        }
    }
}
