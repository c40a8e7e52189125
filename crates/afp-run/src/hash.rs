//! A hash of a text, to tell versions of a plan apart.

use afp_types::TextHash;

/// The hash of a text, as 16 hexadecimal digits. Not secure.
pub fn hash(text: &str) -> String {
    TextHash::of(text).to_string()
}
