//! A short name for a text: tells two versions of a plan apart.

use afp_types::TextHash;

/// The hash of a text, as 16 hexadecimal digits. Not for secrets.
pub fn hash(text: &str) -> String {
    TextHash::of(text).to_string()
}
