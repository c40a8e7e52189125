//! The grammars of editors highlight exactly the keywords of the parser and all units.
//! `AFP_BLESS=1` writes the lists of units.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::kind::Kind;
use afp_syntax::parse;
use afp_syntax::units::Unit;

/// Folders of files that together contain every keyword.
const FOLDERS: &[&str] = &[
    "plans",
    "plans/parts",
    "plans/tests",
    "crates/afp-toolboxes/toolboxes",
    "crates/afp-dsl/tests/graph",
    "crates/afp-dsl/tests/outline",
    "crates/afp-dsl/tests/errors",
    "crates/afp-dsl/tests/toolboxes",
];

/// Words with a meaning after an arrow, and names that need no declaration.
const NAMES: &[&str] = &[
    "terminate",
    "fail",
    "ignore",
    "resume",
    "return",
    "Error",
    "DeadlineMissed",
    "Interrupted",
    "OK",
    "true",
    "false",
];

/// Invalid actions in the cases: the parser accepts any name.
const ACTIONS_OF_NOBODY: &[&str] = &["hit"];

fn path(of: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(of)
}

/// The keywords in the files, except files with errors.
fn keywords() -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for folder in FOLDERS {
        for entry in fs::read_dir(path(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_none_or(|ending| ending != "afp") {
                continue;
            }
            let mut diags = Diagnostics::default();
            let tree = parse(&fs::read_to_string(&path).unwrap(), 0, &mut diags);
            // A misspelt word is read as a keyword.
            if diags.has_errors() {
                continue;
            }
            let tokens = tree.root().descendants_with_tokens().filter_map(|each| each.into_token());
            let words = tokens.filter(|token| token.kind() == Kind::Keyword);
            found.extend(words.map(|word| word.text().to_owned()));
        }
    }
    found.retain(|word| !ACTIONS_OF_NOBODY.contains(&word.as_str()));
    found
}

/// The words in the patterns of the editor's grammar, without units.
fn coloured() -> BTreeSet<String> {
    let text = fs::read_to_string(path("editors/vscode/syntaxes/afp.tmLanguage.json")).unwrap();
    let grammar: serde_json::Value = serde_json::from_str(&text).unwrap();
    let patterns = grammar["patterns"].as_array().unwrap().iter();
    let of_words = patterns.filter(|pattern| {
        let first = pattern["captures"]["1"]["name"].as_str();
        let name = pattern["name"].as_str().or(first).unwrap_or_default();
        name.starts_with("keyword.") && name != "keyword.operator.afp"
            || name == "constant.language.afp"
    });
    of_words.flat_map(|pattern| words(pattern["match"].as_str().unwrap_or_default())).collect()
}

/// The words of a pattern, without escapes and character classes.
fn words(pattern: &str) -> Vec<String> {
    let mut plain = String::new();
    let mut rest = pattern.chars();
    while let Some(next) = rest.next() {
        match next {
            '\\' => drop(rest.next()),
            '[' => drop(rest.by_ref().find(|each| *each == ']')),
            _ if next.is_ascii_alphabetic() => {
                plain.push(next);
                continue;
            }
            _ => {}
        }
        plain.push(' ');
    }
    plain.split_whitespace().map(str::to_owned).collect()
}

/// The strings in double quotes, line by line, except in comments.
fn quoted(text: &str, comment: &str) -> BTreeSet<String> {
    let code = text.lines().map(|line| line.split(comment).next().unwrap_or_default());
    code.flat_map(|line| line.split('"').skip(1).step_by(2)).map(str::to_owned).collect()
}

#[test]
fn visual_studio_code_highlights_every_word() {
    compare(&coloured(), NAMES);
}

#[test]
fn tree_sitter_has_every_word() {
    let text = fs::read_to_string(path("editors/tree-sitter-afp/queries/highlights.scm")).unwrap();
    let words = quoted(&text, ";").into_iter().filter(|word| word.starts_with(char::is_alphabetic));
    // There, truth values are a separate kind of node.
    let names: Vec<_> =
        NAMES.iter().copied().filter(|name| !["true", "false"].contains(name)).collect();
    compare(&words.collect(), &names);
}

#[test]
fn tree_sitter_has_every_unit() {
    let quoted: Vec<_> = Unit::symbols().map(|symbol| format!("\"{symbol}\"")).collect();
    let lines: Vec<_> =
        quoted.chunks(13).map(|line| format!("    {},\n", line.join(", "))).collect();
    let longest = Unit::symbols().map(str::len).max().unwrap();
    let wanted = format!("{}}};\n\n#define LONGEST {longest}\n", lines.concat());
    compare_part("editors/tree-sitter-afp/src/scanner.c", ("SINGLES[] = {\n", "\nstatic"), &wanted);
}

#[test]
fn visual_studio_code_highlights_every_unit() {
    let wanted = Unit::symbols().collect::<Vec<_>>().join("|");
    let around = (r"\\s*(", r")(?![A-Za-z_])");
    compare_part("editors/vscode/syntaxes/afp.tmLanguage.json", around, &wanted);
}

/// Compares the part of a file between two markers with the correct text; `AFP_BLESS=1` rewrites it
/// instead.
fn compare_part(file: &str, (before, behind): (&str, &str), wanted: &str) {
    let text = fs::read_to_string(path(file)).unwrap();
    let (head, rest) = text.split_once(before).unwrap();
    let (actual, tail) = rest.split_once(behind).unwrap();
    if actual != wanted && std::env::var_os("AFP_BLESS").is_some() {
        fs::write(path(file), format!("{head}{before}{wanted}{behind}{tail}")).unwrap();
        return;
    }
    assert_eq!(actual, wanted, "{file} is behind: 'AFP_BLESS=1' writes it");
}

/// Compares the highlighted words of an editor with the language's words, including names without a
/// declaration.
fn compare(coloured: &BTreeSet<String>, names: &[&str]) {
    let mut keywords = keywords();
    keywords.extend(names.iter().map(|name| (*name).to_owned()));
    let missing: Vec<_> = keywords.difference(coloured).collect();
    assert!(missing.is_empty(), "the editor's grammar does not know {missing:?}");
    let strange: Vec<_> = coloured.difference(&keywords).collect();
    assert!(strange.is_empty(), "the language has no {strange:?}");
}
