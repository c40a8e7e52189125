//! The page of the built-in templates, generated from their toolbox files.

use std::fmt::Write;
use std::fs;

use afp_dsl::toolbox::{Template, TemplateKind};
use afp_syntax::source::{Sources, Span};

use crate::{compare, docs, toolboxes};

#[test]
fn every_built_in_template_is_described() {
    let toolboxes = toolboxes();
    let mut list = String::new();
    for toolbox in toolboxes.iter() {
        let _ = write!(list, "\n## {}\n\n{}\n", toolbox.name, sentence(&toolbox.doc));
        for template in &toolbox.templates {
            describe(template, toolboxes.sources(), &mut list);
        }
    }
    list.push('\n');
    let page = fs::read_to_string(docs().join("templates.md")).unwrap();
    compare("templates.md", &page, &super::with_list(&page, &list));
}

/// A heading, the help, and each port, state or event with its declaration and help.
fn describe(template: &Template, sources: &Sources, list: &mut String) {
    let kind = match template.kind {
        TemplateKind::Actor => "Actor",
        TemplateKind::Supervisor => "Supervisor",
        TemplateKind::Computation => "Computation",
    };
    let _ = write!(list, "\n### {}\n\n{kind}. {}", template.name, sentence(&template.doc));
    if !template.uses.is_empty() {
        let _ = write!(list, " Commands `{}`.", template.uses.join("` and `"));
    }
    if !template.needs.is_empty() {
        let _ = write!(list, " Needs `{}`.", template.needs.join("` and `"));
    }
    if template.resumable {
        list.push_str(match template.kind {
            TemplateKind::Supervisor => " Continues after a suspension.",
            _ => " Can be suspended.",
        });
    }
    let times = [("every", Some(template.every)), ("deadline", template.deadline)];
    if template.kind == TemplateKind::Supervisor {
        for (word, time) in times {
            let _ = write!(list, " `{word} {} ms`.", time.unwrap_or(template.every) / 1_000_000);
        }
    }
    list.push_str("\n\n");
    let inputs = template.inputs.iter().map(|port| (port.span, &port.doc));
    let outputs = template.outputs.iter().map(|port| (port.span, &port.doc));
    let outcomes = template.outcomes.iter().map(|outcome| (outcome.span, &outcome.doc));
    let states = template.states_of.iter().map(|states| (states.span, &states.doc));
    for (span, help) in inputs.chain(outputs).chain(outcomes).chain(states) {
        let _ = writeln!(list, "- `{}`: {}", line(span, sources), sentence(help));
    }
}

/// The line of a declaration with single spaces.
fn line(span: Span, sources: &Sources) -> String {
    let text = &sources.get(span.file).unwrap().text;
    let start = text[..span.start as usize].rfind('\n').map_or(0, |at| at + 1);
    let line = text[start..].lines().next().unwrap_or_default();
    line.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn sentence(help: &str) -> String {
    help.split_whitespace().collect::<Vec<_>>().join(" ")
}
