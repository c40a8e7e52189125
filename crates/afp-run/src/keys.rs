//! The Escape key of the terminal, which presses the stop control of the robot.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::Duration;

#[cfg(unix)]
pub(crate) use terminal::{Keys, give_back, without_terminal};

/// The watching thread looks at the keys this often.
const LOOK: Duration = Duration::from_millis(50);

/// The Escape key, watched by a thread, because the control thread of a real robot must not wait for a terminal.
pub(crate) struct KeyWatch {
    pressed: Arc<AtomicBool>,
    done: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl KeyWatch {
    /// Takes over standard input; `None` if it is not a terminal. The process is not suspended by a key.
    ///
    /// # Errors
    /// There is no thread for it.
    pub(crate) fn start() -> io::Result<Option<KeyWatch>> {
        let Some(keys) = Keys::take(false) else { return Ok(None) };
        let (pressed, done): (Arc<AtomicBool>, Arc<AtomicBool>) = Default::default();
        let (is_pressed, is_done) = (pressed.clone(), done.clone());
        let watch = move || {
            while !is_done.load(Ordering::Relaxed) {
                is_pressed.fetch_or(keys.escape_pressed(), Ordering::Relaxed);
                thread::park_timeout(LOOK);
            }
        };
        let thread = Some(thread::Builder::new().name("afp-keys".into()).spawn(watch)?);
        Ok(Some(KeyWatch { pressed, done, thread }))
    }

    /// Whether Escape was pressed since the last time.
    pub(crate) fn escape_pressed(&self) -> bool {
        self.pressed.swap(false, Ordering::Relaxed)
    }
}

impl Drop for KeyWatch {
    /// Waits for the thread, which gives the terminal back.
    fn drop(&mut self) {
        self.done.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            thread.thread().unpark();
            // It does not panic.
            let _ = thread.join();
        }
    }
}

#[cfg(unix)]
mod terminal {
    use std::io::{self, IsTerminal};
    use std::sync::{Mutex, MutexGuard, PoisonError};
    use std::thread;
    use std::time::Duration;

    use rustix::process::{Signal, getpgrp, kill_current_process_group};
    use rustix::termios::{
        LocalModes, OptionalActions, SpecialCodeIndex, Termios, tcgetattr, tcgetpgrp, tcsetattr,
    };

    const ESCAPE: u8 = 0x1b;
    /// A special code that disables the key.
    const NO_KEY: u8 = if cfg!(target_os = "linux") { 0 } else { 0xff };
    /// The greatest time between the signal and the suspension of the process.
    const FALLING_ASLEEP: Duration = Duration::from_millis(50);

    /// The settings of the terminal before it was taken; `None` while it is not taken. Global,
    /// because any thread that ends the process must restore them.
    static BEFORE: Mutex<Option<Termios>> = Mutex::new(None);

    /// Standard input without line editing and echo, while this value lives and the process is in
    /// the foreground.
    pub(crate) struct Keys {
        /// Whether the suspend key suspends the process; otherwise it counts as Escape.
        suspends: bool,
    }

    impl Keys {
        /// Takes standard input; `None` if it is not a terminal.
        pub(crate) fn take(suspends: bool) -> Option<Keys> {
            if !io::stdin().is_terminal() {
                return None;
            }
            take();
            Some(Keys { suspends })
        }

        /// Whether Escape was pressed since the last call. Blocks only if the suspend key was
        /// pressed.
        pub(crate) fn escape_pressed(&self) -> bool {
            let Some(suspend_key) = take() else { return false };
            let mut bytes = [0; 32];
            let Ok(read) = rustix::io::read(rustix::stdio::stdin(), &mut bytes) else {
                return false;
            };
            let typed = &bytes[..read];
            if suspend_key != NO_KEY && typed.contains(&suspend_key) {
                if !self.suspends {
                    return true;
                }
                suspend();
            }
            has_escape(typed, !self.suspends)
        }
    }

    /// Whether the input contains Escape. An Escape byte before another byte is part of an arrow
    /// key, a function key or Alt; with `anyhow` it counts too, because a stop of the robot must
    /// not be missed.
    fn has_escape(typed: &[u8], anyhow: bool) -> bool {
        let alone = |at: usize| typed.get(at + 1).is_none_or(|next| *next == ESCAPE);
        (0..typed.len()).any(|at| typed[at] == ESCAPE && (anyhow || alone(at)))
    }

    impl Drop for Keys {
        fn drop(&mut self) {
            give_back();
        }
    }

    /// Restores the terminal if it is taken.
    pub(crate) fn give_back() {
        without_terminal(|| ());
    }

    /// Restores the terminal if it is taken, and calls `act` before another thread can take it
    /// again.
    pub(crate) fn without_terminal(act: impl FnOnce()) {
        let mut taken = before();
        if let Some(before) = taken.take() {
            // If the terminal is gone, nothing can be done.
            let _ = tcsetattr(io::stdin(), OptionalActions::Now, &before);
        }
        act();
    }

    fn before() -> MutexGuard<'static, Option<Termios>> {
        BEFORE.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Takes the terminal unless it is taken; returns the suspend key. `None` in the background,
    /// where the terminal belongs to another process.
    fn take() -> Option<u8> {
        // A terminal that does not control this process has no background.
        let mut taken = before();
        if tcgetpgrp(io::stdin()).is_ok_and(|group| group != getpgrp()) {
            *taken = None;
            return None;
        }
        if taken.is_none() {
            let now = tcgetattr(io::stdin()).ok()?;
            let mut raw = now.clone();
            // Signals stay enabled for Ctrl-C. The process reads the suspend key itself, because it
            // must restore the terminal before it is suspended.
            raw.local_modes.remove(LocalModes::ICANON | LocalModes::ECHO);
            raw.special_codes[SpecialCodeIndex::VSUSP] = NO_KEY;
            raw.special_codes[SpecialCodeIndex::VMIN] = 0;
            raw.special_codes[SpecialCodeIndex::VTIME] = 0;
            tcsetattr(io::stdin(), OptionalActions::Now, &raw).ok()?;
            *taken = Some(now);
        }
        taken.as_ref().map(|before| before.special_codes[SpecialCodeIndex::VSUSP])
    }

    /// Suspends the process as the terminal would; returns when the process continues.
    fn suspend() {
        give_back();
        // The signal goes to the whole pipeline.
        let _ = kill_current_process_group(Signal::TSTP);
        thread::sleep(FALLING_ASLEEP);
    }

    #[cfg(test)]
    mod tests {
        use super::has_escape;

        #[test]
        fn escape_counts_among_other_keys_but_arrows_do_not() {
            for typed in [&b"\x1b"[..], b"\x1b\x1b", b"x\x1b", b"\x1b\x1b\x1b"] {
                assert!(has_escape(typed, false), "{typed:?}");
            }
            for typed in [&b""[..], b"x", b"\x1b[A", b"\x1bOP", b"\x1b[15~", b"\x1bx"] {
                assert!(!has_escape(typed, false), "{typed:?}");
                assert_eq!(has_escape(typed, true), typed.contains(&0x1b), "{typed:?}");
            }
        }
    }
}

/// This platform has no Escape key to read.
#[cfg(not(unix))]
pub(crate) struct Keys;

#[cfg(not(unix))]
impl Keys {
    pub(crate) fn take(_: bool) -> Option<Keys> {
        None
    }

    pub(crate) fn escape_pressed(&self) -> bool {
        false
    }
}
