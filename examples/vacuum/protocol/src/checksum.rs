//! What tells a line that is whole from one that is cut or disturbed: `stop*7AC7`.
//!
//! The sum is Fletcher's of 16 bits (J. Fletcher, "An arithmetic checksum for serial transmissions", IEEE Transactions on
//! Communications 30 (1), 1982), of all that stands before the `*`, as four hexadecimal digits. Of a line of ASCII it notices each
//! byte that is lost, doubled or another one, and two neighbours that have changed places; of whatever else happens to a line,
//! all but one in 65,025.

use core::fmt::{self, Write};

/// A line of what displays as its words: with its checksum, and the end of the line.
#[derive(Clone, Copy, Debug)]
pub struct Line<T>(pub T);

impl<T: fmt::Display> fmt::Display for Line<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut summed = Summed { to: f, sum: Sum::default() };
        write!(summed, "{}", self.0)?;
        let sum = summed.sum.value();
        writeln!(f, "*{sum:04X}")
    }
}

/// The words of a line; nothing where its checksum is missing or another one.
pub fn text(line: &str) -> Option<&str> {
    let (text, digits) = line.trim_ascii_end().rsplit_once('*')?;
    let is_digit = |byte| matches!(byte, b'0'..=b'9' | b'A'..=b'F');
    if digits.len() != 4 || !digits.bytes().all(is_digit) {
        return None;
    }
    let mut sum = Sum::default();
    sum.add(text);
    (u16::from_str_radix(digits, 16) == Ok(sum.value())).then_some(text)
}

/// The sum of the bytes so far, and the sum of all such sums, modulo 255.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    bytes: u16,
    sums: u16,
}

impl Sum {
    fn add(&mut self, text: &str) {
        for byte in text.bytes() {
            self.bytes = (self.bytes + u16::from(byte)) % 255;
            self.sums = (self.sums + self.bytes) % 255;
        }
    }

    fn value(self) -> u16 {
        self.sums << 8 | self.bytes
    }
}

/// Passes a text on and sums it up.
struct Summed<'a, 'b> {
    to: &'a mut fmt::Formatter<'b>,
    sum: Sum,
}

impl Write for Summed<'_, '_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.sum.add(text);
        self.to.write_str(text)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::string::ToString;

    use super::*;

    #[test]
    fn sums_are_those_that_others_compute() {
        for (words, line) in [
            ("abcde", "abcde*C8F0\n"),
            ("abcdef", "abcdef*2057\n"),
            ("abcdefgh", "abcdefgh*0627\n"),
            ("", "*0000\n"),
        ] {
            assert_eq!(Line(words).to_string(), line);
            assert_eq!(text(line), Some(words));
        }
    }

    #[test]
    fn another_way_to_write_the_sum_is_none() {
        for line in ["abcde", "abcde*", "abcde*c8f0", "abcde*C8F", "abcde*C8F00", "abcdefgh*+627"] {
            assert_eq!(text(line), None, "{line}");
        }
        assert_eq!(text("abcde*C8F0\r\n"), Some("abcde"), "as terminals end their lines");
    }
}
