//! Renaming and formatting.

use afp_draw::layout_file::Layout;
use afp_dsl::files::normalised;
use afp_dsl::index::{DefinitionId, DefinitionKind};
use afp_dsl::outline::Part;
use afp_ide::edit::{Change, difference, follow, used_files};
use afp_syntax::source::{Source, Span};
use gen_lsp_types as lsp;
use serde_json::{Value, json};

use crate::answer::{Answer, Failure, ok};
use crate::convert::{Places, text_edit};
use crate::file_edits::{FileEdits, by_file};
use crate::server::Server;
use crate::uri;
use crate::workspace::Analysis;

pub(crate) fn prepare_rename(server: &mut Server, params: lsp::PrepareRenameParams) -> Answer {
    let (analysis, offset) = server.at(&params.text_document_position_params)?;
    renamed(&analysis, offset, String::new())?;
    let name = analysis.compiled.index.at(analysis.file, offset).ok_or(Failure::Nothing)?;
    let placeholder = analysis.compiled.sources.text(name.span);
    ok(json!({ "range": server.places(&analysis).range(name.span), "placeholder": placeholder }))
}

/// Returns the change that renames the definition at a byte offset, and the path of the file with
/// that definition.
fn renamed(analysis: &Analysis, offset: u32, to: String) -> Result<(Change, String), Failure> {
    let index = &analysis.compiled.index;
    let refused = |reason: &str| Failure::Refused(reason.to_owned());
    let name = index.at(analysis.file, offset).ok_or_else(|| refused("there is no name here"))?;
    let id = name.meaning.definition().ok_or_else(|| refused("nothing declares this name"))?;
    let definition = index.definition(id);
    if usize::from(definition.name.file) < analysis.compiled.plan_files.start {
        return Err(refused("a toolbox declares this name, and Rust code uses it"));
    }
    let source = analysis.compiled.sources.get(definition.name.file);
    let path = source.map(|source| source.name.clone()).unwrap_or_default();
    let change = change(analysis, id, to);
    Ok((change.ok_or_else(|| refused("this name cannot be changed here"))?, path))
}

fn change(analysis: &Analysis, id: DefinitionId, to: String) -> Option<Change> {
    let (index, sources) = (&analysis.compiled.index, &analysis.compiled.sources);
    let definition = index.definition(id);
    let Span { file, start, .. } = definition.name;
    match definition.kind {
        DefinitionKind::Column | DefinitionKind::Value => {
            let text = |span| sources.text(span).to_owned();
            let owner = text(index.definition(definition.owner?).name);
            let name = text(definition.name);
            return Some(match definition.kind {
                DefinitionKind::Column => Change::RenameColumn { table: owner, column: name, to },
                _ => Change::RenameValue { enumeration: owner, value: name, to },
            });
        }
        DefinitionKind::Plan
        | DefinitionKind::Enum
        | DefinitionKind::Table
        | DefinitionKind::Entry(_)
        | DefinitionKind::Component(_) => {}
        _ => return None,
    }
    let found = analysis.compiled.outline.identity_at(file, start)?;
    (found.part == Part::Whole).then_some(Change::Rename { item: found.item, to })
}

/// Renames a definition in all plan files of the workspace and in the positions.
pub(crate) fn rename(server: &mut Server, params: lsp::RenameParams) -> Answer {
    let (analysis, offset) = server.at(&params.text_document_position_params)?;
    let (change, path) = renamed(&analysis, offset, params.new_name)?;
    let files = server.sources(&analysis, &path, std::slice::from_ref(&change));
    let home = files.iter().position(|file| file.name == path);
    let home = home.ok_or_else(|| Failure::Refused("its file cannot be read".to_owned()))?;
    let edits = afp_ide::edit::edit(&files, &analysis.set.toolboxes, home, &change)?;
    let mut all = by_file(|file| files.get(usize::from(file)), edits);
    all.extend(server.placed(&path, |layout| follow(layout, &change)));
    ok(server.edit(&all))
}

impl Server {
    /// Returns the plan files that changes of `home` may edit or read: those of a compilation and,
    /// if others may be affected, the files that use it.
    pub(crate) fn sources(
        &self,
        analysis: &Analysis,
        home: &str,
        changes: &[Change],
    ) -> Vec<Source> {
        let mut files: Vec<_> = analysis.compiled.plan_sources().cloned().collect();
        if changes.iter().any(Change::concerns_others) {
            self.add_users(home, &mut files);
        }
        files
    }

    /// Adds the direct and indirect users of a file that a path may cross, and the files that these
    /// use.
    fn add_users(&self, home: &str, files: &mut Vec<Source>) {
        let known: Vec<_> =
            files.iter().map(|file| (normalised(&file.name), used_files(file))).collect();
        let others = self.workspace.afp_files().into_iter();
        let others = others.filter(|path| files.iter().all(|file| file.name != *path));
        // Each file is read once.
        let read = |path: String| Some(Source::new(path.clone(), self.workspace.text(&path).ok()?));
        let mut others: Vec<_> = others.filter_map(read).collect();
        let (mut homes, mut done) = (vec![normalised(home)], 0);
        let mut beside = Vec::new();
        while let Some(home) = homes.get(done).cloned() {
            done += 1;
            let users = known.iter().filter(|(_, used)| used.contains(&home));
            let mut users: Vec<_> = users.map(|(path, _)| path.clone()).collect();
            let name = home.rsplit('/').next().unwrap_or_default();
            // Few files name it, and only those are parsed.
            let uses = |file: &mut Source| {
                let used = if file.text.contains(name) { used_files(file) } else { Vec::new() };
                let uses = used.contains(&home);
                if uses {
                    users.push(normalised(&file.name));
                    beside.extend(used);
                }
                uses
            };
            files.extend(others.extract_if(.., uses));
            users.retain(|user| !homes.contains(user));
            homes.extend(users);
        }
        for path in beside {
            if files.iter().all(|file| normalised(&file.name) != path)
                && let Some(text) = self.workspace.plan_text(&path)
            {
                files.push(Source::new(path, text));
            }
        }
    }

    /// Returns the edit of a file's positions; `None` if nothing changes.
    pub(crate) fn placed(&self, path: &str, change: impl FnOnce(&mut Layout)) -> Option<FileEdits> {
        let path = format!("{path}.layout");
        let text = self.workspace.text(&path).unwrap_or_default();
        let mut layout = Layout::read(&text).0;
        let before = layout.clone();
        change(&mut layout);
        if layout == before {
            return None;
        }
        let edits = difference(&text, &layout.write()).into_iter().collect();
        Some(FileEdits { path, text, edits })
    }

    /// Converts edits to versioned edits or a plain list, depending on the client.
    pub(crate) fn edit(&self, files: &[FileEdits]) -> lsp::WorkspaceEdit {
        let workspace = &self.workspace;
        let change = |file: &FileEdits| {
            let places = Places::new(&file.text, workspace.encoding);
            let edits: Vec<_> = file.edits.iter().map(|edit| text_edit(&places, edit)).collect();
            (workspace.uri(&file.path), edits)
        };
        if !self.client.versions {
            let changes = Some(files.iter().map(change).collect());
            return lsp::WorkspaceEdit { changes, ..lsp::WorkspaceEdit::default() };
        }
        let versioned = |file: &FileEdits| {
            let (uri, edits) = change(file);
            let text_document = lsp::OptionalVersionedTextDocumentIdentifier {
                version: workspace.documents.get(&file.path).map(|document| document.version),
                text_document_identifier: lsp::TextDocumentIdentifier { uri },
            };
            let edits = edits.into_iter().map(lsp::Edit::TextEdit).collect();
            lsp::DocumentChange::TextDocumentEdit(lsp::TextDocumentEdit { text_document, edits })
        };
        let document_changes = Some(files.iter().map(versioned).collect());
        lsp::WorkspaceEdit { document_changes, ..lsp::WorkspaceEdit::default() }
    }
}

/// Formats a document; a document with syntax errors stays unchanged.
pub(crate) fn formatting(server: &mut Server, params: lsp::DocumentFormattingParams) -> Answer {
    let path = uri::path(&params.text_document.uri);
    let text = server.workspace.text(&path).map_err(Failure::Refused)?;
    if !server.workspace.is_afp(&path) {
        return Ok(Value::Null);
    }
    let Ok(formatted) = afp_format::format(&text) else {
        return Err(Failure::Refused("the text has syntax errors".to_owned()));
    };
    let places = Places::new(&text, server.workspace.encoding);
    let edit = difference(&text, &formatted);
    ok(edit.iter().map(|edit| text_edit(&places, edit)).collect::<Vec<_>>())
}
