//! The serial line. Writing never waits, and reading returns whole reports.

use std::fs::File;
use std::hash::{BuildHasher, RandomState};
use std::io::{self, BufReader, Read, Write};
use std::os::unix::fs::OpenOptionsExt;

use afp::Instant;
use afp_platform::{LastResort, RealTime, open_device, release_device};
use afp_wire::{Received, Receiver, Rejected, Sender};
use rustix::fs::OFlags;
use rustix::termios::{OptionalActions, QueueSelector, isatty, tcflush, tcgetattr, tcsetattr};
use vacuum_protocol::{Command, LONGEST, Report, VERSION};

/// The direction to the board. Writing never waits: bytes that the line does not take at once are lost.
pub struct Line {
    port: File,
    sender: Sender,
    /// Whether the last write was complete.
    whole: bool,
}

/// The direction from the board.
pub struct Ear {
    port: BufReader<File>,
    receiver: Receiver<LONGEST>,
}

/// A message of the board.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Heard {
    Report(Report, Instant),
    /// The board has restarted since the port was opened, so that it is in an unknown state.
    Restarted,
    /// The board uses a different version of the protocol.
    Version(u16),
}

/// Opens a port in both directions, without waiting, for only this program. A serial line gets the
/// speed in baud, and does not edit or echo.
pub fn open(port: &str, baud: u32) -> io::Result<(Line, Ear)> {
    // The port must not become the controlling terminal of this process.
    let flags = (OFlags::NONBLOCK | OFlags::NOCTTY).bits() as i32;
    let to = open_device(File::options().read(true).write(true).custom_flags(flags), port)?;
    let from = BufReader::new(to.try_clone()?);
    if isatty(&to) {
        let mut modes = tcgetattr(&to)?;
        modes.make_raw();
        modes.set_speed(baud)?;
        tcsetattr(&to, OptionalActions::Now, &modes)?;
        // Earlier reports do not count.
        tcflush(&to, QueueSelector::IFlush)?;
    }
    Ok((Line::new(to), Ear { port: from, receiver: Receiver::new(VERSION) }))
}

impl Line {
    fn new(port: File) -> Line {
        // The keys of a hasher are random, and differ at each call.
        let boot = RandomState::new().hash_one(std::process::id()) as u32;
        Line { port, sender: Sender::new(boot, VERSION), whole: false }
    }

    /// Begins a connection.
    pub fn hello(&mut self) {
        let mut buffer = [0; LONGEST];
        if let Ok(frame) = self.sender.hello(&mut buffer) {
            let bytes = frame.to_vec();
            self.write(&bytes);
        }
    }

    /// Sends commands. If the line is broken or full, nothing is sent: the board stops, and its silence is noticed.
    pub fn say(&mut self, commands: &[Command]) {
        let mut bytes = Vec::with_capacity(LONGEST * commands.len());
        let mut buffer = [0; LONGEST];
        for command in commands {
            bytes.extend(self.sender.send(command, &mut buffer).unwrap_or_default());
        }
        self.write(&bytes);
    }

    fn write(&mut self, frames: &[u8]) {
        // A frame that was cut ends here, damaged, and does not run into the next one.
        let end: &[u8] = if self.whole { &[] } else { &[0] };
        let bytes = [end, frames].concat();
        self.whole = matches!(self.port.write(&bytes), Ok(written) if written == bytes.len());
    }

    /// Sends commands before everything in the output queue.
    pub fn say_at_once(&mut self, commands: &[Command]) {
        // A line without a queue has nothing to discard.
        let _ = tcflush(&self.port, QueueSelector::OFlush);
        self.whole = false;
        self.say(commands);
    }

    /// Lets other programs open the port.
    pub fn release(&self) {
        release_device(&self.port);
    }

    /// Stops the board even if the sending thread hangs: a board stops on a different boot id of
    /// the computer.
    pub fn last_resort(&self) -> Option<LastResort> {
        let mut line = Line::new(self.port.try_clone().ok()?);
        Some(Box::new(move || {
            line.say_at_once(&[]);
            line.hello();
        }))
    }
}

impl Ear {
    /// Reads the board's next message. Damaged frames do not count.
    ///
    /// # Errors
    /// [`WouldBlock`](io::ErrorKind::WouldBlock) if there is nothing new;
    /// [`UnexpectedEof`](io::ErrorKind::UnexpectedEof) or another error if the line has ended.
    pub fn hear(&mut self, time: &RealTime) -> io::Result<Heard> {
        loop {
            let mut byte = [0];
            if self.port.read(&mut byte)? == 0 {
                return Err(io::ErrorKind::UnexpectedEof.into());
            }
            let now = time.now();
            match self.receiver.receive::<Report>(byte[0], now) {
                Some(Ok(Received::Message { message, .. })) if message.is_possible() => {
                    return Ok(Heard::Report(message, now));
                }
                Some(Err(Rejected::Restarted)) => return Ok(Heard::Restarted),
                Some(Err(Rejected::Version { theirs })) => return Ok(Heard::Version(theirs)),
                _ => {}
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_costs_only_the_frames_that_it_touches() {
        let path = std::env::temp_dir().join(format!("vacuum-board-{}", std::process::id()));
        let mut sender = Sender::new(1, VERSION);
        let hello = sender.hello(&mut [0; LONGEST]).unwrap().to_vec();
        let mut says = |ahead| {
            let report = Report { way: [ahead, 0.0], ..Report::default() };
            sender.send(&report, &mut [0; LONGEST]).unwrap().to_vec()
        };
        let cut = |frame: Vec<u8>| frame[..frame.len() / 2].to_vec();
        let bytes = [
            // A report from before the hello.
            says(5.0),
            hello,
            says(1.0),
            vec![7; 3 * LONGEST],
            says(6.0),
            cut(says(7.0)),
            says(8.0),
            says(2.0),
            says(f64::NAN),
            cut(says(3.0)),
        ];
        std::fs::write(&path, bytes.concat()).unwrap();
        let (_, mut ear) = open(path.to_str().unwrap(), 115_200).unwrap();
        let time = RealTime::start();
        let heard: Vec<_> = std::iter::from_fn(|| ear.hear(&time).ok()).collect();
        std::fs::remove_file(&path).unwrap();
        let ahead = |heard: &Heard| match heard {
            Heard::Report(report, _) => Some(report.way[0]),
            _ => None,
        };
        assert_eq!(heard.iter().map(ahead).collect::<Vec<_>>(), [Some(1.0), Some(2.0)]);
    }
}
