//! Characters that make a text look different from its meaning.
//!
//! At some characters an editor breaks the line although the text continues. Others change the
//! order in which a line is shown, or are invisible. So code can hide in a comment. `\n` and `\r\n`
//! end lines everywhere.

use std::ops::Range;

/// The effect of a character in an editor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trick {
    /// Some editors show a line break.
    Break,
    /// Editors show the surrounding characters in another order.
    Order,
    /// Editors do not show it.
    Unseen,
}

/// Neighbouring characters with the same trick.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hidden {
    /// The place, in bytes.
    pub span: Range<usize>,
    pub trick: Trick,
    /// The first character, escaped.
    pub shown: String,
}

impl Hidden {
    /// The fault, for a sentence after its name.
    pub fn fault(&self) -> &'static str {
        match self.trick {
            Trick::Break => "is a line break in some editors, but not here",
            Trick::Order => "changes the order in which this line is shown",
            Trick::Unseen => "cannot be seen",
        }
    }
}

/// Finds all hidden characters, in order. A byte order mark at the start of a text is allowed.
pub fn hidden(text: &str) -> Vec<Hidden> {
    let mut found: Vec<Hidden> = Vec::new();
    // Nearly all texts end here. Each chunk is read as a whole, which takes a few instructions.
    let is_plain = |byte: &u8| matches!(byte, b' '..=b'~' | b'\t' | b'\n');
    let are_plain = |chunk: &[u8]| chunk.iter().fold(true, |all, byte| all & is_plain(byte));
    if text.as_bytes().chunks(64).all(are_plain) {
        return found;
    }
    let mut before = None;
    let mut rest = text.char_indices().peekable();
    while let Some((at, each)) = rest.next() {
        let is_end = each == '\r' && rest.peek().is_some_and(|(_, next)| *next == '\n');
        let trick = trick(each).filter(|_| !is_end && !belongs(each, before));
        let end = at + each.len_utf8();
        match (trick, found.last_mut()) {
            (Some(trick), Some(last)) if last.span.end == at && last.trick == trick => {
                last.span.end = end;
            }
            (Some(trick), _) => {
                let shown = each.escape_default().to_string();
                found.push(Hidden { span: at..end, trick, shown });
            }
            (None, _) => {}
        }
        before = Some(each);
    }
    found
}

/// The trick of a single character; `
/// r` only has one if no `
/// n` follows.
pub fn trick(each: char) -> Option<Trick> {
    Some(match each {
        '\t' | '\n' | ' '..='~' => return None,
        '\r' | '\x0b' | '\x0c' | '\x1c'..='\x1e' | '\u{85}' | '\u{2028}' | '\u{2029}' => {
            Trick::Break
        }
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => {
            Trick::Order
        }
        _ if each.is_control() => Trick::Unseen,
        // Unicode's `Default_Ignorable_Code_Point`: characters to show as nothing.
        '\u{ad}'
        | '\u{34f}'
        | '\u{115f}'
        | '\u{1160}'
        | '\u{17b4}'
        | '\u{17b5}'
        | '\u{180b}'..='\u{180f}'
        | '\u{200b}'..='\u{200d}'
        | '\u{2060}'..='\u{206f}'
        | '\u{3164}'
        | '\u{fe00}'..='\u{fe0f}'
        | '\u{feff}'
        | '\u{ffa0}'
        | '\u{fff0}'..='\u{fffb}'
        | '\u{1bca0}'..='\u{1bca3}'
        | '\u{1d173}'..='\u{1d17a}'
        | '\u{e0000}'..='\u{e0fff}' => Trick::Unseen,
        _ => return None,
    })
}

/// Whether a character belongs to the previous one: it joins letters or emoji, or selects an
/// emoji's style.
fn belongs(each: char, before: Option<char>) -> bool {
    let is_joiner = |each| matches!(each, '\u{200c}' | '\u{200d}');
    let selects = |each| matches!(each, '\u{fe00}'..='\u{fe0f}' | '\u{e0100}'..='\u{e01ef}');
    match before {
        None => each == '\u{feff}',
        Some(before) if is_joiner(each) => {
            !before.is_ascii() && (selects(before) || trick(before).is_none())
        }
        // Keycap emoji consist of digits.
        Some(before) => {
            let takes = !before.is_ascii() || matches!(before, '0'..='9' | '#' | '*');
            selects(each) && takes && trick(before).is_none()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Trick, hidden};

    #[test]
    fn each_hidden_character_is_found_at_its_place() {
        let breaks = "\r \x0b \x0c \x1c \u{85} \u{2028} \u{2029}";
        let orders = "\u{61c} \u{200e} \u{200f} \u{202a} \u{202e} \u{2066} \u{2069}";
        let unseen = "\0 \x1b \x7f \u{ad} \u{200b} \u{200c} \u{200d} \u{2060} \u{fe0f} \u{e0041}";
        let all = [(breaks, Trick::Break), (orders, Trick::Order), (unseen, Trick::Unseen)];
        for (text, trick) in all {
            let text = format!("a {text} b");
            let found = hidden(&text);
            assert_eq!(found.len(), text.split(' ').count() - 2, "{found:?}");
            for each in found {
                assert_eq!((each.trick, text[each.span].chars().count()), (trick, 1));
            }
        }
    }

    #[test]
    fn neighbours_are_found_together() {
        let found = hidden("ä\u{200b}\u{2060}\u{202e}\r\r\n");
        let spans: Vec<_> = found.iter().map(|each| each.span.clone()).collect();
        assert_eq!(spans, [2..8, 8..11, 11..12]);
        assert_eq!(found[2].shown, "\\r");
    }

    #[test]
    fn line_ends_and_parts_of_emoji_and_letters_hide_nothing() {
        let all = [
            "\u{feff}plan\r\n\t// grün → 20 °C\r\n",
            "❤\u{fe0f}\u{200d}🔥 👩\u{200d}🔧 1\u{fe0f}\u{20e3}",
            "می\u{200c}خواهم क्\u{200d}ष",
        ];
        for text in all {
            assert_eq!(hidden(text), []);
        }
    }
}
