//! Changes of meaning and of places, answered with text edits.

use std::collections::BTreeMap;
use std::sync::Arc;

use afp_draw::Boxes;
use afp_draw::layout_file::Position;
use afp_ide::copy::copied;
use afp_ide::edit::{Change, Given, Made, edit_all, has_only_supervisors, item, path};
use afp_syntax::ast::Item as AstItem;
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::item::Item;
use gen_lsp_types as lsp;
use serde::Deserialize;
use serde_json::{Value, json};

use super::Document;
use super::drawing::{find, no_file};
use super::items::no_item;
use crate::answer::{Answer, Failure, ok};
use crate::file_edits::{FileEdits, by_file};
use crate::server::Server;
use crate::uri;

/// New places of items; `null` restores the automatic layout.
type Places = BTreeMap<String, Option<[f64; 2]>>;

/// Changes of a document, applied all or none.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Edit {
    text_document: Document,
    changes: Vec<Change>,
    #[serde(default)]
    places: Places,
}

/// Returns the edits for changes of the server's current version of a document. The answer names
/// that version.
pub(crate) fn edit(server: &mut Server, params: Edit) -> Answer {
    changed(server, &params.text_document, &params.changes, &params.places)
}

fn changed(
    server: &mut Server,
    document: &Document,
    changes: &[Change],
    places: &Places,
) -> Answer {
    let home_path = uri::path(&document.uri);
    let analysis = server.analysis(&document.uri).map_err(|_| no_file())?;
    let files = server.sources(&analysis, &home_path, changes);
    let home = files.iter().position(|file| file.name == home_path);
    let home = home.ok_or_else(|| Failure::Refused("a toolbox has no plans".to_owned()))?;
    let made = edit_all(&files, &analysis.set.toolboxes, home, changes)?;
    let Made { edits, changes: done, given, added } = made;
    let mut all = by_file(|file| files.get(usize::from(file)), edits);
    let placed = positions(places, &given)?;
    let after = server.workspace.drafted(&home_path, &all).unwrap_or_else(|| Arc::clone(&analysis));
    let (new, placed): (Vec<_>, Vec<_>) =
        placed.into_iter().partition(|(item, _)| added.contains(item));
    let wishes: Vec<_> = new.into_iter().filter_map(|(item, at)| Some((item, at?))).collect();
    all.extend(server.placed(&home_path, |layout| {
        let before = Boxes::new(&analysis.compiled.outline, analysis.file, layout, &[]);
        before.write(layout);
        done.iter().for_each(|change| afp_ide::edit::follow(layout, change));
        put(layout, &placed);
        let mut boxes = Boxes::new(&after.compiled.outline, after.file, layout, &wishes);
        boxes.make_room(&before);
        boxes.write(layout);
    }));
    ok(json!({
        "label": label(&done),
        "edit": whole(server, &all),
        "select": added.iter().map(path).collect::<Vec<_>>(),
        "names": given.all().iter().cloned().collect::<BTreeMap<_, _>>(),
    }))
}

/// Resolves the items' names and returns them with their places.
fn positions(places: &Places, given: &Given) -> Result<Vec<(Item, Option<Position>)>, Failure> {
    let place = |(path, at): (&String, &Option<[f64; 2]>)| {
        let item = given.item(item(path).ok_or_else(|| no_item(path))?);
        let number = |value: f64| value.round() as i32;
        Ok((item, at.map(|[x, y]| Position { x: number(x), y: number(y) })))
    };
    places.iter().map(place).collect()
}

fn put(layout: &mut afp_draw::layout_file::Layout, places: &[(Item, Option<Position>)]) {
    for (item, position) in places {
        match position {
            Some(position) => layout.set(item.clone(), *position),
            None => layout.remove(item),
        }
    }
}

/// The label of changes in an editor's history.
fn label(changes: &[Change]) -> String {
    let Some(last) = changes.iter().find(|change| !matches!(change, Change::AddUse { .. })) else {
        return "change".to_owned();
    };
    match last {
        Change::Add { .. }
        | Change::AddComponent { .. }
        | Change::AddEntry { .. }
        | Change::AddPlan { .. }
        | Change::AddUse { .. } => "add".to_owned(),
        Change::Remove { item } => format!("remove '{}'", item.name()),
        Change::Rename { item, .. } => format!("rename '{}'", item.name()),
        Change::RenameColumn { column: name, .. } | Change::RenameValue { value: name, .. } => {
            format!("rename '{name}'")
        }
        Change::Connect { outcome, .. } => format!("connect '{outcome}'"),
        Change::Disconnect { outcome, .. } => format!("disconnect '{outcome}'"),
        Change::SetStart { to, .. } => format!("start with '{to}'"),
        Change::Reorder { item, .. } | Change::Move { item, .. } => {
            format!("move '{}'", item.name())
        }
        Change::SetCondition { state, .. } => format!("change '{state}'"),
        Change::Assign { output, .. } => format!("set '{output}'"),
        Change::Bind { port, .. } => format!("set '{port}'"),
        Change::Unbind { port, .. } => format!("unset '{port}'"),
        Change::SetTemplate { component: item, .. }
        | Change::SetTiming { supervisor: item, .. }
        | Change::SetEntryKind { entry: item, .. }
        | Change::SetEntryType { entry: item, .. }
        | Change::SetEntryValue { entry: item, .. }
        | Change::SetDoc { item, .. }
        | Change::SetNote { item, .. } => format!("change '{}'", item.name()),
        Change::Extract { new_plan, .. } => format!("extract the plan '{new_plan}'"),
        Change::Inline { element, .. } => format!("replace '{element}' by its elements"),
    }
}

/// Returns edits together with the new files that they need.
fn whole(server: &Server, files: &[FileEdits]) -> lsp::WorkspaceEdit {
    let mut edit = server.edit(files);
    let new = files.iter().filter(|file| server.workspace.text(&file.path).is_err());
    if let Some(changes) = &mut edit.document_changes {
        for file in new {
            let create = lsp::CreateFile::new(server.workspace.uri(&file.path), None, None);
            changes.insert(0, lsp::DocumentChange::CreateFile(create));
        }
    }
    edit
}

/// Places for items of a document.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Place {
    text_document: Document,
    places: Places,
}

/// Returns the edit of the file of positions. If an item gets a place, the current places of all
/// other boxes are written, too.
pub(crate) fn place(server: &mut Server, params: Place) -> Answer {
    let placed = positions(&params.places, &Given::default())?;
    let analysis = server.analysis(&params.text_document.uri);
    let analysis = analysis.ok().filter(|_| placed.iter().any(|(_, at)| at.is_some()));
    let file = server.placed(&uri::path(&params.text_document.uri), |layout| {
        if let Some(analysis) = analysis {
            Boxes::new(&analysis.compiled.outline, analysis.file, layout, &[]).write(layout);
        }
        put(layout, &placed);
    });
    ok(whole(server, &file.into_iter().collect::<Vec<_>>()))
}

/// Items of a document.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Copy {
    text_document: Document,
    items: Vec<String>,
}

/// Returns items as text for [`paste`], with the `use` lines and the start that they need.
pub(crate) fn copy(server: &mut Server, params: Copy) -> Answer {
    let analysis = server.analysis(&params.text_document.uri)?;
    let items = params.items.iter().map(|path| item(path).ok_or_else(|| no_item(path)));
    let items = items.collect::<Result<Vec<_>, _>>()?;
    ok(json!({ "text": copied(&analysis.view(), &items) }))
}

/// Items to insert into a plan, or supervisors to insert at an element. The `owner` counts only for
/// supervisors.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Paste {
    text_document: Document,
    plan: String,
    owner: Option<String>,
    text: String,
    /// The place of the first item, unless supervisors go to the element.
    at: Option<[f64; 2]>,
}

/// Returns the edits that insert a text of items, with its `use` lines and unused names. In a plan
/// without a start, the item named by the text's `start` line becomes the start.
pub(crate) fn paste(server: &mut Server, params: Paste) -> Answer {
    let Paste { text_document, plan, owner, text, at } = params;
    let (mut changes, rest) = uses(&text);
    let (start, rest) = start(rest);
    let owner = owner.filter(|_| has_only_supervisors(&rest));
    let at = at.filter(|_| owner.is_none());
    changes.push(Change::Add { plan: plan.clone(), owner, text: rest, before: None });
    let start = start.filter(|_| !server.starts(&text_document, &plan));
    changes.extend(start.map(|to| Change::SetStart { plan: plan.clone(), to }));
    let answer = changed(server, &text_document, &changes, &Places::new())?;
    let first = answer.pointer("/select/0").and_then(Value::as_str).map(str::to_owned);
    match (first, at) {
        (Some(first), Some(at)) => {
            let name = item(&first).map(|item| item.name().to_owned()).unwrap_or_default();
            // The answer lists each new name under the name in the text.
            let wished = answer["names"].as_object().into_iter().flatten();
            let wished = wished.into_iter().find(|(_, given)| **given == json!(name));
            let wished = wished.map_or(name.clone(), |(wanted, _)| wanted.clone());
            let places = Places::from([(format!("{plan}.{wished}"), Some(at))]);
            changed(server, &text_document, &changes, &places)
        }
        _ => Ok(answer),
    }
}

/// Splits a text into its `use` lines, as changes, and the rest.
fn uses(text: &str) -> (Vec<Change>, String) {
    let items = afp_syntax::parse(text, 0, &mut Diagnostics::default()).file().items();
    let mut changes = Vec::new();
    let mut end = 0;
    for item in items {
        let AstItem::Use(line) = item else { break };
        let Some(toolbox) = line.toolbox() else { break };
        let alias = line.alias().map(|alias| alias.text);
        end = line.span().end as usize;
        changes.push(Change::AddUse { toolbox: toolbox.text, alias });
    }
    (changes, text.get(end..).unwrap_or_default().to_owned())
}

/// Splits off the `start` line of a text of items, and returns the element that it names.
fn start(text: String) -> (Option<String>, String) {
    let (before, after) = ("plan P {\n", "\n}\n");
    let whole = format!("{before}{text}{after}");
    let items = afp_syntax::parse(&whole, 0, &mut Diagnostics::default()).file().items();
    let [AstItem::Plan(plan)] = &items[..] else { return (None, text) };
    let [start] = &plan.starts()[..] else { return (None, text) };
    let Some(to) = start.target() else { return (None, text) };
    let (from, end) = (start.span().start as usize, start.span().end as usize);
    let parts = whole.get(before.len()..from).zip(whole.get(end..whole.len() - after.len()));
    let Some((above, below)) = parts else { return (None, text) };
    let is_there =
        plan.elements().iter().any(|one| one.name().is_some_and(|name| name.text == to.text));
    (is_there.then_some(to.text), format!("{above}{below}"))
}

impl Server {
    fn starts(&mut self, document: &Document, plan: &str) -> bool {
        let Ok(analysis) = self.analysis(&document.uri) else { return false };
        let outline = &analysis.compiled.outline;
        let id = find(outline, analysis.file, Some(plan)).ok().flatten();
        id.is_some_and(|id| !outline.plan(id).starts.is_empty())
    }
}
