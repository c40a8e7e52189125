//! A test rig instead of the pins: a program that imitates motors and sensors, behind a Unix
//! socket whose path takes the place of the chip's. The messages are lines of text.
//!
//! - `board`: this connection is the robot's; then `POWER POWER BEARING` for every step. The rig
//!   answers with `COUNT COUNT BUMPER BUTTON PING`: whether a switch is closed is 0 or 1; a ping is
//!   `-` before the next one is complete, `none` without an echo, or a distance in metres.
//! - `guard`: this connection is the enable line; then `1` or `0`.

use std::io::{self, BufRead, BufReader, Write};
use std::os::unix::net::UnixStream;
use std::time::Duration;

use afp_core::Instant;
use afp_drive::{Inputs, Outputs, Setup};

use super::{Board, Reckoned};
use crate::guard::EnableLine;

/// A rig that does not answer within this time is broken.
const PATIENCE: Duration = Duration::from_secs(1);

#[derive(Debug)]
pub(crate) struct Rig {
    stream: BufReader<UnixStream>,
    line: String,
    outputs: Outputs,
    /// The robot has no encoders.
    reckoned: Option<Reckoned>,
}

impl Rig {
    pub(crate) fn board(path: &str) -> io::Result<Self> {
        Rig::connect(path, "board\n")
    }

    pub(crate) fn without_encoders(path: &str, setup: &Setup) -> io::Result<Self> {
        Ok(Rig { reckoned: Some(Reckoned::new(setup)), ..Rig::board(path)? })
    }

    pub(crate) fn guard(path: &str) -> io::Result<Self> {
        Rig::connect(path, "guard\n")
    }

    fn connect(path: &str, role: &str) -> io::Result<Self> {
        let mut stream = UnixStream::connect(path)?;
        stream.set_read_timeout(Some(PATIENCE))?;
        stream.write_all(role.as_bytes())?;
        let (line, outputs) = (String::new(), Outputs::default());
        Ok(Rig { stream: BufReader::new(stream), line, outputs, reckoned: None })
    }

    fn write(&mut self, line: &str) -> io::Result<()> {
        self.stream.get_mut().write_all(line.as_bytes())
    }

    fn exchange(&mut self) -> io::Result<Inputs> {
        let Outputs { power: [left, right], bearing } = self.outputs;
        self.write(&format!("{left} {right} {bearing}\n"))?;
        self.line.clear();
        if self.stream.read_line(&mut self.line)? == 0 {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        inputs(&self.line).ok_or_else(|| io::Error::other("the rig sends another line"))
    }
}

/// The readings of a line.
fn inputs(line: &str) -> Option<Inputs> {
    let mut words = line.split_whitespace();
    let mut number = || words.next()?.parse::<i32>().ok();
    let counts = [number()?, number()?];
    let [bumper, button] = [number()? != 0, number()? != 0];
    let ping = match words.next()? {
        "-" => None,
        "none" => Some(None),
        distance => Some(Some(distance.parse().ok()?)),
    };
    Some(Inputs { counts, bumper, button, ping })
}

impl Board for Rig {
    fn read(&mut self, _: Instant) -> io::Result<Inputs> {
        let inputs = self.exchange()?;
        let reckoned = self.reckoned.map_or(inputs.counts, |reckoned| reckoned.counts());
        Ok(Inputs { counts: reckoned, ..inputs })
    }

    fn apply(&mut self, outputs: &Outputs) -> io::Result<()> {
        self.outputs = *outputs;
        if let Some(reckoned) = &mut self.reckoned {
            reckoned.add(outputs.power);
        }
        Ok(())
    }

    fn off(&mut self) {
        self.outputs.power = [0.0; 2];
        // A rig that is gone has nothing to stop.
        let _ = self.exchange();
    }
}

impl EnableLine for Rig {
    fn set(&mut self, on: bool) -> io::Result<()> {
        self.write(if on { "1\n" } else { "0\n" })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readings_are_read_and_other_lines_are_not() {
        let read = inputs("7 -9 1 0 0.5\n").unwrap();
        assert_eq!((read.counts, read.bumper, read.button), ([7, -9], true, false));
        assert_eq!(read.ping, Some(Some(0.5)));
        assert_eq!(inputs("0 0 0 0 -").unwrap().ping, None);
        assert_eq!(inputs("0 0 0 0 none").unwrap().ping, Some(None));
        for line in ["", "1 2 3", "a 0 0 0 -", "0 0 0 0 x"] {
            assert!(inputs(line).is_none(), "{line}");
        }
    }
}
