//! Changes of a file, and its expected content afterwards.

use afp_ide::edit::{Binding, Change};
use afp_syntax::item::Item;
use proptest::sample::Index;

use crate::model::{Model, Place, Plan};

/// A random choice: change, plan, component, part of it, other component.
pub type Pick = (u8, Index, Index, Index, Index);

/// A change and the resulting file; the inner `None` is a refused change, the outer one an
/// impossible choice.
pub fn change(model: &Model, pick: &Pick) -> Option<(Change, Option<Model>)> {
    let (which, plan, component, part, other) = pick;
    let plan = plan.get(&model.plans);
    let items = items(plan);
    let item = component.get(&items).clone();
    let mut after = model.clone();
    let target = other.get(&plan.elements).name.clone();
    match which % 10 {
        0 => connect(&mut after, item, part, target),
        1 => disconnect(&mut after, item, part),
        2 => bind(&mut after, plan, item, part, other),
        3 => unbind(&mut after, item, part),
        4 => rename(&mut after, plan, item),
        5 => remove_component(&mut after, item),
        6 => {
            after.plan(&plan.name).starts = vec![(target.clone(), Place::default())];
            Some((Change::SetStart { plan: plan.name.clone(), to: target }, Some(after)))
        }
        7 => entry(&mut after, plan, part),
        8 => reorder(&mut after, plan, part, other),
        _ => timing(&mut after, item),
    }
}

fn items(plan: &Plan) -> Vec<Item> {
    let mut items = Vec::new();
    for element in &plan.elements {
        items.push(Item::inner(&plan.name, &element.name));
        let locals = element.guards.iter();
        items.extend(locals.map(|guard| Item::local(&plan.name, &element.name, &guard.name)));
    }
    items.extend(plan.guards.iter().map(|guard| Item::inner(&plan.name, &guard.name)));
    items
}

type Pair = Option<(Change, Option<Model>)>;

fn connect(after: &mut Model, from: Item, part: &Index, to: String) -> Pair {
    let component = after.component(&from)?;
    let place = part.index(component.edges.len() + 1);
    let outcome = component.edges.get(place).map_or("Another".to_owned(), |edge| edge.0.clone());
    match component.edges.iter_mut().find(|edge| edge.0 == outcome) {
        Some(edge) => edge.1 = to.clone(),
        None => component.edges.push((outcome.clone(), to.clone(), Place::default())),
    }
    Some((Change::Connect { from, outcome, to }, Some(after.clone())))
}

fn disconnect(after: &mut Model, from: Item, part: &Index) -> Pair {
    let component = after.component(&from)?;
    let place = part.index(component.edges.len().max(1));
    let outcome = component.edges.get(place)?.0.clone();
    component.edges.remove(component.edges.iter().position(|edge| edge.0 == outcome)?);
    Some((Change::Disconnect { from, outcome }, Some(after.clone())))
}

fn bind(after: &mut Model, plan: &Plan, item: Item, part: &Index, other: &Index) -> Pair {
    let component = after.component(&item)?;
    let place = part.index(component.binds.len() + 1);
    let port = component.binds.get(place).map_or("another".to_owned(), |bind| bind.0.clone());
    let entry = plan.entries.get(other.index(plan.entries.len().max(1)));
    let (to, words) = match entry {
        Some(entry) if other.index(2) == 1 => {
            (Binding::Out(entry.name.clone()), vec!["=>".to_owned(), entry.name.clone()])
        }
        _ => {
            let words = ["=", "2", "*", "(", "3", "cm", "+", "-", "k", ")"];
            (Binding::In("2 * (3 cm + -k)".into()), words.map(str::to_owned).to_vec())
        }
    };
    match component.binds.iter_mut().find(|bind| bind.0 == port) {
        Some(bind) => bind.1 = words,
        None => component.binds.push((port.clone(), words, Place::default())),
    }
    Some((Change::Bind { component: item, port, to }, Some(after.clone())))
}

fn unbind(after: &mut Model, item: Item, part: &Index) -> Pair {
    let component = after.component(&item)?;
    let place = part.index(component.binds.len().max(1));
    let port = component.binds.get(place)?.0.clone();
    component.binds.remove(place);
    Some((Change::Unbind { component: item, port }, Some(after.clone())))
}

fn rename(after: &mut Model, plan: &Plan, item: Item) -> Pair {
    let to = "renamed".to_owned();
    let is_element = plan.elements.iter().any(|element| element.name == item.name());
    after.component(&item)?.name = to.clone();
    if let (Item::Inner { name, .. }, true) = (&item, is_element) {
        let changed = after.plan(&plan.name);
        let starts = changed.starts.iter_mut().filter(|start| start.0 == *name);
        starts.for_each(|start| start.0 = to.clone());
        changed.change_all(|component| {
            let edges = component.edges.iter_mut().filter(|edge| edge.1 == *name);
            edges.for_each(|edge| edge.1 = to.clone());
        });
    }
    Some((Change::Rename { item, to }, Some(after.clone())))
}

fn remove_component(after: &mut Model, item: Item) -> Pair {
    let plan = after.plan(item.plan_name());
    match &item {
        Item::Local { owner, name, .. } => {
            let owner = plan.elements.iter_mut().find(|element| element.name == *owner)?;
            owner.guards.retain(|guard| guard.name != *name);
        }
        Item::Inner { name, .. } if plan.guards.iter().any(|guard| guard.name == *name) => {
            plan.guards.retain(|guard| guard.name != *name);
        }
        _ => {
            plan.elements.retain(|element| element.name != item.name());
            plan.starts.retain(|start| start.0 != item.name());
            plan.change_all(|component| component.edges.retain(|edge| edge.1 != item.name()));
        }
    }
    Some((Change::Remove { item }, Some(after.clone())))
}

/// Renames an entry, removes one, or changes a part of one.
fn entry(after: &mut Model, plan: &Plan, part: &Index) -> Pair {
    let place = part.index(plan.entries.len().max(1) * 4);
    let name = plan.entries.get(place / 4)?.name.clone();
    let item = Item::inner(&plan.name, &name);
    let changed = &mut after.plan(&plan.name).entries[place / 4];
    Some(match place % 4 {
        0 => {
            changed.ty = Some("length^2/mass".to_owned());
            let ty = changed.ty.clone();
            (Change::SetEntryType { entry: item, ty }, Some(after.clone()))
        }
        1 => {
            changed.value = None;
            (Change::SetEntryValue { entry: item, value: None }, Some(after.clone()))
        }
        2 => {
            let to = "renamed".to_owned();
            changed.name = to.clone();
            rename_entry(after, plan, &name, &to);
            (Change::Rename { item, to }, Some(after.clone()))
        }
        _ => {
            let is_read = |words: &[String]| words[0] == "=" && words[1..].contains(&name);
            let components = plan.components();
            let mut values = plan.entries.iter().filter(|entry| entry.name != name);
            let read = components.iter().any(|one| one.binds.iter().any(|bind| is_read(&bind.1)))
                || values.any(|entry| entry.value.iter().flatten().any(|word| *word == name));
            after.plan(&plan.name).entries.remove(place / 4);
            after.plan(&plan.name).change_all(|component| {
                component.binds.retain(|bind| bind.1[0] == "=" || bind.1[1] != name);
            });
            for outer in &mut after.plans {
                outer.change_all(|component| {
                    if component.template == plan.name {
                        component.binds.retain(|bind| bind.0 != name);
                    }
                });
            }
            (Change::Remove { item }, (!read).then(|| after.clone()))
        }
    })
}

fn rename_entry(after: &mut Model, plan: &Plan, name: &str, to: &str) {
    let rename = |words: &mut Vec<String>| {
        for word in words.iter_mut().filter(|word| *word == name) {
            *word = to.to_owned();
        }
    };
    let changed = after.plan(&plan.name);
    changed.entries.iter_mut().filter_map(|entry| entry.value.as_mut()).for_each(rename);
    changed.change_all(|component| component.binds.iter_mut().for_each(|bind| rename(&mut bind.1)));
    for outer in &mut after.plans {
        outer.change_all(|component| {
            let ports = component.binds.iter_mut().filter(|bind| bind.0 == name);
            if component.template == plan.name {
                ports.for_each(|bind| bind.0 = to.to_owned());
            }
        });
    }
}

fn reorder(after: &mut Model, plan: &Plan, part: &Index, other: &Index) -> Pair {
    let from = part.index(plan.elements.len());
    let to = other.index(plan.elements.len() + 1);
    let item = Item::inner(&plan.name, &plan.elements[from].name);
    let before = plan.elements.get(to).map(|element| element.name.clone());
    let elements = &mut after.plan(&plan.name).elements;
    let moved = elements.remove(from);
    let own = before.as_ref() == Some(&moved.name);
    let place = match &before {
        _ if own => from,
        None => elements.len(),
        Some(before) => elements.iter().position(|element| element.name == *before)?,
    };
    elements.insert(place, moved);
    Some((Change::Reorder { item, before }, Some(after.clone())))
}

fn timing(after: &mut Model, supervisor: Item) -> Pair {
    let component = after.component(&supervisor)?;
    let keyword = "every".to_owned();
    let value = "7 ms".to_owned();
    if component.kind.is_none() {
        match component.timings.iter_mut().find(|timing| timing.0 == keyword) {
            Some(timing) => timing.1 = value.clone(),
            None => component.timings.insert(0, (keyword.clone(), value.clone())),
        }
    }
    let expected = component.kind.is_none().then(|| after.clone());
    Some((Change::SetTiming { supervisor, keyword, value: Some(value) }, expected))
}
