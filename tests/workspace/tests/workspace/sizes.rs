//! Files and functions stay short enough to read.

use std::fs;

use afp_workspace::root;

use crate::sources::rust_files;

const MOST_LINES: usize = 450;
/// The most lines of code in the body of a function. Arms of a `match` on one line do not count: a
/// long table is easy to read.
const MOST_IN_FUNCTION: usize = 60;

const FOLDERS: [&str; 7] = ["bench", "crates", "examples", "firmware", "fuzz", "tests", "xtask"];

/// The first lines and the lengths of the functions in a text. It is formatted, so a function ends
/// at the first brace with its indentation.
fn functions(text: &str) -> Vec<(&str, usize)> {
    let lines: Vec<&str> = text.lines().collect();
    let begins = lines.iter().enumerate().filter(|(_, line)| is_signature(line));
    let function = |(first, line): (usize, &&'_ str)| {
        let indent = &line[..line.len() - line.trim_start().len()];
        let is_at = |line: &str, what: &str| line.strip_prefix(indent) == Some(what);
        let rest = &lines[first..];
        let opening = rest.iter().position(|line| line.ends_with('{'))?;
        let closing = rest.iter().position(|line| is_at(line, "}"))?;
        let body = rest.get(opening + 1..closing)?;
        Some((lines[first].trim(), body.iter().filter(|line| counts(line)).count()))
    };
    begins.filter_map(function).collect()
}

fn is_signature(line: &str) -> bool {
    let words = line.split_whitespace().take_while(|word| *word != "fn");
    let before = words.clone().count();
    let qualifiers = ["pub", "const", "async", "unsafe", "extern", "default"];
    let all = words.into_iter().all(|word| {
        word.starts_with("pub(") || word.starts_with('"') || qualifiers.contains(&word)
    });
    all && line.split_whitespace().nth(before) == Some("fn") && !line.ends_with([';', '}'])
}

fn counts(line: &str) -> bool {
    let line = line.trim();
    let is_arm = (line.contains(" => ") && line.ends_with(',')) || line.starts_with("| ");
    !(line.is_empty() || line.starts_with("//") || is_arm)
}

#[test]
fn functions_are_counted() {
    let text = "
impl A {
    /// Does it.
    pub(crate) const fn long(
        &self,
    ) -> u8 {
        // why

        match self {
            A => 1,
            B => {
                2
            }
        }
    }

    fn short(&self) {}
}

unsafe fn last() {
    a();
}
";
    assert_eq!(functions(text), [("pub(crate) const fn long(", 5), ("unsafe fn last() {", 1)]);
}

#[test]
fn no_file_and_no_function_is_too_long() {
    let root = root();
    let files: Vec<_> = FOLDERS.iter().flat_map(|folder| rust_files(&root.join(folder))).collect();
    assert!(files.len() > 500, "{} files are not all", files.len());
    let mut long = Vec::new();
    for path in files {
        let text = fs::read_to_string(&path).unwrap();
        let name = path.strip_prefix(&root).unwrap().display();
        let lines = text.lines().count();
        if lines > MOST_LINES {
            long.push(format!("{name}: {lines} lines"));
        }
        let functions = functions(&text).into_iter().filter(|(_, lines)| *lines > MOST_IN_FUNCTION);
        long.extend(functions.map(|(first, lines)| format!("{name}: {lines} lines in '{first}'")));
    }
    assert!(long.is_empty(), "split at a seam:\n{}", long.join("\n"));
}
