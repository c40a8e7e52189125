//! What other threads see of a run while one drives it.

use std::sync::{Mutex, PoisonError};
use std::thread::{self, ThreadId};

use afp_session::Pose2;

/// A run as it was a moment ago.
#[derive(Clone)]
pub struct Glance {
    /// Seconds since the start.
    pub time: f64,
    /// Where the robot truly is, where it says so.
    pub pose: Option<Pose2>,
    /// How the plan ended.
    pub ending: &'static str,
    /// The active element of the outermost plan.
    pub active: Option<String>,
    /// The thread that drives it.
    pub driver: ThreadId,
}

/// The latest glance; none before a run has been driven.
#[derive(Default)]
pub struct Seen(Mutex<Option<Glance>>);

impl Seen {
    /// Lets others see this.
    pub fn show(&self, glance: Glance) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(glance);
    }

    /// What others see. Who drives the run gets none: a component of its own must not read what depends on the clock of
    /// the wall.
    pub fn glance(&self) -> Option<Glance> {
        let seen = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        seen.clone().filter(|glance| glance.driver != thread::current().id())
    }
}
