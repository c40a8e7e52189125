//! The canonical form of a text: only the formatter determines white space.
//!
//! Names, numbers, comments and the order of items stay the same. A list on one line stays on one
//! line, and a list with a line break gets one line for each item, so that the author chooses which
//! bodies are short. Blank lines between items stay, at most one at a time.

mod align;
mod printer;
mod spacing;

use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::parse;

use printer::Printer;

/// The optional byte order mark at the start of a file.
const MARK: &str = "\u{feff}";

/// Returns the canonical form of a plan file or toolbox.
///
/// Formatting the result again changes nothing. Every comment is kept, in order, without trailing
/// spaces; commas between items are added or dropped to fit the list's form. All lines end like the
/// first one, and a byte order mark stays.
///
/// # Errors
/// The text has syntax errors, which prevent a layout: the diagnostics list them, with spans in
/// file 0. Errors of names, types or units do not matter here.
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

/// A text with `
/// n` line ends, converted to the line ends and byte order mark of another text.
fn lying_as(text: &str, formatted: &str) -> String {
    let mark = if text.starts_with(MARK) { MARK } else { "" };
    let first = text.split('\n').next().filter(|first| first.len() < text.len());
    let returns = first.is_some_and(|first| first.ends_with('\r'));
    let lines = if returns { formatted.replace('\n', "\r\n") } else { formatted.to_owned() };
    format!("{mark}{lines}")
}

#[cfg(test)]
mod tests;
