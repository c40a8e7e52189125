//! `--disarmed`: a run that waits until an operator or the robot's button arms it; and messages to
//! service managers.

use std::io::{self, BufRead};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;

use afp_core::{Duration, Instant};
use afp_session::AnySession;

use crate::error::RunError;
use crate::stop::StopFlag;

/// The line that starts the run.
const ARM: &str = "arm";
/// The state of an armed program.
const ARMED: &str = "STATUS=armed";
/// The interval of looks at the button.
const LOOK: Duration = Duration::from_millis(20);
/// The shortest and the longest press of the button that arms. A broken wire looks like a press
/// without an end.
const PRESS: (Duration, Duration) = (Duration::from_secs(1), Duration::from_secs(5));

/// Reports that the program is ready, and waits for the line `arm` on standard input, or for a press
/// of the button of a robot that has not started. Returns whether one came before the end of the
/// input or a signal.
///
/// # Errors
/// Standard input cannot be read, or signals cannot be handled.
pub(super) fn wait(robot: Option<Box<dyn AnySession>>) -> Result<bool, RunError> {
    let cannot = RunError::file("cannot handle", "signals".as_ref());
    let stop = StopFlag::on_signals().map_err(cannot)?;
    let lines = lines();
    let mut robot = robot.filter(|robot| robot.button().is_some());
    let mut press = Press::default();
    notify("READY=1");
    while !stop.is_raised() {
        let patience = match &mut robot {
            Some(robot) => {
                robot.wait(robot.now() + LOOK);
                if robot.button().is_some_and(|pressed| press.arms(pressed, robot.now())) {
                    notify(ARMED);
                    return Ok(true);
                }
                std::time::Duration::ZERO
            }
            None => LOOK.into(),
        };
        match lines.recv_timeout(patience) {
            Ok(Ok(line)) if line == ARM => {
                notify(ARMED);
                return Ok(true);
            }
            Ok(Ok(_)) | Err(RecvTimeoutError::Timeout) => {}
            Ok(Err(why)) => {
                return Err(RunError::file("cannot read", "standard input".as_ref())(why));
            }
            Err(RecvTimeoutError::Disconnected) => return Ok(false),
        }
    }
    Ok(false)
}

/// The lines of standard input, read by another thread.
fn lines() -> Receiver<io::Result<String>> {
    let (to, lines) = mpsc::channel();
    thread::spawn(move || {
        let _ = io::stdin().lock().lines().try_for_each(|line| to.send(line));
    });
    lines
}

/// A press of the button.
#[derive(Default)]
struct Press {
    /// Whether the button was free before.
    was_free: bool,
    since: Option<Instant>,
}

impl Press {
    /// Takes the state of the button; returns whether a press of the right length has ended.
    fn arms(&mut self, pressed: bool, now: Instant) -> bool {
        if pressed {
            if self.was_free && self.since.is_none() {
                self.since = Some(now);
            }
            return false;
        }
        self.was_free = true;
        let held = self.since.take().map(|since| now.since(since));
        held.is_some_and(|held| (PRESS.0..=PRESS.1).contains(&held))
    }
}

/// Sends a state such as `READY=1` to the service manager, if `NOTIFY_SOCKET` names one, as
/// `sd_notify` does. A manager that does not listen waits for nothing.
pub fn notify(state: &str) {
    #[cfg(unix)]
    if let Some(path) = std::env::var_os("NOTIFY_SOCKET")
        && let Ok(socket) = std::os::unix::net::UnixDatagram::unbound()
    {
        socket.send_to(state.as_bytes(), path).ok();
    }
    #[cfg(not(unix))]
    let _ = state;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a button arms that is pressed in these seconds of ten.
    fn arms(pressed: impl Fn(f64) -> bool) -> bool {
        let mut press = Press::default();
        (0..500_u64).any(|look| {
            press.arms(pressed(look as f64 / 50.0), Instant::from_nanos(look * 20_000_000))
        })
    }

    #[test]
    fn only_a_press_of_one_to_five_seconds_arms() {
        assert!(arms(|at| (2.0..3.5).contains(&at)));
        assert!(!arms(|at| (2.0..2.5).contains(&at)), "a touch");
        assert!(!arms(|at| (2.0..8.0).contains(&at)), "a weight on it");
        assert!(!arms(|_| true), "a broken wire");
        assert!(!arms(|at| at > 2.0), "a wire that breaks");
        assert!(!arms(|at| at < 3.0), "a button that was pressed before");
        assert!(!arms(|at| ((at * 10.0) as u64).is_multiple_of(2)), "a loose wire");
        assert!(!arms(|_| false));
    }
}
