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

/// Gives the canonical form of a plan file or toolbox.
///
/// Formatting the result again changes nothing. Every comment is kept, in order, without the
/// blanks at its end; commas between items are added or dropped as the list's form asks.
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
    Ok(align::text(lines))
}

#[cfg(test)]
mod tests;
