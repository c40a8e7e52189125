//! The words that items begin with, and which of them was meant by another word.

use crate::diagnostics::words;
use crate::kind::Kind;

/// What items of a file begin with.
pub(crate) const TOP: &[&str] = &["use", "plan", "scenario", "enum", "table", "toolbox"];
/// What items of a toolbox begin with, besides.
pub(crate) const TOOLS: &[&str] =
    &["object", "device", "sensor", "robot", "actor", "supervisor", "computation"];
/// What items of a plan begin with.
pub(crate) const PLAN: &[&str] =
    &["in", "out", "var", "const", "start", "supervise", "actor", "computation", "subplan"];
/// What entries of a plan begin with.
pub(crate) const ENTRIES: &[&str] = &["in", "out", "var", "const"];
/// What elements of a plan begin with.
const ELEMENTS: &[&str] = &["actor", "computation", "subplan"];
/// What stands before a name and ':' in a plan.
pub(crate) const NAMED: &[&str] =
    &["in", "out", "var", "const", "supervise", "actor", "computation", "subplan"];
/// What parts of a template begin with.
pub(crate) const PARTS: &[&str] = &[
    "icon", "uses", "in", "out", "every", "deadline", "budget", "stop", "state", "states", "event",
];
/// What parts of a device begin with.
pub(crate) const DEVICE: &[&str] = &["press", "stop", "fault", "signal", "truth"];
/// What lines of a scenario begin with.
pub(crate) const LINES: &[&str] =
    &["world", "seed", "over", "set", "robot", "at", "from", "expect", "never", "until"];

/// Words that stand for ours elsewhere.
const USUAL: &[(&str, &[&str])] = &[
    ("actor", &["state", "action", "step", "node", "behavior", "behaviour", "task"]),
    ("supervise", &["supervisor", "guard", "watch", "monitor"]),
    ("supervisor", &["supervise", "guard", "watch", "monitor"]),
    ("in", &["input", "param", "parameter"]),
    ("out", &["output", "result"]),
    ("var", &["variable"]),
    ("const", &["constant", "static", "final"]),
    ("subplan", &["sub", "subtree", "submachine"]),
    ("start", &["begin", "initial", "first", "entry"]),
    ("uses", &["use"]),
    ("every", &["each", "period", "interval", "rate"]),
    ("deadline", &["within", "timeout"]),
    ("expect", &["assert", "require"]),
];

/// The word of a list that was meant: by one that says the same elsewhere, by a slip, or by its first letters.
pub(crate) fn meant<'a>(word: &str, list: &[&'a str]) -> Option<&'a str> {
    let is_usual = |ours: &str| {
        let mut usual = USUAL.iter().filter(|(known, _)| *known == ours);
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

/// The word that an item begins with: of a kind of which there are several, the one that was meant by what is written.
pub(crate) fn of_item(kind: Kind, written: &str) -> &str {
    let list: &[&'static str] = match kind {
        Kind::Entry => ENTRIES,
        Kind::Element => ELEMENTS,
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
    use super::{DEVICE, LINES, PARTS, PLAN, TOOLS, TOP, meant, of_item};
    use crate::kind::Kind;

    #[test]
    fn slips_and_words_of_elsewhere_are_told() {
        for (word, list, ours) in [
            ("strat", PLAN, Some("start")),
            ("input", PLAN, Some("in")),
            ("input", PARTS, Some("in")),
            ("guard", PLAN, Some("supervise")),
            ("guard", TOOLS, Some("supervisor")),
            ("use", PARTS, Some("uses")),
            ("falt", DEVICE, Some("fault")),
            ("expct", LINES, Some("expect")),
            ("toolbx", TOP, Some("toolbox")),
            ("comput", TOOLS, Some("computation")),
            ("s", TOOLS, None),
            ("banana", PLAN, None),
        ] {
            assert_eq!(meant(word, list), ours, "{word}");
        }
        assert_eq!(of_item(Kind::Entry, "input"), "in");
        assert_eq!(of_item(Kind::Element, "computaton"), "computation");
        assert_eq!(of_item(Kind::Plan, "pln"), "pln");
    }
}
