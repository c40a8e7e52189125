//! Invalid plans and toolboxes, with the expected diagnostics below their lines.
//!
//! `AFP_BLESS=1` rewrites the expectations; read the diff like code.

use crate::support;

use std::collections::BTreeSet;

use afp_dsl::Compiled;
use afp_syntax::diagnostics::{Code, Diagnostic, Severity};
use afp_syntax::source::Span;

const MARK: &str = "//~ ";

pub fn stripped(case: &str) -> String {
    let lines = case.split_inclusive('\n').filter(|line| !line.trim_start().starts_with("//~"));
    lines.collect()
}

/// Column and text of a place, with line and file if they differ from `here`.
fn place(compiled: &Compiled, span: Span, here: (&str, usize)) -> String {
    let source = compiled.sources.get(span.file).unwrap();
    let (line, column) = source.line_column(span.start);
    let text = compiled.sources.text(span);
    let first = text.lines().next().unwrap_or("");
    let more = if text.lines().count() > 1 { " ..." } else { "" };
    let plan_file = compiled.plan_sources().any(|each| each.name == source.name);
    match here {
        (file, own) if file == source.name && own == line => format!("{column} `{first}`{more}"),
        (file, _) if file == source.name => format!("{line}:{column} `{first}`{more}"),
        _ if plan_file => format!("{}:{line}:{column} `{first}`{more}", source.name),
        _ => format!("{} `{first}`{more}", source.name),
    }
}

fn expectation(compiled: &Compiled, diagnostic: &Diagnostic, here: (&str, usize)) -> String {
    let Diagnostic { code, severity, span, fix, .. } = diagnostic;
    let (message, help) = (diagnostic.message_text(), diagnostic.help_text());
    let shown = place(compiled, *span, here);
    let mut text = format!("{MARK}{}[{}] {shown}: {message}\n", severity.as_str(), code.as_str());
    for (span, note) in diagnostic.note_texts() {
        text += &format!("{MARK}  note {}: {note}\n", place(compiled, span, here));
    }
    text += &format!("{MARK}  help: {help}\n");
    if let Some(fix) = fix {
        let shown = place(compiled, fix.span, here);
        text += &format!("{MARK}  fix {shown}: {}\n", fix.text.escape_debug());
    }
    text
}

/// The case with the compiler's diagnostics.
fn annotated(text: &str, compiled: &Compiled) -> String {
    let mut result = String::new();
    let (mut file, mut number) = (support::CASE, 0);
    for line in text.split_inclusive('\n') {
        result += line;
        if let Some(next) = support::head(line) {
            (file, number) = (next, 0);
            continue;
        }
        number += 1;
        for diagnostic in compiled.diags.iter() {
            let source = compiled.sources.get(diagnostic.span.file).unwrap();
            if source.name == file && source.line_column(diagnostic.span.start).0 == number {
                result += &expectation(compiled, diagnostic, (file, number));
            }
        }
    }
    result
}

#[test]
fn every_case_has_its_diagnostics() {
    let toolboxes = support::toolboxes();
    let mut wrong = Vec::new();
    for path in support::files("tests/errors") {
        let case = support::read(&path);
        let text = stripped(&case);
        let compiled = support::compile(&text, &toolboxes);
        assert!(!compiled.diags.is_empty(), "{} expects nothing", path.display());
        let shown = annotated(&text, &compiled);
        let count = shown.lines().filter(|line| line.contains("[E")).count();
        assert!(count >= compiled.diags.len(), "{}: a diagnostic has no line", path.display());
        wrong.extend(support::compare(&path, &case, &shown));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_code_has_a_case() {
    let toolboxes = support::toolboxes();
    let mut seen = BTreeSet::new();
    for path in support::files("tests/errors") {
        let compiled = support::compile(&stripped(&support::read(&path)), &toolboxes);
        seen.extend(compiled.diags.iter().map(|diagnostic| diagnostic.code));
    }
    let missing: Vec<_> = Code::ALL.iter().filter(|code| !seen.contains(*code)).collect();
    assert!(missing.is_empty(), "no case for {missing:?}");
}

#[test]
fn a_fix_removes_its_error() {
    let toolboxes = support::toolboxes();
    for path in support::files("tests/errors") {
        let text = stripped(&support::read(&path));
        let compiled = support::compile(&text, &toolboxes);
        let has = |compiled: &Compiled, wanted: &Diagnostic| {
            compiled.diags.iter().any(|each| {
                (each.code, each.message(), each.span.file, each.span.start)
                    == (wanted.code, wanted.message(), wanted.span.file, wanted.span.start)
            })
        };
        for diagnostic in compiled.diags.iter() {
            let Some(fix) = &diagnostic.fix else { continue };
            let mut mended = text.clone();
            let name = &compiled.sources.get(fix.span.file).unwrap().name;
            let first = support::offset(&text, name);
            let range = first + fix.span.start as usize..first + fix.span.end as usize;
            mended.replace_range(range, &fix.text);
            let after = support::compile(&mended, &toolboxes);
            assert!(
                !has(&after, diagnostic),
                "{}: the fix of '{}' does not mend it:\n{mended}",
                path.display(),
                diagnostic.message_text(),
            );
        }
    }
}

#[test]
fn diagnostics_follow_the_style() {
    let toolboxes = support::toolboxes();
    for path in support::files("tests/errors") {
        let compiled = support::compile(&stripped(&support::read(&path)), &toolboxes);
        for diagnostic in compiled.diags.iter() {
            for text in [diagnostic.message_text(), diagnostic.help_text()] {
                let at = format!("{}: {text}", path.display());
                assert!(!text.is_empty(), "{at}");
                assert!(!text.starts_with(|first: char| first.is_uppercase()), "{at}");
                assert!(!text.ends_with('.') && !text.contains('`'), "{at}");
            }
            let rendered = diagnostic.render(&compiled.sources, false);
            let head = format!("{}[{}]: ", diagnostic.severity.as_str(), diagnostic.code.as_str());
            assert!(rendered.starts_with(&head), "{rendered}");
            assert!(rendered.contains("help: "), "{rendered}");
        }
    }
}

#[test]
fn a_graph_exists_exactly_without_errors() {
    let toolboxes = support::toolboxes();
    for path in support::files("tests/errors") {
        let text = stripped(&support::read(&path));
        let compiled = support::compile(&text, &toolboxes);
        if text.lines().any(|line| line.starts_with("toolbox ")) {
            continue;
        }
        let errors = compiled.diags.iter().any(|each| each.severity == Severity::Error);
        assert_eq!(compiled.graph.is_none(), errors, "{}", path.display());
    }
}
