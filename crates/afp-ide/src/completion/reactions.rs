//! `on`: the supervisors of the plan that an element can react to, and their events.

use super::List;
use super::bodies::with_holes;
use super::plans::edge;
use afp_dsl::outline::{Component, ComponentKind};

/// Complete reactions, for each supervisor of the plan without a reaction of the element.
pub(super) fn whole(list: &mut List, element: Option<&Component>, offset: u32) {
    for name in free(list, element, offset) {
        list.keyword(&format!("on {name}"), with_holes(&format!("on {name} {{ ‹› }}")), 2);
    }
}

/// The names of these supervisors.
pub(super) fn watchers(list: &mut List, element: Option<&Component>, offset: u32) {
    let free = free(list, element, offset);
    let Some(plan) = list.view.plan_at(offset) else { return };
    let names = plan.supervisors.iter().filter_map(|each| each.name.as_ref());
    for name in names.filter(|name| free.contains(&name.text)) {
        if let Some(id) = list.view.index().declared_at(name.span) {
            list.definition(id, 0);
        }
    }
}

/// The events of a supervisor without a reaction.
pub(super) fn events(list: &mut List, reactions: Option<&Component>, offset: u32) {
    let Some(reactions) = reactions else { return };
    let Some(watcher) = reactions.item.reacts_to() else { return };
    let plan = list.view.plan_at(offset);
    let watcher =
        plan.and_then(|plan| plan.supervisors.iter().find(|it| it.item.name() == watcher));
    let written = |name: &str| reactions.exits.iter().any(|exit| *exit.name == *name);
    let exits = watcher.into_iter().flat_map(|watcher| &watcher.exits);
    for exit in exits.filter(|exit| exit.known && !written(&exit.name)) {
        if let Some(id) = exit.declared.and_then(|span| list.view.index().declared_at(span)) {
            list.definition_as(id, &exit.name, edge(&exit.name), 0);
        }
    }
    if !written("DeadlineMissed") {
        list.keyword("DeadlineMissed", edge("DeadlineMissed"), 2);
    }
}

/// The supervisors of the plan without a reaction of the element, by name.
fn free(list: &List, element: Option<&Component>, offset: u32) -> Vec<String> {
    let element = element.filter(|element| element.kind != ComponentKind::Computation);
    let (Some(element), Some(plan)) = (element, list.view.plan_at(offset)) else {
        return Vec::new();
    };
    let taken =
        |name: &str| element.reactions.iter().any(|each| each.item.reacts_to() == Some(name));
    let names = plan.supervisors.iter().filter_map(|each| each.name.as_ref());
    names.filter(|name| !taken(&name.text)).map(|name| name.text.clone()).collect()
}
