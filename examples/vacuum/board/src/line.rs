//! The serial line, and what is said on it.

use std::fs::File;
use std::io::Write;

use afp_hardware::LastResort;

/// The way to the board.
pub struct Line(File);

/// What the board says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Said {
    pub way: [f64; 2],
    pub bumper: [bool; 2],
    pub drop: bool,
    pub dirt: f64,
    pub button: bool,
}

impl Line {
    pub fn new(file: File) -> Self {
        Line(file)
    }

    /// Says lines. Where the line is broken, nothing can be said: the board stops, and what it does not say is noticed.
    pub fn say(&mut self, lines: &str) {
        let _ = self.0.write_all(lines.as_bytes());
    }

    /// Stops the board while whoever says lines may hang in the middle of one.
    pub fn last_resort(&self) -> Option<LastResort> {
        let mut file = self.0.try_clone().ok()?;
        Some(Box::new(move || drop(file.write_all(b"\nstop\n"))))
    }
}

impl Said {
    /// What a line says; nothing where it is cut or disturbed.
    pub fn read(line: &str) -> Option<Said> {
        let words = line.split_whitespace().map(|word| word.parse::<f64>().ok());
        let words: Vec<_> = words.collect::<Option<_>>()?;
        let [ahead, turned, left, right, drop, dirt, button] = words.try_into().ok()?;
        let sound = [ahead, turned, dirt].into_iter().all(f64::is_finite);
        let [left, right, drop, button] = [left, right, drop, button].map(|switch| switch > 0.5);
        let said = Said { way: [ahead, turned], bumper: [left, right], drop, dirt, button };
        sound.then_some(said)
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
        ] {
            assert_eq!(Said::read(line), None, "{line}");
        }
    }
}
