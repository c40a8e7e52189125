//! Generated junk: each token, bracket and item repeated. The work grows with the size of the text, and few errors are shown.

use crate::support;

use afp_counting::allocations;
use afp_dsl::Compiled;
use afp_syntax::diagnostics::Severity;

/// Tokens and words that are repeated.
const TOKENS: &[&str] = &[
    "a",
    "1",
    "1.5",
    "1 cm",
    "\"",
    "\"a\"",
    "(",
    ")",
    "{",
    "}",
    "[",
    "]",
    "@",
    ",",
    ":",
    ".",
    "=",
    "=>",
    "->",
    "+",
    "-",
    "*",
    "/",
    "%",
    "^",
    "|",
    "==",
    "<",
    ">=",
    "?",
    "!",
    "&&",
    ";",
    "#",
    "\u{201c}",
    "\u{e9}",
    "\u{2192}",
    "\u{202e}",
    "\u{2028}",
    "// x\n",
    "/*",
    "*/",
    "/// x\n",
    "\\",
    "~",
    "'",
    "plan",
    "actor",
    "computation",
    "subplan",
    "supervise",
    "start",
    "in",
    "var",
    "const",
    "use",
    "scenario",
    "enum",
    "table",
    "toolbox",
    "device",
    "object",
    "event",
    "state",
    "on",
    "every",
    "deadline",
    "from",
    "to",
    "terminate",
    "fail",
    "resume",
    "suspend",
    "return",
    "resumable",
    "true",
    "if",
    "else",
    "while",
    "for",
    "after",
    "expect",
    "never",
    "until",
    "at",
    "when",
    "as",
    "live",
    "forever",
    "robot",
    "set",
    "and",
    "if touch -> go",
    "n = n + 1",
    "wenn",
    "übel",
    "[*]",
    "robot.turn(90)",
    "on: { A: 'go' }",
    "<a b=\"c\"/>",
    "while n < 3:\n        go",
    "Done [n < 3] -> go",
    "state A if a < b {}",
];

/// Brackets and heads that are nested, with their ends.
const BRACKETS: &[(&str, &str)] = &[
    ("(", ")"),
    ("{", "}"),
    ("[", "]"),
    ("min(", ")"),
    ("-(", ")"),
    ("/*", "*/"),
    ("plan P {", "}"),
    ("actor a: Wait {", "}"),
    ("supervise s: CheckTimeout {", "}"),
    ("on s {", "}"),
    ("computation C {", "}"),
    ("scenario \"s\" for P {", "}"),
];

/// Items that are repeated.
const ITEMS: &[&str] = &[
    "use std",
    "enum E { a b }",
    "table t(x: int) { (1) (2) }",
    "plan P { start go actor go: Wait { Elapsed -> terminate } }",
    "scenario \"s\" for P { expect end by OK until 10 s }",
    "computation C { in a: int state A when a < 1 {} state B {} }",
    "const a = 1 m + 1 s",
    "actor go: Nothing { Elapsed -> nowhere }",
    "computation c: Assign(value = unknown, result => x) { Done -> c }",
    "supervise t: CheckTimeout { TimedOut -> terminate }",
];

/// A text that goes on until it has a size.
fn filled(piece: &str, size: usize) -> String {
    piece.repeat(size / piece.len() + 1)
}

/// Texts of about a size: each piece by itself, in a plan, in an element, in a formula and in a scenario.
fn shapes(size: usize) -> Vec<String> {
    const HEAD: &str = "use std\nplan P {\n    var x: int = 0\n    start go\n";
    const GO: &str = "    actor go: Wait { Elapsed -> terminate }\n}\n";
    let mut texts = Vec::new();
    let mut around = |piece: String| {
        texts.push(format!("{HEAD}{piece}\n{GO}"));
        texts.push(format!("{HEAD}actor a: Wait {{\n{piece}\n}}\n{GO}"));
        texts.push(format!("{HEAD}actor a: Wait(duration = {piece}) {{ }}\n{GO}"));
        texts.push(format!("{HEAD}{GO}scenario \"s\" for P {{\n{piece}\n}}\n"));
        texts.push(piece);
    };
    for piece in TOKENS.iter().chain(ITEMS) {
        around(filled(&format!("{piece}\n"), size));
        around(filled(&format!("{piece} "), size));
    }
    for (open, close) in BRACKETS {
        let depth = size / (open.len() + close.len()) + 1;
        around(open.repeat(depth) + &close.repeat(depth));
        around(filled(&format!("{open}\n"), size));
        around(filled(&format!("{close}\n"), size));
    }
    texts
}

/// A result, and the number of allocations that it took.
fn counted<T>(work: impl FnOnce() -> T) -> (T, u64) {
    let before = allocations();
    let result = work();
    (result, allocations() - before)
}

/// The errors that are shown, and all that are counted.
fn shown_and_counted(compiled: &Compiled) -> (usize, usize) {
    let shown = compiled.render(false);
    let shown = shown.lines().filter(|line| line.starts_with("error[")).count();
    let kept = compiled.diags.iter().filter(|each| each.severity != Severity::Error).count();
    (shown, compiled.diags.len() - kept)
}

#[test]
fn every_shape_of_junk_has_at_most_twenty_errors_and_a_count() {
    // A megabyte of each shape takes minutes.
    let size = if std::env::var_os("AFP_BY_NIGHT").is_some() { 1_000_000 } else { 4_000 };
    let (toolboxes, mut wrong) = (support::toolboxes(), Vec::new());
    for (small, text) in shapes(size / 4).into_iter().zip(shapes(size)) {
        let begin: String = text.chars().take(120).collect();
        let (_, few) = counted(|| support::compile(&small, &toolboxes));
        let (compiled, many) = counted(|| support::compile(&text, &toolboxes));
        // By the square it would be 16 times.
        if many >= 7 * few {
            wrong.push(format!("{few} and {many} allocations for four times of {begin}"));
        }
        let (shown, counted) = shown_and_counted(&compiled);
        assert!(shown <= 20, "{shown} errors are shown of {begin}");
        assert_eq!(shown, counted.min(20), "{counted} errors of {begin}");
        // Each error names a place of its own, and has at least a byte of it.
        assert!(counted <= text.len() + 20, "{counted} errors of {begin}");
        let kept = compiled.diags.iter().count();
        assert!(kept <= 25_000, "{kept} diagnostics are kept of {begin}");
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn errors_above_a_limit_are_only_counted() {
    let text = format!("plan P {{\n{}}}\n", "a\n".repeat(30_000));
    let compiled = support::compile(&text, &support::toolboxes());
    let (shown, counted) = shown_and_counted(&compiled);
    assert_eq!((shown, counted), (20, 30_000));
    assert!(compiled.diags.iter().count() < 10_100);
    assert!(compiled.render(false).ends_with("and 29,980 more errors"));
    let name = "ü ".repeat(30_000);
    let compiled = support::compile(&format!("plan P {{ {name} }}\n"), &support::toolboxes());
    let first = compiled.diags.iter().next().unwrap().message_text();
    assert!(first.ends_with("at 30,000 places"), "{first}");
}
