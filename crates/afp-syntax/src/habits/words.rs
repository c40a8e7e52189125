//! Words of other languages with our equivalents: keywords, ends, states, types and units.

/// Equivalents of our keywords in other languages, by the role of our keyword.
pub(crate) const WORDS: &[(&str, &[&str])] = &[
    (
        "plan",
        &[
            "tree",
            "node",
            "class",
            "machine",
            "statemachine",
            "state_machine",
            "chart",
            "module",
            "program",
            "mission",
            "process",
            "behaviortree",
            "behavior_tree",
            "programm",
            "ablauf",
            "programme",
        ],
    ),
    (
        "actor",
        &[
            "state",
            "action",
            "step",
            "node",
            "behavior",
            "behaviour",
            "task",
            "invoke",
            "activity",
            "action_client",
            "service",
            "acteur",
            "aktion",
            "aktor",
            "zustand",
            "etat",
            "estado",
            "accion",
            "leaf",
        ],
    ),
    (
        "supervise",
        &[
            "supervisor",
            "guard",
            "watch",
            "monitor",
            "condition",
            "trigger",
            "callback",
            "subscribe",
            "subscriber",
            "listener",
            "listen",
            "interrupt",
            "timer",
            "observe",
            "surveille",
            "surveiller",
            "beobachte",
            "ueberwache",
            "überwache",
            "ueberwachung",
            "waechter",
            "vigila",
        ],
    ),
    ("supervisor", &["supervise", "guard", "watch", "monitor"]),
    (
        "computation",
        &["choice", "decision", "junction", "compute", "calculation", "berechnung", "calcul"],
    ),
    ("in", &["input", "param", "parameter", "eingang", "eingabe", "entree", "entrada"]),
    ("out", &["output", "result", "ausgang", "ausgabe", "sortie", "salida"]),
    ("var", &["variable"]),
    ("const", &["constant", "static", "final", "konstante", "constante"]),
    ("subplan", &["sub", "subtree", "submachine", "composite"]),
    (
        "start",
        &[
            "begin", "initial", "first", "entry", "beginne", "anfang", "starte", "commence",
            "debut", "inicio",
        ],
    ),
    ("uses", &["use"]),
    ("needs", &["need", "requires"]),
    ("every", &["each", "period", "interval", "rate", "alle"]),
    ("deadline", &["within", "timeout"]),
    ("until", &["timeout", "duration", "stop_after", "limit"]),
    ("expect", &["assert", "require", "erwarte"]),
];

/// Words after `->` in other languages: for ends of plans, and for reactions to events.
pub const ENDS: &[(&str, &[&str])] = &[
    (
        "terminate",
        &[
            "stop",
            "end",
            "done",
            "finish",
            "finished",
            "exit",
            "quit",
            "halt",
            "success",
            "final",
            "cancel",
            "cancelled",
            "canceled",
            "ende",
            "fertig",
            "fin",
            "arreter",
        ],
    ),
    ("fail", &["error", "failure", "failed", "abort", "aborted", "panic"]),
];
pub const REACTIONS: &[(&str, &[&str])] = &[
    ("ignore", &["none", "nothing", "nop", "noop", "pass", "skip", "null", "nil"]),
    ("resume", &["continue", "proceed", "go_on", "goon", "carry_on"]),
];

/// Words for the element that was active before: `return` leads there.
pub const RETURNS: &[(&str, &[&str])] =
    &[("return", &["history", "hist", "h", "previous", "last", "pop"])];

/// How a plan continues with an interrupted element.
pub const RETURN: &str = "lead to an element; to pause one, lead an event to 'suspend pause', and an edge of 'pause' to 'return'";

/// States that are called otherwise elsewhere: the only state of an element, and its failure.
pub const STATES: &[(&str, &[&str])] = &[
    (
        "OK",
        &[
            "ok",
            "success",
            "succeeded",
            "successful",
            "done",
            "ondone",
            "onsuccess",
            "result",
            "finished",
            "complete",
            "completed",
            "reached",
            "arrived",
            "next",
            "then",
        ],
    ),
    ("Error", &["error", "failure", "failed", "fail", "onerror", "aborted", "abort", "rejected"]),
];

/// Types that are called otherwise elsewhere.
pub const TYPES: &[(&str, &[&str])] = &[
    ("bool", &["boolean", "logical", "wahrheitswert", "booleen"]),
    (
        "int",
        &[
            "integer", "ganzzahl", "entier", "long", "short", "uint", "int32", "int64", "uint8",
            "i32", "i64", "u8",
        ],
    ),
    (
        "float",
        &[
            "double", "real", "number", "float32", "float64", "f32", "f64", "percent", "ratio",
            "zahl", "nombre",
        ],
    ),
    ("string", &["str", "text", "char", "texte"]),
    ("length", &["distance", "meters", "meter", "strecke", "longueur"]),
    ("duration", &["time", "seconds", "second", "zeit", "dauer", "duree", "temps"]),
    ("angle", &["degrees", "radians", "heading", "winkel"]),
    ("speed", &["velocity", "geschwindigkeit", "vitesse"]),
    ("angular_speed", &["angular_velocity", "angularVelocity"]),
];

/// Units that the language does not have, as multiples of another unit.
const UNITS: &[(&[&str], f64, &str)] = &[
    (&["in", "inch", "inches"], 2.54, "cm"),
    (&["ft", "foot", "feet"], 30.48, "cm"),
    (&["yd", "yard", "yards"], 91.44, "cm"),
    (&["mi", "mile", "miles"], 1.609_344, "km"),
    (&["mph"], 0.447_04, "m/s"),
    (&["lb", "lbs", "pound", "pounds"], 0.453_592_37, "kg"),
    (&["rpm"], 6.0, "deg/s"),
    (&["rotation", "rotations", "turns", "rev", "revolutions", "umdrehungen"], 360.0, "deg"),
];

/// Words of other natural languages in the patterns of habits, each with the English word.
const ENGLISH: &[(&str, &[&str])] = &[
    ("if", &["wenn", "falls", "si"]),
    ("then", &["dann", "alors", "entonces"]),
    ("else", &["sonst", "ansonsten", "sinon", "sino"]),
    ("while", &["solange", "tantque", "mientras"]),
    ("until", &["bis", "jusqu"]),
    ("repeat", &["wiederhole", "repete", "repetir"]),
    ("times", &["mal", "fois", "veces"]),
    ("forever", &["immer", "endlos", "toujours"]),
    ("wait", &["warte", "attendre", "attends", "esperar", "espera"]),
    ("go", &["gehe", "fahre", "avance", "avanza"]),
    ("turn", &["drehe", "tourne", "gira"]),
    ("stop", &["stopp", "halte", "arrete"]),
    ("set", &["setze"]),
    ("say", &["sage", "dis"]),
    ("function", &["funktion", "fonction", "funcion"]),
];

/// Whether a word of a pattern has this spelling in another natural language.
pub(crate) fn is_foreign_for(english: &str, written: &str) -> bool {
    ENGLISH.iter().any(|(word, others)| *word == english && others.contains(&written))
}

/// The English word.
pub(crate) fn english(written: &str) -> Option<&'static str> {
    ENGLISH.iter().find(|(_, others)| others.contains(&written)).map(|(word, _)| *word)
}

/// Our word for one of another language, in any case of letters.
pub fn ours(words: &[(&'static str, &[&str])], name: &str) -> Option<&'static str> {
    let is_it = |others: &&[&str]| others.iter().any(|it| it.eq_ignore_ascii_case(name));
    words.iter().find(|(_, others)| is_it(others)).map(|(ours, _)| *ours)
}

/// A quantity of a foreign unit in one that the language has: `30.48 cm` for `12` and `in`.
pub(crate) fn converted(number: &str, unit: &str) -> Option<String> {
    let (_, factor, ours) = UNITS.iter().find(|(words, ..)| words.contains(&unit))?;
    // Fewer digits than a float has, so that no rounding is seen.
    let rounded: f64 = format!("{:.11e}", number.parse::<f64>().ok()? * factor).parse().ok()?;
    Some(format!("{rounded} {ours}"))
}
