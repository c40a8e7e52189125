//! Edits of texts, by their file.

use afp_ide::edit::TextEdit;
use afp_syntax::source::Source;

pub(crate) struct FileEdits {
    pub path: String,
    pub text: String,
    pub edits: Vec<TextEdit>,
}

pub(crate) fn by_file<'s>(
    source: impl Fn(u16) -> Option<&'s Source>,
    edits: Vec<TextEdit>,
) -> Vec<FileEdits> {
    let mut all: Vec<FileEdits> = Vec::new();
    for edit in edits {
        let Some(Source { name, text }) = source(edit.span.file) else { continue };
        match all.iter_mut().find(|file| file.path == *name) {
            Some(file) => file.edits.push(edit),
            None => {
                let (path, text) = (name.clone(), text.clone());
                all.push(FileEdits { path, text, edits: vec![edit] });
            }
        }
    }
    all
}
