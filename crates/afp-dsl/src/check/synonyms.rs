//! Words that other languages have for ours.

#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Leads {
    /// The start of the plan.
    Start,
    /// A state, or what is not known to be an event.
    Edge,
    Event,
}

/// Words that ends of plans have elsewhere, and ours.
const WORDS: &[(&str, &[&str])] = &[
    (
        "terminate",
        &["stop", "end", "done", "finish", "finished", "exit", "quit", "halt", "success", "return"],
    ),
    ("fail", &["error", "failure", "failed", "abort", "aborted", "panic"]),
];

/// Words that reactions to events have elsewhere, and ours.
const REACTIONS: &[(&str, &[&str])] = &[
    ("ignore", &["none", "nothing", "nop", "noop", "pass", "skip", "null", "nil"]),
    ("resume", &["continue", "proceed", "go_on", "goon", "carry_on"]),
];

/// Types that are called otherwise elsewhere, and ours.
const TYPES: &[(&str, &[&str])] = &[
    ("bool", &["boolean"]),
    ("int", &["integer", "long", "short", "uint", "int32", "int64", "uint8", "i32", "i64", "u8"]),
    (
        "float",
        &["double", "real", "number", "float32", "float64", "f32", "f64", "percent", "ratio"],
    ),
    ("string", &["str", "text", "char"]),
    ("length", &["distance", "meters", "meter"]),
    ("duration", &["time", "seconds", "second"]),
    ("angle", &["degrees", "radians", "heading"]),
    ("speed", &["velocity"]),
    ("angular_speed", &["angular_velocity", "angularVelocity"]),
];

/// The word behind `->` that was meant by a name.
pub(super) fn target(name: &str, leads: Leads) -> Option<&'static str> {
    let of_ends = ours(WORDS, name).filter(|_| leads != Leads::Start);
    of_ends.or_else(|| ours(REACTIONS, name).filter(|_| leads == Leads::Event))
}

/// The type that was meant by a name.
pub(super) fn ty(name: &str) -> Option<&'static str> {
    ours(TYPES, name)
}

fn ours(words: &[(&'static str, &[&str])], name: &str) -> Option<&'static str> {
    let found =
        words.iter().find(|(_, others)| others.iter().any(|it| it.eq_ignore_ascii_case(name)));
    found.map(|(ours, _)| *ours)
}
