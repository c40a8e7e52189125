//! One number for a whole trace, to tell two runs apart.

use core::fmt::{self, Write};

use super::{Line, Names, Record, Verdict};
use crate::time::Instant;

/// The FNV-1a hash of a trace as text, a [`Line`] for each record.
///
/// Polls that saw nothing do not count: how often they happen is no part of what a plan does. The same
/// plan, world and seed give the same hash in the interpreter and in generated code, on every machine,
/// however fast it runs.
///
/// It shows as 16 hexadecimal digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TraceHash(u64);

impl Default for TraceHash {
    fn default() -> Self {
        TraceHash(0xcbf2_9ce4_8422_2325)
    }
}

impl TraceHash {
    /// Takes a record.
    pub fn record<N: Names + ?Sized>(&mut self, at: Instant, record: &Record<'_>, names: &N) {
        if !matches!(record, Record::Polled { verdict: Verdict::Clear, .. }) {
            // Only a value's own text could fail, and none does.
            let _ = writeln!(self, "{}", Line { at, record, names });
        }
    }

    /// Takes a record whose [`Line`] is at hand.
    pub fn line(&mut self, line: &str) {
        // A hash takes any text.
        let _ = self.write_str(line);
        let _ = self.write_str("\n");
    }

    /// The hash so far.
    pub fn get(self) -> u64 {
        self.0
    }
}

impl Write for TraceHash {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let step = |hash: u64, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        self.0 = text.bytes().fold(self.0, step);
        Ok(())
    }
}

impl fmt::Display for TraceHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_hash_as_published() {
        let mut hash = TraceHash::default();
        assert_eq!(hash.get(), 0xcbf2_9ce4_8422_2325);
        let _ = hash.write_str("foobar");
        assert_eq!(hash.get(), 0x8594_4171_f739_67e8);
    }
}
