//! The place of a mistake, as compilers show it.

use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Writes the place, the line and a mark under the bytes of `span`; `label` stands beside the mark.
///
/// A span that fits no text stands for its nearest place; of several lines the first is shown.
///
/// # Errors
/// Those of the formatter.
pub fn excerpt(
    f: &mut fmt::Formatter<'_>,
    path: &Path,
    text: &str,
    span: Range<usize>,
    label: &str,
) -> fmt::Result {
    let start = floor(text, span.start);
    let before = &text[..start];
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    let line = text[line_start..].lines().next().unwrap_or("");
    let end = floor(text, span.end).clamp(start, line_start + line.len().max(start - line_start));
    let number = before.matches('\n').count() + 1;
    let column = before[line_start..].chars().count() + 1;
    let marks = "^".repeat(text[start..end].chars().count().max(1));
    let gap = " ".repeat(number.to_string().len());
    // Tabs stay tabs, so that the mark stands where it belongs.
    let indent: String =
        before[line_start..].chars().map(|c| if c == '\t' { '\t' } else { ' ' }).collect();
    let path = shown(path);
    write!(f, "{gap}--> {}:{number}:{column}\n{gap} |\n", path.display())?;
    write!(f, "{number} | {}\n{gap} | {indent}{marks}", line.trim_end())?;
    if label.is_empty() { Ok(()) } else { write!(f, " help: {label}") }
}

/// A path as people name it who work in the current folder.
pub fn shown(path: &Path) -> PathBuf {
    let here = std::env::current_dir().ok();
    let below = here.and_then(|here| Some(path.strip_prefix(here).ok()?.to_owned()));
    below.unwrap_or_else(|| path.to_owned())
}

/// The character border at or before a byte.
fn floor(text: &str, byte: usize) -> usize {
    let mut byte = byte.min(text.len());
    while !text.is_char_boundary(byte) {
        byte -= 1;
    }
    byte
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Shown(&'static str, Range<usize>);

    impl fmt::Display for Shown {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            excerpt(f, Path::new("a.toml"), self.0, self.1.clone(), "write 'b'")
        }
    }

    #[test]
    fn the_mark_stands_under_the_text() {
        let shown = Shown("x = 1\nä = 'cd'\n", 11..15).to_string();
        let wanted = " --> a.toml:2:5\n  |\n2 | ä = 'cd'\n  |     ^^^^ help: write 'b'";
        assert_eq!(shown, wanted);
    }

    #[test]
    fn any_span_is_shown() {
        for text in ["", "a", "ä\n\nö", "\n"] {
            for start in 0..6 {
                for end in 0..6 {
                    assert!(Shown(text, start..end).to_string().contains("a.toml:"));
                }
            }
        }
    }
}
