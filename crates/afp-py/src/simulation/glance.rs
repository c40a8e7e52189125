//! The view of a run from other threads while one thread drives it.

use std::sync::{Mutex, PoisonError};
use std::thread::{self, ThreadId};

use afp_session::Pose2;

use crate::component::is_inside;

/// The recent state of a run.
#[derive(Clone)]
pub struct Glance {
    /// Seconds since the start.
    pub time: f64,
    /// The robot's true pose, if it has one.
    pub pose: Option<Pose2>,
    /// How the plan ended.
    pub ending: &'static str,
    /// The active element of the outermost plan.
    pub active: Option<String>,
    /// The thread that drives it.
    pub driver: ThreadId,
}

/// The latest glance; `None` before the first drive.
#[derive(Default)]
pub struct Seen(Mutex<Option<Glance>>);

impl Seen {
    /// Publishes a glance.
    pub fn show(&self, glance: Glance) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(glance);
    }

    /// Returns the latest glance, but not to a component of the driving thread, which must not read
    /// values that depend on the wall clock. A signal handler in that thread may.
    pub fn glance(&self) -> Option<Glance> {
        let seen = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        seen.clone().filter(|glance| glance.driver != thread::current().id() || !is_inside())
    }
}
