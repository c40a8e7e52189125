//! The sentences of pages in Markdown, and of comments, strings and names of tests in Rust.

use std::sync::LazyLock;

use regex::Regex;

/// A sentence and its line, from 1.
type Sentence = (usize, String);

/// The sentences of a page: its paragraphs, items of lists, cells of tables and headings.
pub fn of_page(text: &str) -> Vec<Sentence> {
    let lines = text.lines().enumerate().map(|(at, line)| (at + 1, line));
    of_lines(lines)
}

/// The sentences of comments, and the names of tests.
pub fn of_rust(text: &str) -> Vec<Sentence> {
    let mut found = Vec::new();
    let mut block: Vec<(usize, &str)> = Vec::new();
    let mut test = false;
    for (at, line) in text.lines().enumerate() {
        let line = line.trim();
        match comment(line) {
            Some(words) => block.push((at + 1, words)),
            None => found.extend(of_lines(std::mem::take(&mut block).into_iter())),
        }
        if let Some(name) = line.strip_prefix("fn ").filter(|_| test) {
            let name = name.split('(').next().unwrap_or_default();
            found.push((at + 1, name.replace('_', " ")));
        }
        test = line == "#[test]" || (test && line.starts_with("#["));
    }
    found.extend(of_lines(block.into_iter()));
    found
}

/// The sentences of string literals, without those of one or two words. A literal that spans lines
/// has the line of its beginning.
pub fn of_strings(text: &str) -> Vec<Sentence> {
    let code = without_comments(text);
    let mut found = Vec::new();
    for literal in LITERAL.find_iter(&code) {
        let line = code[..literal.start()].matches('\n').count() + 1;
        let words = CONTINUED.replace_all(literal.as_str().trim_matches('"'), "");
        let sentences = of_lines(std::iter::once((line, &*words)));
        found.extend(sentences.into_iter().filter(|(_, text)| text.split(' ').count() > 2));
    }
    found
}

/// A string literal.
static LITERAL: LazyLock<Regex> =
    LazyLock::new(|| Regex::new(r#"'"'|"(?:[^"\\]|\\(?s:.))*""#).unwrap());

/// The end of a line inside a literal, with the indentation of the next line.
static CONTINUED: LazyLock<Regex> = LazyLock::new(|| Regex::new(r"\\\n[ \n]*").unwrap());

fn without_comments(text: &str) -> String {
    let code = |line: &'_ str| if comment(line.trim()).is_some() { "" } else { line }.to_owned();
    text.lines().map(|line| code(line) + "\n").collect()
}

fn comment(line: &str) -> Option<&str> {
    let words = line.strip_prefix("//")?;
    let words = words.strip_prefix(['/', '!']).unwrap_or(words);
    Some(words.strip_prefix(' ').unwrap_or(words))
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
    let sentences: Vec<_> = of_rust(rust).into_iter().map(|(_, sentence)| sentence).collect();
    assert_eq!(sentences, ["A file.", "One.", "Two.", "it holds"]);
}

#[test]
fn strings_are_read() {
    let rust = "// \"not a string\"\nlet a = \"It is \\\"so\\\".  Two \\\n    words more.\";\nlet b = (\'\"\', \"a b\");\n";
    let sentences: Vec<_> = of_strings(rust).into_iter().collect();
    let wanted = [(2, "It is \\\"so\\\"."), (2, "Two words more.")];
    assert_eq!(sentences, wanted.map(|(line, text)| (line, text.to_owned())));
}
