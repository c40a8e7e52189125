//! The value of a string in double quotes.

use crate::ast::Name;
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::message;

/// The text without quotes and with its escapes resolved; reports unknown escapes.
///
/// Escapes are `\"`, `\\`, `\n` and `\t`.
pub fn unquote(quoted: &Name, diags: &mut Diagnostics) -> String {
    let inner = quoted.text.strip_prefix('"').unwrap_or(&quoted.text);
    let mut text = String::with_capacity(inner.len());
    let mut rest = inner.char_indices();
    while let Some((place, each)) = rest.next() {
        match each {
            '"' => break,
            '\\' => match rest.next() {
                Some((_, '"')) => text.push('"'),
                Some((_, '\\')) => text.push('\\'),
                Some((_, 'n')) => text.push('\n'),
                Some((_, 't')) => text.push('\t'),
                Some((_, other)) => {
                    let mut span = quoted.span;
                    span.start += u32::try_from(place + 1).unwrap_or(0);
                    span.end = span.start + 1 + u32::try_from(other.len_utf8()).unwrap_or(0);
                    diags.push(
                        Diagnostic::new(
                            Code::E0104,
                            span,
                            message!("unknown escape '\\{}'", other),
                        )
                        .help(message!("write '\\\\{}' for a backslash", other))
                        .replace(format!("\\\\{other}")),
                    );
                }
                None => break,
            },
            other => text.push(other),
        }
    }
    text
}
