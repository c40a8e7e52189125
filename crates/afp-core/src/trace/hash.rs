//! A hash of a whole trace, to compare runs.

use core::fmt::{self, Write};

use afp_types::{Instant, TextHash};

use super::{Line, Names, Record, Verdict};

/// The FNV-1a hash of a trace as text, a [`Line`] for each record.
///
/// Polls without a result are excluded, since their number does not affect the plan. The same plan,
/// world and seed give the same hash in the interpreter and in generated code, on every machine at
/// any speed.
///
/// Displayed as 16 hexadecimal digits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TraceHash(TextHash);

impl TraceHash {
    /// Adds a record.
    pub fn record<N: Names + ?Sized>(&mut self, at: Instant, record: &Record<'_>, names: &N) {
        if !matches!(record, Record::Polled { verdict: Verdict::Clear, .. }) {
            // Formatting values never fails.
            let _ = writeln!(self, "{}", Line { at, record, names });
        }
    }

    /// Adds a record whose [`Line`] is available.
    pub fn line(&mut self, line: &str) {
        self.0.add(line);
        self.0.add("\n");
    }

    /// The hash so far.
    pub fn get(self) -> u64 {
        self.0.get()
    }
}

impl Write for TraceHash {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.add(text);
        Ok(())
    }
}

impl fmt::Display for TraceHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
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
