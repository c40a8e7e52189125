//! The Escape key of the terminal as the robot's escape button.

#[cfg(unix)]
pub(crate) use terminal::Keys;

#[cfg(unix)]
mod terminal {
    use std::io::{self, IsTerminal};

    use rustix::termios::{
        LocalModes, OptionalActions, SpecialCodeIndex, Termios, tcgetattr, tcsetattr,
    };

    /// Standard input without line editing and echo, for as long as this lives.
    pub(crate) struct Keys {
        before: Termios,
    }

    impl Keys {
        /// Takes over standard input; `None` when it is no terminal.
        pub(crate) fn take() -> Option<Keys> {
            if !io::stdin().is_terminal() {
                return None;
            }
            let before = tcgetattr(io::stdin()).ok()?;
            let mut raw = before.clone();
            // Signals stay: Ctrl-C must go on working.
            raw.local_modes.remove(LocalModes::ICANON | LocalModes::ECHO);
            raw.special_codes[SpecialCodeIndex::VMIN] = 0;
            raw.special_codes[SpecialCodeIndex::VTIME] = 0;
            tcsetattr(io::stdin(), OptionalActions::Now, &raw).ok()?;
            Some(Keys { before })
        }

        /// Whether Escape was pressed since the last time; does not wait.
        pub(crate) fn escape_pressed(&self) -> bool {
            let mut bytes = [0; 32];
            match rustix::io::read(rustix::stdio::stdin(), &mut bytes) {
                // A longer text that begins with Escape is an arrow or function key.
                Ok(read) => read == 1 && bytes[0] == 0x1b,
                Err(_) => false,
            }
        }
    }

    impl Drop for Keys {
        fn drop(&mut self) {
            // Nothing can be done about a terminal that is gone.
            let _ = tcsetattr(io::stdin(), OptionalActions::Now, &self.before);
        }
    }
}

/// There is no Escape key to read on this platform.
#[cfg(not(unix))]
pub(crate) struct Keys;

#[cfg(not(unix))]
impl Keys {
    pub(crate) fn take() -> Option<Keys> {
        None
    }

    pub(crate) fn escape_pressed(&self) -> bool {
        false
    }
}
