//! The serial line, and what is said on it.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::mem;
use std::os::unix::fs::OpenOptionsExt;

use afp_hardware::LastResort;
use rustix::fs::OFlags;
use rustix::termios::{OptionalActions, QueueSelector, isatty, tcflush, tcgetattr, tcsetattr};

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

/// What the board says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Said {
    pub way: [f64; 2],
    pub bumper: [bool; 2],
    pub drop: bool,
    pub dirt: f64,
    pub button: bool,
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
    }
    let ear = Ear { port: from, line: Vec::new(), at_beginning: false };
    Ok((Line { port: to, whole: false }, ear))
}

impl Line {
    /// Says lines. Where the line is broken or full, nothing can be said: the board stops, and what it does not say is
    /// noticed.
    pub fn say(&mut self, lines: &str) {
        // What was cut must not run into this, and a number that was cut is another number: no command ends with this.
        let text = if self.whole { lines.to_owned() } else { format!("?\n{lines}") };
        self.whole =
            matches!(self.port.write(text.as_bytes()), Ok(written) if written == text.len());
    }

    /// Says what must not wait behind anything that was said before.
    pub fn say_at_once(&mut self, lines: &str) {
        // Of a line that has no queue nothing waits.
        let _ = tcflush(&self.port, QueueSelector::OFlush);
        self.whole = false;
        self.say(lines);
    }

    /// Stops the board while whoever says lines may hang in the middle of one.
    pub fn last_resort(&self) -> Option<LastResort> {
        let mut line = Line { port: self.port.try_clone().ok()?, whole: false };
        Some(Box::new(move || line.say_at_once("stop\n")))
    }
}

impl Ear {
    /// What the board says next; what is cut or disturbed is passed over.
    ///
    /// # Errors
    /// [`WouldBlock`](io::ErrorKind::WouldBlock) where it has said nothing more yet; the line has ended.
    pub fn hear(&mut self) -> io::Result<Said> {
        loop {
            let room = LONGEST - self.line.len() as u64;
            if (&mut self.port).take(room).read_until(b'\n', &mut self.line)? == 0 {
                return Err(io::ErrorKind::UnexpectedEof.into());
            }
            let line = mem::take(&mut self.line);
            let (begins, ends) = (self.at_beginning, line.ends_with(b"\n"));
            self.at_beginning = ends;
            let text = std::str::from_utf8(&line).ok().filter(|_| begins && ends);
            if let Some(said) = text.and_then(Said::read) {
                return Ok(said);
            }
        }
    }
}

impl Said {
    /// What a line says; nothing where it is cut or disturbed.
    pub fn read(line: &str) -> Option<Said> {
        let words: Vec<_> = line.split_whitespace().collect();
        let [ahead, turned, left, right, drop, dirt, button] = words.try_into().ok()?;
        let number = |word: &str| word.parse::<f64>().ok().filter(|number| number.is_finite());
        let switch =
            |word: &str| ["0", "1"].iter().position(|known| *known == word).map(|at| at == 1);
        Some(Said {
            way: [number(ahead)?, number(turned)?],
            bumper: [switch(left)?, switch(right)?],
            drop: switch(drop)?,
            dirt: number(dirt).filter(|share| (0.0..=1.0).contains(share))?,
            button: switch(button)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_read_whole_or_not_at_all() {
        let said = Said::read("0.25 -1.5 1 0 0 0.3 1").unwrap();
        assert_eq!((said.way, said.bumper, said.drop), ([0.25, -1.5], [true, false], false));
        assert_eq!((said.dirt, said.button), (0.3, true));
        for line in [
            "",
            "0.25 -1.5 1 0 0 0.3",
            "0.25 -1.5 1 0 0 0.3 1 1",
            "a b c d e f g",
            "nan 0 0 0 0 0 0",
            // A switch that is neither is not open.
            "0 0 nan nan nan 0 nan",
            "0 0 -1 0 0 0 0",
            "0 0 0 0 0.4 0 0",
            "0 0 0 0 0 1.5 0",
        ] {
            assert_eq!(Said::read(line), None, "{line}");
        }
    }

    #[test]
    fn noise_costs_its_line_alone() {
        let folder = std::env::temp_dir().join(format!("vacuum-board-{}", std::process::id()));
        let noise = [b'7'; 3 * LONGEST as usize];
        let parts: [&[u8]; 7] = [
            // What was on its way when the port was opened.
            b"5 0 0 0 0 0 0\n",
            b"1 0 0 0 0 0 0\n",
            b"\xff 0 0 0 0 0 0\n",
            &noise,
            b" 0 0 0 0 0 0\n",
            b"2 0 0 0 0 0 0\n",
            b"3 0 0 0",
        ];
        std::fs::write(&folder, parts.concat()).unwrap();
        let (_, mut ear) = open(folder.to_str().unwrap(), 115_200).unwrap();
        let heard: Vec<_> =
            std::iter::from_fn(|| ear.hear().ok()).map(|said| said.way[0]).collect();
        std::fs::remove_file(&folder).unwrap();
        assert_eq!(heard, [1.0, 2.0]);
    }
}
