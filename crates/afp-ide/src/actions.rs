//! Code actions: fixes of diagnostics, and changes of meaning.

use crate::View;
use crate::edit::{Change, TextEdit, edit_all, fresh_name};
use afp_dsl::outline::{Component, ComponentKind, Plan};
use afp_syntax::diagnostics::Diagnostic;
use afp_syntax::source::{Source, Span};

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Action {
    /// Its title, a lower-case imperative.
    pub title: String,
    pub kind: ActionKind,
    /// The diagnostic that it fixes: an index into those of the compilation.
    pub mends: Option<usize>,
    /// The edits; spans are in the files of the compilation.
    pub edits: Vec<TextEdit>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ActionKind {
    Fix,
    /// Moves elements into a new plan.
    Extract,
    /// Replaces a sub-plan by its elements.
    Inline,
}

/// Returns all actions at a place, fixes first.
pub fn actions(view: &View, place: Span) -> Vec<Action> {
    let mut actions = fixes(view, place);
    let components = components_at(view, place);
    actions.extend(components.iter().filter_map(|component| missing_exits(view, component)));
    if let Some(plan) = view.plan_at(place.start) {
        actions.extend(extract(view, plan, place));
        let innermost =
            components.last().filter(|component| component.kind == ComponentKind::SubPlan);
        actions.extend(innermost.and_then(|component| inline(view, component)));
    }
    actions
}

/// Returns the fix of each diagnostic that touches a place.
fn fixes(view: &View, place: Span) -> Vec<Action> {
    let touches = |diagnostic: &Diagnostic| {
        let span = diagnostic.span;
        span.file == view.file && span.start <= place.end && place.start <= span.end
    };
    let found = view.compiled.diags.iter().enumerate().filter(|(_, each)| touches(each));
    let fix = |(index, diagnostic): (usize, &Diagnostic)| {
        let fix = diagnostic.fix.clone()?;
        let title = match diagnostic.help_text() {
            help if help.is_empty() => diagnostic.message_text(),
            help => help,
        };
        Some(Action { title, kind: ActionKind::Fix, mends: Some(index), edits: vec![fix] })
    };
    found.filter_map(fix).collect()
}

/// The elements and supervisors that cover the start of a place, outermost first.
fn components_at<'a>(view: &View<'a>, place: Span) -> Vec<&'a Component> {
    let start = place.before();
    let plan = view.plan_at(place.start);
    let all = plan.into_iter().flat_map(|plan| plan.components());
    all.filter(|component| component.span.contains(start)).collect()
}

/// Connects open exits to the end of the plan and ignores open events. The user can then edit these
/// lines.
fn missing_exits(view: &View, component: &Component) -> Option<Action> {
    let missing = component.exits.iter().filter(|exit| exit.required && exit.edge.is_none());
    let missing: Vec<_> = missing.map(|exit| exit.name.to_string()).collect();
    let to = match component.kind {
        ComponentKind::Supervisor => "ignore",
        _ => "terminate",
    };
    let connect = |outcome: &String| Change::Connect {
        from: component.item.clone(),
        outcome: outcome.clone(),
        to: to.to_owned(),
    };
    let changes: Vec<_> = missing.iter().map(connect).collect();
    let edits = made(view, &changes)?;
    let names = afp_syntax::diagnostics::words::list(missing.iter().map(String::as_str), "and");
    let about = |diagnostic: &Diagnostic| {
        diagnostic.code.as_str() == "E0211" && component.span.contains(diagnostic.span)
    };
    let mends = view.compiled.diags.iter().position(about);
    let title = format!("lead {names} of '{}' to '{to}'", component.item.name());
    Some(Action { title, kind: ActionKind::Fix, mends, edits })
}

/// Moves the elements of a selection into a new plan, if it touches several or contains a whole
/// one.
fn extract(view: &View, plan: &Plan, place: Span) -> Option<Action> {
    let touched =
        |element: &&Component| element.span.start < place.end && place.start < element.span.end;
    let elements: Vec<_> = plan.elements.iter().filter(touched).collect();
    let whole = matches!(elements.as_slice(), [one] if place.contains(one.span));
    if elements.len() < 2 && !whole {
        return None;
    }
    let plans: Vec<_> = view.plans().map(|plan| plan.item.name().to_owned()).collect();
    let entries = plan.entries.iter().map(|entry| &entry.item);
    let inner = entries.chain(plan.supervisors.iter().chain(&plan.elements).map(|it| &it.item));
    let inner: Vec<_> = inner.map(|item| item.name().to_owned()).collect();
    let change = Change::Extract {
        plan: plan.item.name().to_owned(),
        elements: elements.iter().map(|element| element.item.name().to_owned()).collect(),
        new_plan: fresh_name("Part", &plans),
        element: fresh_name("part", &inner),
    };
    let edits = made(view, &[change])?;
    let names = elements.iter().map(|element| element.item.name());
    let names = afp_syntax::diagnostics::words::list(names, "and");
    let title = format!("extract {names} into a plan");
    Some(Action { title, kind: ActionKind::Extract, mends: None, edits })
}

fn inline(view: &View, component: &Component) -> Option<Action> {
    let name = component.item.name();
    let plan = component.item.plan_name().to_owned();
    let edits = made(view, &[Change::Inline { plan, element: name.to_owned() }])?;
    let title = format!("replace '{name}' by the elements of its plan");
    Some(Action { title, kind: ActionKind::Inline, mends: None, edits })
}

/// Returns the edits of changes to the file; `None` if they are refused or change nothing.
fn made(view: &View, changes: &[Change]) -> Option<Vec<TextEdit>> {
    let first = view.compiled.plan_files.start;
    let home = usize::from(view.file).checked_sub(first)?;
    let files: Vec<Source> = view.compiled.plan_sources().cloned().collect();
    let mut edits = edit_all(&files, view.toolboxes, home, changes).ok()?.edits;
    let offset = u16::try_from(first).ok()?;
    edits.iter_mut().for_each(|edit| edit.span.file += offset);
    (!edits.is_empty()).then_some(edits)
}
