//! The sentences of pages in Markdown, and of comments, strings and names of tests in code.

use std::sync::LazyLock;

use regex::{Captures, Regex};

/// A sentence and its line, from 1.
type Sentence = (usize, String);

/// The sentences of a page: its paragraphs, items of lists, cells of tables and headings.
pub fn of_page(text: &str) -> Vec<Sentence> {
    let lines = text.lines().enumerate().map(|(at, line)| (at + 1, line));
    of_lines(lines)
}

/// The sentences of code in Rust, Python or TypeScript: comments, docstrings, names of tests and,
/// outside of the tests of Rust and Python, strings.
pub fn of_code(path: &str, text: &str) -> Vec<Sentence> {
    let in_tests = path.contains("/tests/");
    match path.rsplit('.').next() {
        Some("rs") => {
            let strings = if in_tests { Vec::new() } else { of_strings(text, slashes, &LITERAL) };
            [of_comments(text, slashes), names(text, &RUST_TEST), strings].concat()
        }
        Some("py" | "pyi") => {
            let text = docstrings_as_comments(text);
            let strings = if in_tests { Vec::new() } else { of_strings(&text, hash, &LITERAL) };
            [of_comments(&text, hash), names(&text, &PYTHON_TEST), strings].concat()
        }
        _ => [of_comments(text, stars), of_strings(text, stars, &TEMPLATE)].concat(),
    }
}

type Comment = fn(&str) -> Option<&str>;

fn of_comments(text: &str, comment: Comment) -> Vec<Sentence> {
    let mut found = Vec::new();
    let mut block: Vec<(usize, &str)> = Vec::new();
    for (at, line) in text.lines().enumerate() {
        match comment(line.trim()) {
            Some(words) => block.push((at + 1, words)),
            None => found.extend(of_lines(std::mem::take(&mut block).into_iter())),
        }
    }
    found.extend(of_lines(block.into_iter()));
    found
}

/// The names of tests as sentences.
fn names(text: &str, test: &Regex) -> Vec<Sentence> {
    let names = test.captures_iter(text).map(|test| test.get(1).unwrap());
    names.map(|name| (line_of(text, name.start()), name.as_str().replace('_', " "))).collect()
}

/// The sentences of string literals of more than two words.
fn of_strings(text: &str, comment: Comment, literal: &Regex) -> Vec<Sentence> {
    let code = |line: &str| if comment(line.trim()).is_some() { "\n" } else { line }.to_owned();
    let code: String = text.split_inclusive('\n').map(code).collect();
    let mut found = Vec::new();
    for literal in literal.find_iter(&code) {
        let words = literal.as_str().trim_matches(['"', '`', '>', '<', '/']);
        let words = CONTINUED.replace_all(words, "");
        let sentences = of_lines(std::iter::once((line_of(&code, literal.start()), &*words)));
        found.extend(sentences.into_iter().filter(|(_, text)| text.split(' ').count() > 2));
    }
    found
}

/// The line of a byte, from 1.
fn line_of(text: &str, at: usize) -> usize {
    text[..at].matches('\n').count() + 1
}

fn docstrings_as_comments(text: &str) -> String {
    let comment = |doc: &Captures<'_>| format!("# {}", doc[1].replace('\n', "\n# "));
    DOCSTRING.replace_all(text, comment).into_owned()
}

macro_rules! patterns {
    ($($(#[$doc:meta])* $name:ident = $pattern:expr;)*) => {
        $($(#[$doc])* static $name: LazyLock<Regex> =
            LazyLock::new(|| Regex::new($pattern).unwrap());)*
    };
}

patterns! {
    LITERAL = r#"'"'|"(?:[^"\\]|\\(?s:.))*""#;
    /// Strings, templates and the text of elements in TypeScript.
    TEMPLATE = r#""(?:[^"\\\n]|\\.)*"|`(?:[^`\\]|\\.)*`|>[^<>{}"`=;()]*[a-z][^<>{}"`=;()]*</"#;
    /// The end of a line inside a literal, with the indentation of the next line.
    CONTINUED = r"\\\n[ \n]*";
    RUST_TEST = r"#\[test\]\n(?: *#\[.*\n)* *fn ([a-z0-9_]+)";
    PYTHON_TEST = r"def test_([a-z0-9_]+)";
    DOCSTRING = r#"(?s)[rbfu]{0,2}"""(.*?)""""#;
}

fn slashes(line: &str) -> Option<&str> {
    let words = line.strip_prefix("//")?;
    let words = words.strip_prefix(['/', '!']).unwrap_or(words);
    Some(words.strip_prefix(' ').unwrap_or(words))
}

fn hash(line: &str) -> Option<&str> {
    line.strip_prefix('#').map(str::trim_start)
}

fn stars(line: &str) -> Option<&str> {
    let words = ["/**", "/*", "*/", "* "].iter().find_map(|sign| line.strip_prefix(sign));
    let words = words.or_else(|| (line == "*").then_some(""));
    words.map(|words| words.trim_end_matches("*/").trim()).or_else(|| slashes(line))
}

fn of_lines<'a>(lines: impl Iterator<Item = (usize, &'a str)>) -> Vec<Sentence> {
    let mut reader = Reader::default();
    for (at, line) in lines {
        reader.line(at, line);
    }
    reader.finish()
}

/// Collects paragraphs and splits them.
#[derive(Default)]
struct Reader {
    found: Vec<Sentence>,
    paragraph: String,
    start: usize,
    /// The text that ends a part without sentences.
    until: Option<&'static str>,
}

impl Reader {
    fn line(&mut self, at: usize, line: &str) {
        let words = line.trim();
        if let Some(end) = self.until {
            if words.starts_with(end) {
                self.until = None;
            }
            return;
        }
        let indented = line.starts_with("    ") && self.paragraph.is_empty();
        let skipped = if words.starts_with("```") {
            Some("```")
        } else {
            words.starts_with("<!-- list").then_some("<!-- end of list")
        };
        if skipped.is_some() || words.is_empty() || indented || words.starts_with("<!--") {
            self.until = skipped;
            self.end();
        } else if let Some(row) = words.strip_prefix('|') {
            self.end();
            for cell in without_code(row).split('|') {
                self.start(at, cell.trim());
                self.end();
            }
        } else if words.starts_with('#') {
            self.end();
            self.start(at, words.trim_start_matches('#').trim());
            self.end();
        } else if let Some(item) = words.strip_prefix("- ").or_else(|| numbered(words)) {
            self.end();
            self.start(at, item);
        } else if self.paragraph.is_empty() {
            self.start(at, words);
        } else {
            self.paragraph.push(' ');
            self.paragraph.push_str(words);
        }
    }

    fn start(&mut self, at: usize, words: &str) {
        self.start = at;
        words.clone_into(&mut self.paragraph);
    }

    /// Splits the paragraph. Links are their words, code is `X`.
    fn end(&mut self) {
        let text = without_links(&without_code(&self.paragraph)).replace(['[', ']', '*'], "");
        let mut rest = text.trim();
        while !rest.is_empty() {
            let (sentence, after) = split(rest);
            self.found.push((self.start, sentence.to_owned()));
            rest = after.trim_start();
        }
        self.paragraph.clear();
    }

    fn finish(mut self) -> Vec<Sentence> {
        self.end();
        self.found
    }
}

/// A text with `X` for each piece of code.
fn without_code(text: &str) -> String {
    let parts = text.split('`').enumerate();
    parts.map(|(at, part)| if at % 2 == 0 { part } else { "X" }).collect()
}

/// A text without the targets of its links.
fn without_links(text: &str) -> String {
    let mut parts = text.split("](");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |text, part| text + part.split_once(')').map_or(part, |(_, rest)| rest))
}

/// The text after `1. `.
fn numbered(words: &str) -> Option<&str> {
    let (number, item) = words.split_once(". ")?;
    number.bytes().all(|byte| byte.is_ascii_digit()).then_some(item)
}

/// The first sentence, and the text after it.
fn split(text: &str) -> (&str, &str) {
    let ends = text.match_indices(['.', '!', '?']).map(|(at, _)| at + 1);
    for end in ends {
        let after = &text[end..];
        let next = after.trim_start();
        if next.len() < after.len()
            && next.starts_with(|first: char| first.is_uppercase() || first == '"')
        {
            return (&text[..end], after);
        }
    }
    (text, "")
}

#[test]
fn pages_are_split_into_sentences() {
    let page = "# Head\n\nOne [link](a.md#b). Two\nlines, `code.` it.\n\n- An item.\n\n```afp\nno\n```\n\n| a | B `|`. C |\n|---|---|\n";
    let sentences: Vec<_> = of_page(page).into_iter().map(|(_, sentence)| sentence).collect();
    let wanted =
        ["Head", "One link.", "Two lines, X it.", "An item.", "a", "B X.", "C", "---", "---"];
    assert_eq!(sentences, wanted);
}

#[test]
fn comments_and_names_of_tests_are_read() {
    let rust = "//! A file.\n\n/// One.\n/// Two.\n#[test]\n#[ignore]\nfn it_holds() {\n    let x = 1; // not read\n}\n";
    let sentences: Vec<_> =
        of_code("src/x.rs", rust).into_iter().map(|(_, sentence)| sentence).collect();
    assert_eq!(sentences, ["A file.", "One.", "Two.", "it holds"]);
}

#[test]
fn strings_are_read() {
    let rust = "// Not \"a string\".\nlet a = \"It is \\\"so\\\".  Two \\\n    words more.\";\nlet b = ('\"', \"a b\");\n";
    let wanted = [(1, "Not \"a string\"."), (2, "It is \\\"so\\\"."), (2, "Two words more.")];
    assert_eq!(of_code("src/x.rs", rust), wanted.map(|(line, text)| (line, text.to_owned())));
    assert_eq!(of_code("a/tests/x.rs", rust).len(), 1);
}

#[test]
fn python_and_typescript_are_read() {
    let python = "# One.\ndef test_it_holds():\n    \"\"\"Two\n    lines.\"\"\"\n    a = \"three words here\"\n";
    let wanted = [(1, "One."), (3, "Two lines."), (2, "it holds"), (5, "three words here")];
    assert_eq!(of_code("a.py", python), wanted.map(|(line, text)| (line, text.to_owned())));
    let page =
        "/** One\n * two. */\ntest(\"three words here\", () => <b>Four plain words here</b>);\n";
    let wanted = [(1, "One two."), (3, "three words here"), (3, "Four plain words here")];
    assert_eq!(of_code("a.tsx", page), wanted.map(|(line, text)| (line, text.to_owned())));
}
