//! Document addresses and file paths.
//!
//! A document has one path for every spelling of its address: `file:` addresses are
//! percent-decoded, others are used as paths that match no file.

use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, percent_decode_str, utf8_percent_encode};

use super::normalised;

const ESCAPED: &AsciiSet =
    &NON_ALPHANUMERIC.remove(b'/').remove(b'-').remove(b'_').remove(b'.').remove(b'~');

/// The path of an address.
pub fn path_of(uri: &str) -> String {
    let Some(rest) = uri.strip_prefix("file://") else { return uri.to_owned() };
    // The host is ignored: it is this machine.
    let rest = &rest[rest.find('/').unwrap_or(0)..];
    let path = percent_decode_str(rest).decode_utf8_lossy();
    // `/C:/x` is `C:/x` on Windows.
    let drive = path.as_bytes().get(2) == Some(&b':') && path.as_bytes()[1].is_ascii_alphabetic();
    normalised(if drive { &path[1..] } else { &path })
}

pub fn uri_of(path: &str) -> String {
    let is_address = path.split_once(':').is_some_and(|(scheme, _)| scheme.len() > 1);
    if is_address && !path.starts_with('/') {
        return path.to_owned();
    }
    let root = if path.starts_with('/') { "" } else { "/" };
    format!("file://{root}{}", utf8_percent_encode(path, ESCAPED))
}

#[cfg(test)]
mod tests {
    use super::{path_of, uri_of};

    #[test]
    fn paths_and_addresses_convert_in_both_directions() {
        for (address, expected, back) in [
            ("file:///a/b.afp", "/a/b.afp", "file:///a/b.afp"),
            ("file:///a%20b/%C3%A4.afp", "/a b/ä.afp", "file:///a%20b/%C3%A4.afp"),
            ("file:///c%3A/x.afp", "c:/x.afp", "file:///c%3A/x.afp"),
            ("file://localhost/a.afp", "/a.afp", "file:///a.afp"),
            ("file:///a/./b/../c.afp", "/a/c.afp", "file:///a/c.afp"),
            ("untitled:Untitled-1", "untitled:Untitled-1", "untitled:Untitled-1"),
            ("afp:/carbot.afp", "afp:/carbot.afp", "afp:/carbot.afp"),
            ("file:///100%", "/100%", "file:///100%25"),
        ] {
            assert_eq!(path_of(address), expected);
            assert_eq!(uri_of(expected), back);
        }
    }
}
