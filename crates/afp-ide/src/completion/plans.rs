//! Items of files and plans, edges and their targets.

use super::List;
use super::bodies::{
    Piece, body_of_plan, body_of_template, component, instance_name, plain, with_holes,
};
use super::context::Origin;
use crate::edit::{Taken, edit_of_use};
use crate::view::token;
use afp_dsl::index::{DefinitionId, DefinitionKind};
use afp_dsl::outline::{Component, ComponentKind, Plan};
use afp_dsl::toolbox::{Template, Toolbox};
use afp_syntax::Node;
use afp_syntax::kind::Kind;

pub(super) fn of_file(list: &mut List) {
    list.keyword("use", plain("use "), 0);
    list.keyword("plan", with_holes("plan ‹Name› {\n    start ‹›\n}"), 0);
    list.keyword("enum", with_holes("enum ‹Name› { ‹first second› }"), 1);
    let (head, first, last) =
        ("in ‹value: float›", "state ‹Low› when ‹value < 1› {}", "state ‹High› {}");
    let computation = format!("computation ‹Name› {{\n    {head}\n    {first}\n    {last}\n}}");
    list.keyword("computation", with_holes(&computation), 1);
    let table = "table ‹name›(‹x: length, y: length›) {\n    (‹1 m, 2 m›)\n}";
    list.keyword("table", with_holes(table), 1);
    let (head, body) =
        ("scenario \"‹what it shows›\" for ‹Plan›", "expect ‹end›\n    until ‹60 s›");
    list.keyword("scenario", with_holes(&format!("{head} {{\n    {body}\n}}")), 1);
}

pub(super) fn uses(list: &mut List) {
    let all = list.view.index().definitions();
    let all = all.filter(|(_, known)| known.kind == DefinitionKind::Toolbox);
    list.definitions(all.map(|(id, _)| id), 0);
}

/// Items of a plan: keywords, and templates and plans with complete bodies.
pub(super) fn items(list: &mut List, plan: Option<&Plan>, node: &Node) {
    let started = plan.is_some_and(|plan| !plan.starts.is_empty());
    list.keywords(&["start"], if started { 4 } else { 0 });
    list.keywords(&["actor", "supervise", "computation", "subplan"], 1);
    list.keywords(&["in", "out", "var", "const"], 1);
    let taken = plan.map(names).unwrap_or_default();
    let own = plan.and_then(|plan| plan.name.as_ref()).map(|name| name.span);
    let offset = u32::from(node.text_range().start());
    for made in all_made(list, offset) {
        if Some(list.view.index().definition(made.id).name) == own {
            continue;
        }
        let name = instance_name(list.view.name_of(made.id), &taken);
        add_made(list, &made, component(made.kind, &name, &made.written, &made.body), 2);
    }
}

fn names(plan: &Plan) -> Taken {
    let entries = plan.entries.iter().filter_map(|entry| entry.name.as_ref());
    let components = plan.supervisors.iter().chain(&plan.elements);
    let components = components.filter_map(|component| component.name.as_ref());
    Taken::of(entries.chain(components).map(|name| name.text.as_str()))
}

/// A template or plan for components.
struct Made {
    id: DefinitionId,
    kind: ComponentKind,
    /// Its name in this file.
    written: String,
    body: Vec<Piece>,
    /// The toolbox to import first.
    missing: Option<String>,
}

/// All templates of all toolboxes, and the visible plans.
fn all_made(list: &List, offset: u32) -> Vec<Made> {
    let view = list.view;
    let is_made = |kind| matches!(kind, DefinitionKind::Template(_) | DefinitionKind::Plan);
    let visible = view.index().visible(view.file, offset, is_made);
    let mut all = Vec::new();
    for (toolbox, template) in templates_of(list) {
        let Some(id) = view.index().declared_at(template.span) else { continue };
        let missing = !visible.contains(&id);
        let alias = alias(list, toolbox);
        let several =
            visible.iter().filter(|other| view.name_of(**other) == template.name).count() > 1;
        let written = match (alias, several) {
            (Some(alias), _) => format!("{alias}.{}", template.name),
            (None, true) => format!("{}.{}", toolbox.name, template.name),
            (None, false) => template.name.clone(),
        };
        all.push(Made {
            id,
            kind: crate::describe::component_kind(template.kind),
            written,
            body: body_of_template(template),
            missing: missing.then(|| toolbox.name.clone()),
        });
    }
    for plan in &view.outline().plans {
        let Some(name) = &plan.name else { continue };
        let Some(id) = view.index().declared_at(name.span).filter(|id| visible.contains(id)) else {
            continue;
        };
        let body = body_of_plan(view, plan);
        let written = name.text.clone();
        all.push(Made { id, kind: ComponentKind::SubPlan, written, body, missing: None });
    }
    all
}

fn templates_of<'l>(list: &'l List) -> impl Iterator<Item = (&'l Toolbox, &'l Template)> {
    list.view
        .all_toolboxes()
        .flat_map(|toolbox| toolbox.templates.iter().map(move |template| (&**toolbox, template)))
}

fn alias(list: &List, toolbox: &Toolbox) -> Option<String> {
    let files = &list.view.outline().files;
    let file = files.iter().find(|file| file.file == list.view.file)?;
    let line = file
        .uses
        .iter()
        .find(|line| line.toolbox.as_ref().is_some_and(|it| it.text == toolbox.name))?;
    line.alias.as_ref().map(|alias| alias.text.clone())
}

fn add_made(list: &mut List, made: &Made, insert: Vec<Piece>, rank: u8) {
    let label = list.view.name_of(made.id).to_owned();
    let far = u8::from(made.missing.is_some()) * 4;
    list.definition_as(made.id, &label, insert, rank + far);
    if let (Some(toolbox), Some(last)) = (&made.missing, list.all.last_mut()) {
        let line = list.uses.entry(toolbox.clone());
        let view = list.view;
        let edit = || edit_of_use(view.text(), view.root(), view.file, toolbox);
        last.with = line.or_insert_with(edit).iter().cloned().collect();
    }
}

/// Adds the templates for a keyword, with a body if it is missing. After a toolbox and a `.`, only
/// those of the toolbox.
pub(super) fn templates(list: &mut List, node: &Node, home: Option<DefinitionId>) {
    let word = token(node, Kind::Keyword).map(|word| word.text().to_owned()).unwrap_or_default();
    let bare = token(node, Kind::OpenBrace).is_none();
    let offset = u32::from(node.text_range().start());
    for made in all_made(list, offset) {
        let owner = list.view.index().definition(made.id).owner;
        if made.kind.keyword() != word || (home.is_some() && owner != home) {
            continue;
        }
        let written = if home.is_some() { list.view.name_of(made.id) } else { &made.written };
        let mut insert = plain(written);
        if bare {
            insert.extend(made.body.clone());
        }
        add_made(list, &made, insert, 0);
    }
}

pub(super) fn times(list: &mut List) {
    list.keywords(&["every", "deadline"], 0);
}

/// Missing edges, and supervisors for an element.
pub(super) fn of_component(list: &mut List, component: Option<&Component>, is_element: bool) {
    let Some(component) = component else { return };
    for exit in component.exits.iter().filter(|exit| exit.known && exit.edge.is_none()) {
        let rank = u8::from(!exit.required);
        match exit.declared.and_then(|span| list.view.index().declared_at(span)) {
            Some(id) => list.definition_as(id, &exit.name, edge(&exit.name), rank),
            None => list.keyword(&exit.name, edge(&exit.name), rank),
        }
    }
    let has =
        |name: &str| component.exits.iter().any(|exit| *exit.name == *name && exit.edge.is_some());
    let fault =
        if component.kind == ComponentKind::Supervisor { "DeadlineMissed" } else { "Error" };
    if !has(fault) && component.kind != ComponentKind::Computation {
        list.keyword(fault, edge(fault), 2);
    }
    if is_element && component.kind != ComponentKind::Computation {
        list.keywords(&["supervise"], 2);
        let names = component.supervisors.iter().filter_map(|it| it.name.as_ref());
        let taken = Taken::of(names.map(|name| name.text.as_str()));
        for made in all_made(list, component.span.start) {
            if made.kind != ComponentKind::Supervisor {
                continue;
            }
            let name = instance_name(list.view.name_of(made.id), &taken);
            add_made(list, &made, self::component(made.kind, &name, &made.written, &made.body), 3);
        }
    }
}

/// An edge with a placeholder as its target.
pub(super) fn edge(name: &str) -> Vec<Piece> {
    with_holes(&format!("{name} -> ‹›"))
}

pub(super) fn targets(list: &mut List, offset: u32, from: Origin) {
    elements(list, offset);
    list.keyword("terminate", plain("terminate"), 1);
    list.keyword("fail", plain("fail"), 1);
    if from == Origin::Event {
        list.keyword("ignore", plain("ignore"), 1);
    }
    if from != Origin::Other {
        list.keyword("resume", plain("resume"), 1);
        list.keyword("suspend", plain("suspend "), 1);
    }
    let Some(plan) = list.view.plan_at(offset) else { return };
    let of_elements = plan.elements.iter().flat_map(|element| {
        [element].into_iter().chain(&element.supervisors).chain(&element.reactions)
    });
    let exits = plan.supervisors.iter().chain(of_elements).flat_map(|component| &component.exits);
    let mut targets = exits.filter_map(|exit| exit.edge.as_ref()?.target.as_ref());
    if targets.any(|target| target.suspends()) {
        list.keyword("return", plain("return"), 1);
    }
}

pub(super) fn elements(list: &mut List, offset: u32) {
    let Some(plan) = list.view.plan_at(offset) else { return };
    let names = plan.elements.iter().filter_map(|element| element.name.as_ref());
    let index = list.view.index();
    list.definitions(names.filter_map(|name| index.declared_at(name.span)), 0);
}

pub(super) fn plan_names(list: &mut List) {
    visible(list, 0, DefinitionKind::Plan);
}

pub(super) fn tables(list: &mut List, offset: u32) {
    visible(list, offset, DefinitionKind::Table);
}

fn visible(list: &mut List, offset: u32, kind: DefinitionKind) {
    let view = list.view;
    list.definitions(view.index().visible(view.file, offset, |known| known == kind), 0);
}
