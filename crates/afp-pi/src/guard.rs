//! The guard: a process of its own that holds the enable line of the motors, for robots without a
//! second controller.
//!
//! The run sends a byte every 10 ms, and the guard returns it. The guard switches the motors off
//! and ends at the end of file, which follows every end of the run, and after [`SILENCE`] without a
//! byte. A run whose guard does not answer for [`SILENCE`] cuts the power itself and ends.

use std::io::{self, ErrorKind, Read, Write};
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;
use std::os::unix::process::CommandExt;
use std::process::{Child, Command, Stdio};

use afp_core::{Duration, Instant};

/// The longest silence of the run and of the guard.
pub const SILENCE: Duration = Duration::from_millis(100);

/// The enable line of the motors.
pub trait EnableLine {
    /// Switches the motors on or off.
    ///
    /// # Errors
    /// The line cannot be set.
    fn set(&mut self, on: bool) -> io::Result<()>;
}

impl EnableLine for Box<dyn EnableLine> {
    fn set(&mut self, on: bool) -> io::Result<()> {
        (**self).set(on)
    }
}

/// The end of a guard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guarded {
    /// The run has ended.
    Ended,
    /// The run was silent for [`SILENCE`].
    Silent,
}

/// Keeps the motors on as long as the run at the other end of the stream sends bytes. They are off
/// before and afterwards.
///
/// # Errors
/// The line cannot be set, or the stream fails. The line is switched off, if possible.
pub fn keep(mut run: UnixStream, line: &mut impl EnableLine) -> io::Result<Guarded> {
    let kept = enabled(&mut run, line);
    line.set(false)?;
    kept
}

fn enabled(run: &mut UnixStream, line: &mut impl EnableLine) -> io::Result<Guarded> {
    let mut bytes = [0; 64];
    let mut is_on = false;
    loop {
        // The run needs a while before its first byte.
        run.set_read_timeout(is_on.then_some(SILENCE.into()))?;
        let read = match run.read(&mut bytes) {
            Ok(0) => return Ok(Guarded::Ended),
            Ok(read) => read,
            Err(error) if error.kind() == ErrorKind::WouldBlock => return Ok(Guarded::Silent),
            Err(error) if error.kind() == ErrorKind::Interrupted => continue,
            Err(error) if error.kind() == ErrorKind::ConnectionReset => return Ok(Guarded::Ended),
            Err(error) => return Err(error),
        };
        if !is_on {
            line.set(true)?;
            is_on = true;
        }
        match run.write_all(bytes.get(..read).unwrap_or_default()) {
            Ok(()) => {}
            Err(error) if error.kind() == ErrorKind::BrokenPipe => return Ok(Guarded::Ended),
            Err(error) => return Err(error),
        }
    }
}

/// The stream of a guard's process: its standard input.
///
/// # Errors
/// Standard input is not a socket, because no run has started this process.
pub fn stream() -> io::Result<UnixStream> {
    use std::os::fd::AsFd;
    let run = UnixStream::from(io::stdin().as_fd().try_clone_to_owned()?);
    run.local_addr().map_err(|_| io::Error::other("a run starts the guard"))?;
    Ok(run)
}

/// The run's end of the stream.
#[derive(Debug)]
pub(crate) struct Guard {
    process: Child,
    stream: UnixStream,
    /// The time of its last answer; `None` before the first.
    answered: Option<Instant>,
}

impl Guard {
    /// Starts `afpc guard CHIP LINE`.
    pub(crate) fn start(chip: &str, line: &str) -> io::Result<Guard> {
        let (stream, theirs) = UnixStream::pair()?;
        stream.set_nonblocking(true)?;
        let program = program();
        let mut command = Command::new(&program);
        command.args(["guard", chip, line]);
        command.stdin(Stdio::from(OwnedFd::from(theirs))).stdout(Stdio::null());
        // Ctrl-C in the terminal of the run must not end it first.
        let process = command.process_group(0).spawn().map_err(|error| {
            io::Error::new(error.kind(), format!("cannot start '{program} guard': {error}"))
        })?;
        Ok(Guard { process, stream, answered: None })
    }

    /// Sends a byte; returns whether the guard is alive.
    pub(crate) fn beat(&mut self, now: Instant) -> bool {
        let mut bytes = [0; 64];
        let is_there = loop {
            match self.stream.read(&mut bytes) {
                Ok(0) => break false,
                Ok(_) => self.answered = Some(now),
                Err(error) => break error.kind() == ErrorKind::WouldBlock,
            }
        };
        let sent = self.stream.write(b".");
        let sent = sent.is_ok() || sent.is_err_and(|error| error.kind() == ErrorKind::WouldBlock);
        is_there && sent && self.answered.is_none_or(|at| now.since(at) < SILENCE)
    }

    /// Whether the guard has answered.
    pub(crate) fn is_ready(&self) -> bool {
        self.answered.is_some()
    }
}

impl Drop for Guard {
    fn drop(&mut self) {
        // The end of file switches the motors off.
        let _ = self.stream.shutdown(std::net::Shutdown::Both);
        let _ = self.process.wait();
    }
}

/// The program with the command `guard`: this one, or else `afpc` on the search path.
fn program() -> String {
    let own = std::env::current_exe().ok();
    let own = own.filter(|path| path.file_stem().is_some_and(|name| name == "afpc"));
    own.map_or("afpc".to_owned(), |path| path.display().to_string())
}

#[cfg(test)]
mod tests {
    use std::thread;

    use super::*;

    /// The states of a line, in order.
    #[derive(Default)]
    struct Fake(Vec<bool>);

    impl EnableLine for Fake {
        fn set(&mut self, on: bool) -> io::Result<()> {
            self.0.push(on);
            Ok(())
        }
    }

    fn guarded(run: impl FnOnce(UnixStream) + Send + 'static) -> (io::Result<Guarded>, Vec<bool>) {
        let (ours, theirs) = UnixStream::pair().unwrap();
        let run = thread::spawn(move || run(ours));
        let mut line = Fake::default();
        let kept = keep(theirs, &mut line);
        run.join().unwrap();
        (kept, line.0)
    }

    #[test]
    fn the_end_of_the_run_switches_the_motors_off() {
        let (kept, line) = guarded(|mut run| {
            run.write_all(b"..").unwrap();
            run.read_exact(&mut [0; 2]).unwrap();
        });
        assert_eq!((kept.unwrap(), line), (Guarded::Ended, vec![true, false]));
    }

    #[test]
    fn silence_switches_the_motors_off() {
        let (kept, line) = guarded(|mut run| {
            run.write_all(b".").unwrap();
            run.read_exact(&mut [0; 1]).unwrap();
            // The guard ends although the run is still there.
            assert_eq!(run.read(&mut [0; 1]).unwrap(), 0);
        });
        assert_eq!((kept.unwrap(), line), (Guarded::Silent, vec![true, false]));
    }

    #[test]
    fn motors_stay_off_without_a_run() {
        let (kept, line) = guarded(drop);
        assert_eq!((kept.unwrap(), line), (Guarded::Ended, vec![false]));
    }
}
