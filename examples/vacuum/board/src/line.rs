//! The serial line: what is said on it waits for nothing, and what is heard on it is whole.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::mem;
use std::os::unix::fs::OpenOptionsExt;

use afp_platform::LastResort;
use rustix::fs::OFlags;
use rustix::termios::{OptionalActions, QueueSelector, isatty, tcflush, tcgetattr, tcsetattr};
use vacuum_protocol::{Command, Report};

/// No line of the board's is longer, bytes.
const LONGEST: u64 = 200;

/// The way to the board. Saying something never waits: what the line does not take at once is lost.
pub struct Line {
    port: File,
    /// Whether the last thing was said to its end.
    whole: bool,
}

/// The way from the board.
pub struct Ear {
    port: BufReader<File>,
    /// What has come of a line.
    line: Vec<u8>,
    /// Whether that is its beginning.
    at_beginning: bool,
}

/// Opens a port for both ways, neither of which is waited for. A serial line gets that speed in baud, and nothing on it is edited
/// or sent back.
pub fn open(port: &str, baud: u32) -> io::Result<(Line, Ear)> {
    // It must not become the terminal that this process belongs to.
    let flags = (OFlags::NONBLOCK | OFlags::NOCTTY).bits() as i32;
    let to = File::options().read(true).write(true).custom_flags(flags).open(port)?;
    let from = BufReader::new(to.try_clone()?);
    if isatty(&to) {
        let mut modes = tcgetattr(&to)?;
        modes.make_raw();
        modes.set_speed(baud)?;
        tcsetattr(&to, OptionalActions::Now, &modes)?;
        // What the board said before is over.
        tcflush(&to, QueueSelector::IFlush)?;
    }
    let ear = Ear { port: from, line: Vec::new(), at_beginning: false };
    Ok((Line { port: to, whole: false }, ear))
}

impl Line {
    /// Says a line for each command. Where the line is broken or full, nothing can be said: the board stops, and what it does
    /// not say is noticed.
    pub fn say(&mut self, commands: &[Command]) {
        // What was cut must not run into this, and is no command any more: none ends with this.
        let mut text = if self.whole { String::new() } else { "?\n".to_owned() };
        text.extend(commands.iter().map(|command| vacuum_protocol::Line(command).to_string()));
        self.whole =
            matches!(self.port.write(text.as_bytes()), Ok(written) if written == text.len());
    }

    /// Says what must not wait behind anything that was said before.
    pub fn say_at_once(&mut self, commands: &[Command]) {
        // Of a line that has no queue nothing waits.
        let _ = tcflush(&self.port, QueueSelector::OFlush);
        self.whole = false;
        self.say(commands);
    }

    /// Stops the board while whoever says lines may hang in the middle of one.
    pub fn last_resort(&self) -> Option<LastResort> {
        let mut line = Line { port: self.port.try_clone().ok()?, whole: false };
        Some(Box::new(move || line.say_at_once(&[Command::Stop])))
    }
}

impl Ear {
    /// What the board says next; what is cut or disturbed is passed over.
    ///
    /// # Errors
    /// [`WouldBlock`](io::ErrorKind::WouldBlock) where it has said nothing more yet; the line has ended.
    pub fn hear(&mut self) -> io::Result<Report> {
        loop {
            let room = LONGEST - self.line.len() as u64;
            if (&mut self.port).take(room).read_until(b'\n', &mut self.line)? == 0 {
                return Err(io::ErrorKind::UnexpectedEof.into());
            }
            let line = mem::take(&mut self.line);
            let (begins, ends) = (self.at_beginning, line.ends_with(b"\n"));
            self.at_beginning = ends;
            let text = std::str::from_utf8(&line).ok().filter(|_| begins && ends);
            if let Some(report) = text.and_then(Report::read) {
                return Ok(report);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_costs_its_line_alone() {
        let folder = std::env::temp_dir().join(format!("vacuum-board-{}", std::process::id()));
        let says = |ahead| {
            let report = Report { way: [ahead, 0.0], ..Report::default() };
            vacuum_protocol::Line(report).to_string()
        };
        let (one, noise) = (says(1.0), "7".repeat(3 * LONGEST as usize));
        let (_, cut) = one.split_at(1);
        let text = [
            // What was on its way when the port was opened.
            &*says(5.0),
            &one,
            "\u{e9}",
            &one,
            // Its point is lost, so that it would be another number.
            &says(1.5).replace("1.5", "15"),
            &noise,
            cut,
            &says(2.0),
            says(3.0).trim_end(),
        ]
        .concat();
        std::fs::write(&folder, text).unwrap();
        let (_, mut ear) = open(folder.to_str().unwrap(), 115_200).unwrap();
        let heard: Vec<_> =
            std::iter::from_fn(|| ear.hear().ok()).map(|report| report.way[0]).collect();
        std::fs::remove_file(&folder).unwrap();
        assert_eq!(heard, [1.0, 2.0]);
    }
}
