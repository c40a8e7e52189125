//! What the vacuum cleaner and its board say to each other over their serial line.
//!
//! What is said is text, a line for each thing. To the board, [`Command`]: `drive SPEED TURN` in m/s and rad/s, `suck 0` or
//! `suck 1`, `stop`, after which it obeys nobody until it hears `start`, with which a run begins. From the board, fifty times a
//! second, [`Report`]: `AHEAD TURNED LEFT RIGHT DROP DIRT BUTTON STOPPED`, what the wheels have counted in m and rad, the
//! switches as 0 or 1, the dirt from 0 to 1, and whether it was told to stop and has not been told to start since.
//!
//! Each line ends in a [checksum](checksum). A line that is cut or disturbed says nothing: neither does one without its checksum, nor
//! one of which a word is none or a number no number.
//!
//! Without the standard library, since the board's own program uses it, too.
#![no_std]
#![forbid(unsafe_code)]

pub mod checksum;

use core::fmt;

pub use checksum::Line;

/// What the board is told. Displayed as its words; [`Line`] makes a line of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Command {
    /// To drive ahead at a speed in m/s and to turn at a rate in rad/s.
    Drive {
        /// The speed.
        speed: f64,
        /// The rate, counter-clockwise.
        turn: f64,
    },
    /// To switch the suction motor.
    Suck(bool),
    /// To stand, and to obey nobody until it is told to start.
    Stop,
    /// To obey again.
    Start,
}

/// What the board says. Displayed as its words; [`Line`] makes a line of them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Report {
    /// What the wheels have counted: m ahead, rad turned.
    pub way: [f64; 2],
    /// Whether the left and the right switch of the bumper are pressed.
    pub bumper: [bool; 2],
    /// Whether there is no floor.
    pub drop: bool,
    /// The dirt, 0 to 1.
    pub dirt: f64,
    /// Whether the button is down.
    pub button: bool,
    /// Whether it was told to stop and has not been told to start since.
    pub stopped: bool,
}

impl fmt::Display for Command {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Command::Drive { speed, turn } => write!(f, "drive {speed:.4} {turn:.4}"),
            Command::Suck(on) => write!(f, "suck {}", u8::from(*on)),
            Command::Stop => f.write_str("stop"),
            Command::Start => f.write_str("start"),
        }
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Report { way: [ahead, turned], dirt, .. } = self;
        let [left, right] = self.bumper.map(u8::from);
        let [drop, button, stopped] = [self.drop, self.button, self.stopped].map(u8::from);
        write!(f, "{ahead:.4} {turned:.4} {left} {right} {drop} {dirt:.2} {button} {stopped}")
    }
}

impl Command {
    /// What a line says; nothing where it is cut or disturbed.
    pub fn read(line: &str) -> Option<Command> {
        let mut words = checksum::text(line)?.split_ascii_whitespace();
        let command = match words.next()? {
            "drive" => Command::Drive { speed: number(words.next())?, turn: number(words.next())? },
            "suck" => Command::Suck(switch(words.next())?),
            "stop" => Command::Stop,
            "start" => Command::Start,
            _ => return None,
        };
        words.next().is_none().then_some(command)
    }
}

impl Report {
    /// What a line says; nothing where it is cut or disturbed.
    pub fn read(line: &str) -> Option<Report> {
        let mut words = checksum::text(line)?.split_ascii_whitespace();
        let report = Report {
            way: [number(words.next())?, number(words.next())?],
            bumper: [switch(words.next())?, switch(words.next())?],
            drop: switch(words.next())?,
            dirt: number(words.next()).filter(|share| (0.0..=1.0).contains(share))?,
            button: switch(words.next())?,
            stopped: switch(words.next())?,
        };
        words.next().is_none().then_some(report)
    }
}

fn number(word: Option<&str>) -> Option<f64> {
    word?.parse().ok().filter(|number: &f64| number.is_finite())
}

fn switch(word: Option<&str>) -> Option<bool> {
    match word? {
        "0" => Some(false),
        "1" => Some(true),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::string::{String, ToString};
    use std::vec::Vec;

    use super::*;

    const REPORT: Report = Report {
        way: [5.25, -1.5],
        bumper: [true, false],
        drop: false,
        dirt: 0.3,
        button: true,
        stopped: false,
    };

    fn commands() -> [Command; 5] {
        let drive = Command::Drive { speed: -0.15, turn: 0.0 };
        [drive, Command::Suck(true), Command::Suck(false), Command::Stop, Command::Start]
    }

    #[test]
    fn what_is_said_is_read() {
        for command in commands() {
            assert_eq!(Command::read(&Line(command).to_string()), Some(command));
        }
        assert_eq!(Report::read(&Line(REPORT).to_string()), Some(REPORT));
    }

    #[test]
    fn a_line_that_lost_a_byte_or_got_another_one_says_nothing() {
        let commands = commands().map(|command| Line(command).to_string());
        let lines = commands.into_iter().chain([Line(REPORT).to_string()]);
        for line in lines {
            let line = line.trim_end();
            for disturbed in disturbed(line).filter(|disturbed| disturbed != line) {
                assert_eq!(Command::read(&disturbed), None, "{line} as {disturbed}");
                assert_eq!(Report::read(&disturbed), None, "{line} as {disturbed}");
            }
        }
    }

    /// A line without one of its bytes, with one in the place of another, with one twice, and with two that changed places.
    fn disturbed(line: &str) -> impl Iterator<Item = String> {
        let bytes = line.as_bytes();
        (0..bytes.len()).flat_map(move |at| {
            let (before, [byte, after @ ..]) = bytes.split_at(at) else { return Vec::new() };
            let with = |middle: &[u8]| {
                String::from_utf8_lossy(&[before, middle, after].concat()).into_owned()
            };
            let mut all: Vec<_> = (0..=127).map(|other| with(&[other])).collect();
            all.extend([with(&[]), with(&[*byte, *byte])]);
            if let [next, rest @ ..] = after {
                let swapped = [before, &[*next, *byte], rest].concat();
                all.push(String::from_utf8_lossy(&swapped).into_owned());
            }
            all
        })
    }

    #[test]
    fn what_is_no_command_or_report_is_none() {
        let line = |text: &str| Line(text).to_string();
        for text in [
            "",
            "?",
            "drive 0.2",
            "drive inf 0",
            "drive 0 nan",
            "drive 0 0 0",
            "suck 2",
            "stop now",
        ] {
            assert_eq!(Command::read(&line(text)), None, "{text}");
        }
        for text in [
            "0.25 -1.5 1 0 0 0.3 1",
            "0.25 -1.5 1 0 0 0.3 1 0 0",
            "a b c d e f g h",
            "nan 0 0 0 0 0 0 0",
            // A switch that is neither is not open.
            "0 0 nan nan nan 0 nan nan",
            "0 0 -1 0 0 0 0 0",
            "0 0 0 0 0.4 0 0 0",
            "0 0 0 0 0 1.5 0 0",
        ] {
            assert_eq!(Report::read(&line(text)), None, "{text}");
        }
        assert_eq!((Command::read("stop"), Report::read("0 0 0 0 0 0 0 0")), (None, None));
    }
}
