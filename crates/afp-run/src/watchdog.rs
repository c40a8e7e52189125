//! A thread that watches the control loop of a real robot and stops the robot if a component hangs.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, Thread};

use afp_core::Duration;
use afp_core::trace::Names;
use afp_session::Watch;

use crate::run::realtime;
use crate::stderr::say;
use crate::stop::StopFlag;

/// Watches until it is dropped.
pub(crate) struct Watchdog {
    done: Arc<AtomicBool>,
    thread: Thread,
}

impl Watchdog {
    /// Watches a control loop, which may be late by less than `stall`, from a thread above the control loop's priority.
    ///
    /// # Errors
    /// The thread cannot be created.
    pub(crate) fn start(
        watch: Watch,
        stall: Duration,
        priority: Option<u8>,
        stop: StopFlag,
        names: Box<dyn Names + Send>,
    ) -> io::Result<Self> {
        let done: Arc<AtomicBool> = Arc::default();
        let is_done = done.clone();
        // The rest is time for the stop itself.
        let limit = Duration::from_nanos(stall.as_nanos() / 10 * 9);
        watch.begin();
        let watches = move || {
            // The control loop warns of a system that refuses priorities.
            let _ = priority.map(|priority| realtime::raise(priority.saturating_add(1)));
            while !is_done.load(Ordering::Relaxed) {
                match watch.late() {
                    late if late < limit => thread::park_timeout((limit - late).into()),
                    late => return act(&watch, late, &stop, &*names),
                }
            }
        };
        let thread = thread::Builder::new().name("afp-watchdog".into()).spawn(watches)?;
        Ok(Watchdog { done, thread: thread.thread().clone() })
    }
}

/// Stops the robot, then prints the reason.
fn act(watch: &Watch, late: Duration, stop: &StopFlag, names: &dyn Names) {
    let is_stopped = stop.take_power();
    watch.cut();
    let component = names.component(watch.called());
    let by = match is_stopped {
        true => "the robot was stopped from another thread",
        false => "the robot cannot be stopped from another thread",
    };
    let (path, template) = (component.path, component.template);
    say(format_args!(
        "error: the control loop has been held up for {} ms, since the call of '{path}' ({template}): {by}",
        late.as_nanos() / 1_000_000
    ));
}

impl Drop for Watchdog {
    fn drop(&mut self) {
        self.done.store(true, Ordering::Relaxed);
        // No join: the thread may be blocked by an output.
        self.thread.unpark();
    }
}
