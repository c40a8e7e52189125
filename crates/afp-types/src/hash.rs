//! Hashes of strings.

use core::fmt;

/// The 64-bit FNV-1a hash of a string (Fowler, Noll and Vo), or of the concatenation of several
/// strings. It is not cryptographic.
///
/// Displayed as 16 hexadecimal digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextHash(u64);

impl Default for TextHash {
    fn default() -> Self {
        TextHash(0xcbf2_9ce4_8422_2325)
    }
}

impl TextHash {
    /// The hash of one string.
    pub fn of(text: &str) -> Self {
        let mut hash = TextHash::default();
        hash.add(text);
        hash
    }

    /// Appends a string.
    pub fn add(&mut self, text: &str) {
        let step = |hash: u64, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        self.0 = text.bytes().fold(self.0, step);
    }

    /// The hash so far.
    pub fn get(self) -> u64 {
        self.0
    }
}

impl fmt::Display for TextHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::string::ToString;

    use super::TextHash;

    #[test]
    fn as_published() {
        assert_eq!(TextHash::of("").to_string(), "cbf29ce484222325");
        assert_eq!(TextHash::of("foobar").get(), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn the_hash_of_pieces_equals_the_hash_of_the_whole() {
        let mut hash = TextHash::of("foo");
        hash.add("bar");
        assert_eq!(hash, TextHash::of("foobar"));
    }
}
