//! Requests to stop from outside: Ctrl-C, SIGTERM.

use std::fmt;
use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use afp_session::LastResort;

/// The exit code after a second signal.
#[cfg(any(unix, windows))]
const EXIT_SIGNAL: i32 = 130;

/// Whether the process was asked to stop.
#[derive(Clone, Debug, Default)]
pub struct StopFlag(Arc<Stop>);

#[derive(Default)]
struct Stop {
    raised: AtomicBool,
    /// The number of the signal that asked; zero if the user asked.
    signal: AtomicU8,
    /// Whether SIGTSTP also asks, instead of suspending the process.
    awake: AtomicBool,
    /// Whether the robot was already stopped by force: the next signal ends the process.
    powerless: AtomicBool,
    /// The last resort, called before the process ends by force.
    last_resort: Mutex<Option<LastResort>>,
}

impl fmt::Debug for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Stop").field("raised", &self.raised).finish_non_exhaustive()
    }
}

impl StopFlag {
    /// The flag that Ctrl-C, SIGTERM and other signals raise, one for the process. A second signal
    /// restores the terminal and ends the process at once. A limit of the system (SIGXFSZ, SIGXCPU)
    /// never ends it at once.
    ///
    /// # Errors
    /// Signals cannot be handled.
    #[cfg(unix)]
    pub fn on_signals() -> std::io::Result<Self> {
        signals::flag()
    }

    /// The flag that Ctrl-C, Ctrl-Break and the end of the console raise, one for the process. A second
    /// Ctrl-C ends the process at once.
    ///
    /// # Errors
    /// Ctrl-C cannot be handled.
    #[cfg(windows)]
    pub fn on_signals() -> std::io::Result<Self> {
        console::flag()
    }

    /// A flag without signals.
    ///
    /// # Errors
    /// None.
    #[cfg(not(any(unix, windows)))]
    pub fn on_signals() -> std::io::Result<Self> {
        Ok(StopFlag::default())
    }

    /// Raises the flag. Returns whether the process must end at once: the flag was already raised, or
    /// the robot was stopped by force.
    #[cfg(any(unix, windows))]
    fn raise(&self) -> bool {
        let is_second = self.0.raised.swap(true, Ordering::Relaxed);
        is_second || self.0.powerless.load(Ordering::Relaxed)
    }

    /// Makes SIGTSTP, from any sender, ask the process to stop instead of suspending it: a suspended
    /// process cannot stop its robot.
    ///
    /// # Errors
    /// Signals cannot be handled.
    pub(crate) fn stay_awake(&self) -> std::io::Result<()> {
        self.0.awake.store(true, Ordering::Relaxed);
        #[cfg(unix)]
        signals::take_sleep()?;
        Ok(())
    }

    /// Restores the terminal before SIGTSTP, from any sender, suspends the process.
    ///
    /// # Errors
    /// Signals cannot be handled.
    pub(crate) fn lend_terminal(&self) -> std::io::Result<()> {
        #[cfg(unix)]
        signals::take_sleep()?;
        Ok(())
    }

    pub fn is_raised(&self) -> bool {
        self.0.raised.load(Ordering::Relaxed)
    }

    /// The flag, for other threads.
    pub fn flag(&self) -> &AtomicBool {
        &self.0.raised
    }

    /// Sets the last resort, called before a second signal ends the process by force. `None` removes
    /// it.
    pub(crate) fn set_last_resort(&self, resort: Option<LastResort>) {
        *self.0.last_resort.lock().unwrap_or_else(PoisonError::into_inner) = resort;
    }

    /// Calls the last resort before the process ends by force. Returns whether there is one.
    fn resort(&self) -> bool {
        let resort = self.0.last_resort.lock().unwrap_or_else(PoisonError::into_inner).take();
        resort.map(|mut resort| resort()).is_some()
    }

    /// Stops the robot by force because its control loop hangs. Returns whether that is possible. The
    /// next signal ends the process.
    pub(crate) fn take_power(&self) -> bool {
        self.0.powerless.store(true, Ordering::Relaxed);
        self.resort()
    }

    /// The exit code after an orderly stop by a signal: 128 and the number of the signal, as in a shell.
    /// `None` for Ctrl-C, the usual end of a plan that has no end.
    pub fn exit_code(&self) -> Option<u8> {
        match self.0.signal.load(Ordering::Relaxed) {
            0 => None,
            signal => Some(128 + signal),
        }
    }
}

#[cfg(unix)]
mod signals {
    use std::io;
    use std::sync::atomic::Ordering;
    use std::sync::{Mutex, PoisonError};
    use std::thread;

    use signal_hook::consts::{
        SIGALRM, SIGHUP, SIGINT, SIGPROF, SIGQUIT, SIGTERM, SIGTSTP, SIGUSR1, SIGUSR2, SIGVTALRM,
        SIGXCPU, SIGXFSZ,
    };
    use signal_hook::iterator::{Handle, Signals};
    use signal_hook::low_level;

    use super::{EXIT_SIGNAL, StopFlag};
    use crate::keys;

    /// All signals that would end the process before the robot has stopped. A broken pipe is not one of
    /// them: its writer gets an error.
    const ALL: [i32; 11] = [
        SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGALRM, SIGVTALRM, SIGPROF, SIGUSR1, SIGUSR2, SIGXCPU,
        SIGXFSZ,
    ];

    static MADE: Mutex<Option<(StopFlag, Handle)>> = Mutex::new(None);

    /// The flag. The first call creates it and the thread that raises it.
    pub(super) fn flag() -> io::Result<StopFlag> {
        let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((flag, _)) = &*made {
            return Ok(flag.clone());
        }
        let signals = Signals::new(ALL)?;
        let (flag, signals_taken) = (StopFlag::default(), signals.handle());
        let raised = flag.clone();
        thread::Builder::new()
            .name("afp-signals".into())
            .spawn(move || handle(signals, &raised))?;
        *made = Some((flag.clone(), signals_taken));
        Ok(flag)
    }

    /// Delivers SIGTSTP to the thread, too.
    pub(super) fn take_sleep() -> io::Result<()> {
        let made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
        made.as_ref().map_or(Ok(()), |(_, handle)| handle.add_signal(SIGTSTP))
    }

    /// A thread may do more than a signal handler, also while other threads hang.
    fn handle(mut signals: Signals, flag: &StopFlag) {
        for signal in signals.forever() {
            let sleeps = signal == SIGTSTP && !flag.0.awake.load(Ordering::Relaxed);
            if signal == SIGQUIT || sleeps {
                if signal == SIGQUIT {
                    flag.resort();
                }
                // The process cannot end or suspend in another way, so a failure is ignored.
                keys::without_terminal(|| drop(low_level::emulate_default_handler(signal)));
                continue;
            }
            let of_user = matches!(signal, SIGINT | SIGTSTP);
            if let (false, Ok(number)) = (of_user, u8::try_from(signal)) {
                flag.0.signal.store(number, Ordering::Relaxed);
            }
            // The last lines of the run reach the same limit of the system again.
            let of_limit = matches!(signal, SIGXCPU | SIGXFSZ);
            if flag.raise() && !of_limit {
                flag.resort();
                keys::give_back();
                low_level::exit(EXIT_SIGNAL);
            }
        }
    }
}

#[cfg(windows)]
mod console {
    use std::io;
    use std::sync::{Mutex, PoisonError};

    use super::{EXIT_SIGNAL, StopFlag};

    static FLAG: Mutex<Option<StopFlag>> = Mutex::new(None);

    /// The flag. The first call creates it and the handler that raises it.
    pub(super) fn flag() -> io::Result<StopFlag> {
        let mut made = FLAG.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(flag) = &*made {
            return Ok(flag.clone());
        }
        let flag = StopFlag::default();
        let raised = flag.clone();
        let handler = move || {
            if raised.raise() {
                raised.resort();
                std::process::exit(EXIT_SIGNAL);
            }
        };
        ctrlc::set_handler(handler).map_err(io::Error::other)?;
        Ok(made.insert(flag).clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_resort_runs_once_unless_it_was_cancelled() {
        let (stop, done) = (StopFlag::default(), Arc::new(AtomicU8::new(0)));
        let count = || -> LastResort {
            let done = done.clone();
            Box::new(move || {
                done.fetch_add(1, Ordering::Relaxed);
            })
        };
        stop.set_last_resort(Some(count()));
        stop.resort();
        stop.resort();
        assert_eq!(done.load(Ordering::Relaxed), 1);
        stop.set_last_resort(Some(count()));
        stop.set_last_resort(None);
        stop.resort();
        assert_eq!(done.load(Ordering::Relaxed), 1);
    }

    /// The process has one flag: no other test here may use signals.
    #[cfg(unix)]
    #[test]
    fn a_suspend_signal_requests_a_stop() {
        let stop = StopFlag::on_signals().unwrap();
        stop.stay_awake().unwrap();
        signal_hook::low_level::raise(signal_hook::consts::SIGTSTP).unwrap();
        let patience = std::time::Instant::now() + std::time::Duration::from_secs(10);
        while !stop.is_raised() && std::time::Instant::now() < patience {
            std::thread::yield_now();
        }
        assert!(stop.is_raised());
        assert_eq!(stop.exit_code(), None, "as Ctrl-C");
    }
}
