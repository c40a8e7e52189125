//! The messages between the vacuum cleaner and its board, in frames of [`afp_wire`].
//!
//! The computer sends a [`Command`] whenever it changes, and every 20 ms. The board sends a [`Report`] every 20 ms. The board
//! obeys from [`Command::Start`] to [`Command::Stop`]. It also stops if the computer restarts, and, while a motor runs, after
//! [`COMMAND_TIMEOUT`](afp_wire::COMMAND_TIMEOUT) without a command.
//!
//! The crate is `no_std`, so that the board's program uses it, too.
#![no_std]
#![forbid(unsafe_code)]

use serde::{Deserialize, Serialize};

/// The version of the messages. Each change of a message needs a new one.
pub const VERSION: u16 = 1;

/// The longest frame, in bytes.
pub const LONGEST: usize = 64;

/// A message of the computer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Command {
    /// Drive and turn.
    Drive {
        /// Speed ahead in m/s.
        speed: f64,
        /// Turn rate in rad/s, counter-clockwise.
        turn: f64,
    },
    /// Switch the suction motor.
    Suck(bool),
    /// Stop, and obey no command before `Start`.
    Stop,
    /// Obey again.
    Start,
}

/// A message of the board.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// The counts of the wheels: metres ahead, radians turned.
    pub way: [f64; 2],
    /// Whether the left and the right switch of the bumper are pressed.
    pub bumper: [bool; 2],
    /// Whether there is no floor below the front edge.
    pub drop: bool,
    /// Share of dirt in the air of the nozzle, 0 to 1.
    pub dirt: f64,
    /// Whether the button is down.
    pub button: bool,
    /// Whether the board obeys no command before [`Command::Start`].
    pub stopped: bool,
}

impl Command {
    /// Whether its numbers are finite; a board rejects other commands.
    pub fn is_possible(&self) -> bool {
        match self {
            Command::Drive { speed, turn } => speed.is_finite() && turn.is_finite(),
            Command::Suck(_) | Command::Stop | Command::Start => true,
        }
    }
}

impl Report {
    /// Whether its numbers are finite and in their ranges; a computer rejects other reports.
    pub fn is_possible(&self) -> bool {
        self.way.iter().all(|way| way.is_finite()) && (0.0..=1.0).contains(&self.dirt)
    }
}

#[cfg(test)]
mod tests {
    use afp_wire::Sender;

    use super::*;

    #[test]
    fn every_message_fits_a_frame() {
        let numbers = [f64::MIN, f64::MAX];
        let report = Report { way: numbers, dirt: f64::MIN, ..Report::default() };
        let drive = Command::Drive { speed: numbers[0], turn: numbers[1] };
        let mut sender = Sender::new(u32::MAX, VERSION);
        let mut buffer = [0; LONGEST];
        assert!(sender.send(&report, &mut buffer).is_ok());
        assert!(sender.send(&drive, &mut buffer).is_ok_and(|frame| frame.len() <= 30));
    }

    #[test]
    fn impossible_numbers_are_rejected() {
        for number in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(!Command::Drive { speed: number, turn: 0.0 }.is_possible());
            assert!(!Command::Drive { speed: 0.0, turn: number }.is_possible());
            assert!(!Report { way: [0.0, number], ..Report::default() }.is_possible());
            assert!(!Report { dirt: number, ..Report::default() }.is_possible());
        }
        assert!(!Report { dirt: 1.5, ..Report::default() }.is_possible());
        assert!(Report::default().is_possible() && Command::Stop.is_possible());
    }
}
