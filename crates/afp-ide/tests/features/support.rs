//! Cases: reading, compiling and comparing them.

use std::fs;
use std::path::{Path, PathBuf};

use afp_dsl::Toolboxes;
use afp_dsl::files::Texts;
use afp_dsl::{Compiled, compile};
use afp_ide::View;
use afp_syntax::source::{Source, Span};

const MARK: &str = "$0";
const ANSWERS: &str = "\n// Answers:\n";
const TOOLBOX: &str = "// toolbox\n";

/// A text with marked places.
pub struct Case {
    /// The text with its marks.
    pub written: String,
    pub compiled: Compiled,
    pub toolboxes: Toolboxes,
    pub file: u16,
    pub marks: Vec<u32>,
}

impl Case {
    /// Parses a case; its first line can declare a toolbox.
    pub fn new(written: &str) -> Case {
        let marks = written.match_indices(MARK).enumerate();
        let marks = marks.map(|(nth, (at, _))| (at - nth * MARK.len()) as u32).collect();
        let text = written.replace(MARK, "");
        let (first, files) = Texts::in_one(&text);
        let mut toolboxes: Toolboxes = afp_toolboxes::sources().collect();
        if written.starts_with(TOOLBOX) {
            toolboxes.add(Source::new("case.afp", first), "case");
            let compiled = compile(&Source::new("empty.afp", ""), &toolboxes, &files);
            let file = compiled.plan_files.start as u16 - 1;
            return Case { written: written.to_owned(), compiled, toolboxes, file, marks };
        }
        let compiled = compile(&Source::new("case.afp", first), &toolboxes, &files);
        let file = compiled.plan_files.start as u16;
        Case { written: written.to_owned(), compiled, toolboxes, file, marks }
    }

    /// The view of the file with the marks.
    pub fn view(&self) -> View<'_> {
        View::new(&self.compiled, &self.toolboxes, self.file)
    }

    /// A readable place: line and column, with the file name for other files.
    pub fn place(&self, span: Span) -> String {
        let source = self.compiled.sources.get(span.file).unwrap();
        let (line, column) = source.line_column(span.start);
        match span.file == self.file {
            true => format!("{line}:{column}"),
            // Built-in toolboxes change, so the place in them is omitted.
            false if usize::from(span.file) < self.compiled.plan_files.start => source.name.clone(),
            false => format!("{}:{line}:{column}", source.name),
        }
    }

    pub fn range(&self, span: Span) -> String {
        let source = self.compiled.sources.get(span.file).unwrap();
        let (line, column) = source.line_column(span.end);
        format!("{}-{line}:{column}", self.place(span))
    }
}

/// The cases of a feature with their paths, in order.
pub fn cases(folder: &str) -> Vec<(PathBuf, Case)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases").join(folder);
    let mut paths: Vec<_> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let read = |path: PathBuf| {
        let all = fs::read_to_string(&path).unwrap();
        let written = all.split(ANSWERS).next().unwrap();
        let case = Case::new(written);
        (path, case)
    };
    paths.into_iter().map(read).collect()
}

/// Compares a case with its expected answers, or rewrites it with `AFP_BLESS=1`. Returns the
/// difference.
pub fn compare(path: &Path, case: &Case, answers: &str) -> Option<String> {
    let answers: String = answers
        .lines()
        .map(|line| if line.is_empty() { "//\n".to_owned() } else { format!("//  {line}\n") })
        .collect();
    let actual = format!("{}{ANSWERS}{answers}", case.written);
    if fs::read_to_string(path).unwrap() == actual {
        return None;
    }
    if std::env::var_os("AFP_BLESS").is_some() {
        fs::write(path, actual).unwrap();
        return None;
    }
    Some(format!("--- {} is now\n{actual}", path.display()))
}
