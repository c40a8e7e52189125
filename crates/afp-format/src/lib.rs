//! The canonical form of a text: the formatter alone decides white space.
//!
//! Names, numbers, comments and the order of items stay as they are. A list that is written on one
//! line stays on it and a list with a line break in it gets one line for each item, so that the
//! author chooses which bodies are short; blank lines between items stay, at most one at a time.

mod align;
mod printer;
mod spacing;

use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::parse;

use printer::Printer;

/// What a file may begin with to say how it is encoded.
const MARK: &str = "\u{feff}";

/// Gives the canonical form of a plan file or toolbox.
///
/// Formatting the result again changes nothing. Every comment is kept, in order, without the
/// blanks at its end; commas between items are added or dropped as the list's form asks. All lines
/// end as the first one does, and a byte order mark stays.
///
/// # Errors
/// The text has syntax errors, since what is not understood cannot be laid out: the diagnostics
/// say which, with spans in file 0. Errors of names, types or units do not matter here.
pub fn format(text: &str) -> Result<String, Diagnostics> {
    let mut diags = Diagnostics::default();
    let parse = parse(text, 0, &mut diags);
    if diags.has_errors() {
        diags.sort();
        return Err(diags);
    }
    let lines = Printer::default().print(&parse.root());
    Ok(lying_as(text, &align::text(lines)))
}

/// A text with `\n` between lines as another one lies in its file.
fn lying_as(text: &str, formatted: &str) -> String {
    let mark = if text.starts_with(MARK) { MARK } else { "" };
    let first = text.split('\n').next().filter(|first| first.len() < text.len());
    let returns = first.is_some_and(|first| first.ends_with('\r'));
    let lines = if returns { formatted.replace('\n', "\r\n") } else { formatted.to_owned() };
    format!("{mark}{lines}")
}

#[cfg(test)]
mod tests;
