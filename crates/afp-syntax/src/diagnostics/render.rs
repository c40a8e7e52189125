//! Diagnostics for people, in the manner of rustc.

use std::ops::Range;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Renderer, Snippet};

use crate::diagnostics::{Diagnostic, Diagnostics, Severity};
use crate::source::{Source, Sources, Span};

impl Diagnostics {
    /// All diagnostics as text, one blank line between them, with terminal colours when asked.
    pub fn render(&self, sources: &Sources, colour: bool) -> String {
        let texts: Vec<_> = self.iter().map(|each| each.render(sources, colour)).collect();
        texts.join("\n\n")
    }
}

impl Diagnostic {
    /// The diagnostic as text without a final line break, with terminal colours when asked.
    pub fn render(&self, sources: &Sources, colour: bool) -> String {
        let title = level(self.severity).primary_title(&self.message).id(self.code.as_str());
        let mut group = Group::with_title(title);
        for (file, annotations) in self.by_file(sources) {
            group = group
                .element(Snippet::source(&file.text).path(&file.name).annotations(annotations));
        }
        let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
        renderer.decor_style(DecorStyle::Ascii).render(&[group]).to_string()
    }

    /// The places to show, the primary one first, grouped by file.
    fn by_file<'a>(&'a self, sources: &'a Sources) -> Vec<(&'a Source, Vec<Annotation<'a>>)> {
        let mut files: Vec<(u16, &Source, Vec<Annotation<'_>>)> = Vec::new();
        let mut add = |span: Span, kind: AnnotationKind, label: String| {
            let Some(source) = sources.get(span.file) else { return };
            let label = (!label.is_empty()).then_some(label);
            let annotation = kind.span(range(source, span)).label(label);
            match files.iter_mut().find(|(file, ..)| *file == span.file) {
                Some((.., annotations)) => annotations.push(annotation),
                None => files.push((span.file, source, vec![annotation])),
            }
        };
        let help = if self.help.is_empty() { "" } else { "help: " };
        add(self.span, AnnotationKind::Primary, format!("{help}{}", self.help));
        for note in &self.notes {
            add(note.span, AnnotationKind::Context, note.text.clone());
        }
        files.into_iter().map(|(_, source, annotations)| (source, annotations)).collect()
    }
}

fn level(severity: Severity) -> Level<'static> {
    match severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
        Severity::Note => Level::NOTE,
    }
}

/// The span as a range that surely lies in the text and on character borders.
fn range(source: &Source, span: Span) -> Range<usize> {
    let text = &source.text;
    let mut end = text.len().min(span.end as usize);
    let mut start = end.min(span.start as usize);
    while !text.is_char_boundary(start) {
        start -= 1;
    }
    while !text.is_char_boundary(end) {
        end += 1;
    }
    start..end
}
