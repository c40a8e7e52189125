//! The words of the grammar with their roles, and guesses for misspelt words.

use crate::diagnostics::words;
use crate::habits;
use crate::kind::Kind;

/// Roles of words of the grammar, one bit each.
pub(crate) type Roles = u16;

/// Begins an item of a file.
pub(crate) const TOP: Roles = 1;
/// Begins an item that only toolboxes have.
pub(crate) const TOOL: Roles = 1 << 1;
/// Begins an entry of a plan.
pub(crate) const ENTRY: Roles = 1 << 2;
/// Begins an element of a plan.
pub(crate) const ELEMENT: Roles = 1 << 3;
const START: Roles = 1 << 4;
pub(crate) const SUPERVISE: Roles = 1 << 5;
/// Begins a part of a template.
pub(crate) const PART: Roles = 1 << 6;
/// Begins a part of a device.
pub(crate) const DEVICE: Roles = 1 << 7;
/// Begins a line of a scenario.
pub(crate) const LINE: Roles = 1 << 8;
/// Begins the head of a body.
pub(crate) const HEAD: Roles = 1 << 9;
/// Begins a part of a body.
pub(crate) const BODY: Roles = 1 << 10;
/// May follow a number on its line and is not a misspelt unit.
pub(crate) const BEHIND_NUMBER: Roles = 1 << 11;
/// Precedes a name that is declared, so that another name can be chosen.
pub(crate) const DECLARES: Roles = 1 << 12;
/// Begins an item of a plan that has a name and a ':'.
pub(crate) const NAMED: Roles = ENTRY | ELEMENT | SUPERVISE;
/// Begins an item of a plan.
pub(crate) const PLAN: Roles = NAMED | START;

/// The keywords with their roles, in the order of help messages.
const WORDS: &[(&str, Roles)] = &[
    ("use", TOP | BEHIND_NUMBER),
    ("plan", TOP | HEAD | BEHIND_NUMBER | DECLARES),
    ("scenario", TOP | HEAD | BEHIND_NUMBER),
    ("enum", TOP | HEAD | BEHIND_NUMBER | DECLARES),
    ("table", TOP | HEAD | BEHIND_NUMBER | DECLARES),
    ("toolbox", TOP),
    ("icon", PART | BODY | BEHIND_NUMBER),
    ("uses", PART | BODY | BEHIND_NUMBER),
    ("needs", PART | BODY | BEHIND_NUMBER),
    ("in", ENTRY | PART | BODY | BEHIND_NUMBER | DECLARES),
    ("live", DECLARES),
    ("out", ENTRY | PART | BODY | BEHIND_NUMBER | DECLARES),
    ("var", ENTRY | BODY | BEHIND_NUMBER | DECLARES),
    ("const", ENTRY | BODY | BEHIND_NUMBER | DECLARES),
    ("start", START | BODY | BEHIND_NUMBER),
    ("supervise", SUPERVISE | HEAD | BODY | BEHIND_NUMBER | DECLARES),
    ("object", TOOL | BEHIND_NUMBER),
    ("device", TOOL | HEAD),
    ("sensor", TOOL | HEAD),
    ("world", LINE | BODY | BEHIND_NUMBER),
    ("seed", LINE | BODY | BEHIND_NUMBER),
    ("over", LINE | BEHIND_NUMBER),
    ("set", LINE | BODY | BEHIND_NUMBER),
    ("robot", TOOL | LINE | HEAD | BODY | BEHIND_NUMBER),
    ("actor", TOOL | ELEMENT | HEAD | BODY | BEHIND_NUMBER | DECLARES),
    ("supervisor", TOOL | HEAD | BEHIND_NUMBER),
    ("computation", TOOL | ELEMENT | HEAD | BODY | BEHIND_NUMBER | DECLARES),
    ("subplan", ELEMENT | HEAD | BODY | BEHIND_NUMBER | DECLARES),
    ("every", PART | BEHIND_NUMBER),
    ("deadline", PART | BEHIND_NUMBER),
    ("budget", PART | BEHIND_NUMBER),
    ("press", DEVICE | BODY),
    ("stop", PART | DEVICE | BEHIND_NUMBER),
    ("state", PART | BODY | BEHIND_NUMBER),
    ("states", PART),
    ("event", PART | BODY | BEHIND_NUMBER),
    ("exclusive", PART | BODY | BEHIND_NUMBER),
    ("fault", DEVICE | BODY),
    ("signal", DEVICE | BODY),
    ("truth", DEVICE | BODY),
    ("at", LINE | BODY | BEHIND_NUMBER),
    ("from", LINE | HEAD | BODY | BEHIND_NUMBER),
    ("expect", LINE | BODY | BEHIND_NUMBER),
    ("never", LINE | BODY | BEHIND_NUMBER),
    ("until", LINE | BODY | BEHIND_NUMBER),
    ("on", HEAD | BODY | BEHIND_NUMBER),
    ("after", BEHIND_NUMBER),
    ("always", BEHIND_NUMBER),
    ("before", BEHIND_NUMBER),
    ("by", BEHIND_NUMBER),
    ("for", BEHIND_NUMBER),
    ("heading", BEHIND_NUMBER),
    ("once", BEHIND_NUMBER),
    ("times", BEHIND_NUMBER),
    ("to", BEHIND_NUMBER),
    ("when", BEHIND_NUMBER),
    ("within", BEHIND_NUMBER),
];

/// The endings of a plan: the words after `end by`.
pub const ENDS: [&str; 3] = ["OK", "Interrupted", "Error"];

pub(crate) fn has(word: &str, roles: Roles) -> bool {
    WORDS.iter().any(|(known, own)| *known == word && own & roles != 0)
}

/// The words with one of these roles.
pub(crate) fn with(roles: Roles) -> Vec<&'static str> {
    let words = WORDS.iter().filter(|(_, own)| own & roles != 0);
    words.map(|(word, _)| *word).collect()
}

/// The intended word of a list: by a synonym, by a slip, or by its first letters.
pub(crate) fn meant<'a>(word: &str, list: &[&'a str]) -> Option<&'a str> {
    let is_usual = |ours: &str| {
        let mut usual = habits::WORDS.iter().filter(|(known, _)| *known == ours);
        usual.any(|(_, others)| others.contains(&word))
    };
    let known = list.iter().copied().find(|ours| is_usual(ours));
    known.or_else(|| words::nearest(word, list.iter().copied())).or_else(|| begun(word, list))
}

/// The only word of a list that begins with these letters.
fn begun<'a>(letters: &str, list: &[&'a str]) -> Option<&'a str> {
    let mut begun = list.iter().copied().filter(|word| word.starts_with(letters));
    let only = begun.next().filter(|_| begun.next().is_none());
    only.filter(|_| letters.len() > 2)
}

/// The word that begins an item. If there are several, the intended one.
pub(crate) fn of_item(kind: Kind, written: &str) -> &str {
    let list: &[&str] = match kind {
        Kind::Entry if has(written, ENTRY) => return written,
        Kind::Element if has(written, ELEMENT) => return written,
        Kind::Entry => &with(ENTRY),
        Kind::Element => &with(ELEMENT),
        Kind::Template => &["actor", "supervisor", "computation"],
        Kind::Device => &["device", "sensor", "robot"],
        Kind::Outcome => &["state", "event"],
        Kind::Timing => &["every", "deadline", "budget", "stop"],
        Kind::Press => &["press", "stop"],
        Kind::Signal => &["signal", "truth"],
        Kind::Expect => &["expect", "never"],
        _ => return written,
    };
    match list.contains(&written) {
        true => written,
        false => meant(written, list).unwrap_or(written),
    }
}

#[cfg(test)]
mod tests {
    use super::{DEVICE, LINE, PART, PLAN, TOOL, TOP, meant, of_item, with};
    use crate::kind::Kind;

    #[test]
    fn slips_and_words_of_other_languages_are_reported() {
        for (word, list, ours) in [
            ("strat", PLAN, Some("start")),
            ("input", PLAN, Some("in")),
            ("input", PART, Some("in")),
            ("guard", PLAN, Some("supervise")),
            ("guard", TOOL, Some("supervisor")),
            ("use", PART, Some("uses")),
            ("falt", DEVICE, Some("fault")),
            ("expct", LINE, Some("expect")),
            ("toolbx", TOP, Some("toolbox")),
            ("comput", TOOL, Some("computation")),
            ("s", TOOL, None),
            ("banana", PLAN, None),
        ] {
            assert_eq!(meant(word, &with(list)), ours, "{word}");
        }
        assert_eq!(of_item(Kind::Entry, "input"), "in");
        assert_eq!(of_item(Kind::Element, "computaton"), "computation");
        assert_eq!(of_item(Kind::Plan, "pln"), "pln");
    }
}
