//! The width of text.
//!
//! A drawing uses the reader's sans-serif font, which is unknown here. The widths are those of the
//! widest common font, so that a text fits with every font.

/// Advance widths of the characters from space to tilde, in hundredths of the font size.
const REGULAR: [u8; 95] = [
    32, 40, 46, 84, 64, 95, 78, 28, 39, 39, 50, 84, 32, 36, 32, 34, 64, 64, 64, 64, 64, 64, 64, 64,
    64, 64, 34, 34, 84, 84, 84, 53, 100, 69, 69, 70, 77, 64, 58, 78, 76, 30, 30, 66, 56, 87, 75,
    79, 61, 79, 70, 64, 61, 74, 69, 99, 69, 61, 69, 39, 34, 39, 84, 50, 50, 62, 64, 55, 64, 62, 36,
    64, 64, 28, 28, 58, 28, 98, 64, 62, 64, 64, 42, 52, 40, 64, 60, 82, 60, 60, 53, 64, 34, 64, 84,
];

/// Maximum ratio between a bold and a regular text's width, for names.
const BOLD: f64 = 1.13;

/// Maximum length of a text in full, in characters; the tooltip has the rest.
const LONGEST: usize = 36;

/// The width of a text in pixels at a font size in pixels.
pub(super) fn width(text: &str, size: f64, bold: bool) -> f64 {
    let hundredths: u32 = text.chars().map(advance).sum();
    let plain = f64::from(hundredths) / 100.0 * size;
    if bold { plain * BOLD } else { plain }
}

/// The text, with an ellipsis if it is too long.
pub(super) fn shorten(text: &str) -> String {
    if text.chars().count() <= LONGEST {
        return text.to_owned();
    }
    text.chars().take(LONGEST - 1).chain(['…']).collect()
}

fn advance(character: char) -> u32 {
    let index = u32::from(character).checked_sub(32).and_then(|index| usize::try_from(index).ok());
    // Texts in entries may have any script; a full em covers ideographs too.
    u32::from(index.and_then(|index| REGULAR.get(index)).copied().unwrap_or(100))
}

#[cfg(test)]
mod tests {
    use super::{shorten, width};

    #[test]
    fn wide_letters_are_wider() {
        assert!(width("WWW", 12.0, false) > 2.5 * width("iii", 12.0, false));
        assert!(width("name", 12.0, true) > width("name", 12.0, false));
    }

    #[test]
    fn long_texts_are_cut_by_characters() {
        assert_eq!(shorten("walldist"), "walldist");
        let cut = shorten(&"ä".repeat(60));
        assert_eq!(cut.chars().count(), 36);
        assert!(cut.ends_with('…'));
    }
}
