//! Hashes of files.

use std::fmt::Write;

use sha2::{Digest, Sha256};

/// The length of a hash in hexadecimal digits.
pub(crate) const DIGITS: usize = 64;

/// The SHA-256 of some bytes, in lower-case hexadecimal digits.
pub fn sha256(bytes: &[u8]) -> String {
    text(Sha256::new_with_prefix(bytes))
}

pub(crate) fn text(hasher: Sha256) -> String {
    hasher.finalize().iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

pub(crate) fn is_hash(text: &str) -> bool {
    text.len() == DIGITS && text.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'a'..=b'f'))
}
