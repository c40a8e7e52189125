//! A change and its inverse restore the bytes, for every item of the shipped plans.

use std::fs;
use std::path::{Path, PathBuf};

use afp_dsl::Toolboxes;
use afp_dsl::compile;
use afp_dsl::files::Texts;
use afp_dsl::outline::{Component, ComponentKind, Outline, Plan};
use afp_ide::edit::{Binding, Change, apply, edit};
use afp_syntax::item::Item;
use afp_syntax::source::Source;

use crate::TOOLBOXES;

/// The plan files below the repository's `plans` and `examples`.
fn shipped() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut open = vec![root.join("plans"), root.join("examples")];
    let mut found = Vec::new();
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() && !path.ends_with("target") {
                open.push(path);
            } else if path.extension().is_some_and(|ending| ending == "afp") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

fn changed(text: &str, change: &Change) -> String {
    let source = Source::new("case.afp", text);
    match edit(&[source], &TOOLBOXES, 0, change) {
        Ok(edits) => apply(text, &edits),
        Err(refused) => panic!("{change:?}: {refused}\n{text}"),
    }
}

fn there_and_back(text: &str, change: &Change, inverse: &Change) {
    let after = changed(text, change);
    assert_ne!(after, text, "{change:?}");
    assert_eq!(alone(&changed(&after, inverse)), alone(text), "{change:?} and back");
}

/// Replaces `goal = goal` and `goal => goal` by `goal`, since an inverse does not restore the long
/// form.
fn alone(text: &str) -> String {
    let mut short = text.to_owned();
    for sign in [" = ", " => "] {
        let mut from = 0;
        while let Some(at) = short[from..].find(sign).map(|at| from + at) {
            let rest = short[at + sign.len()..].split(|it: char| !is_part(it)).next().unwrap();
            let port = short[..at].rsplit(|it: char| !is_part(it)).next().unwrap();
            let end = at + sign.len() + rest.len();
            from = at + sign.len();
            if rest == port {
                short.replace_range(at..end, "");
                from = at;
            }
        }
    }
    short
}

fn is_part(character: char) -> bool {
    character.is_alphanumeric() || character == '_'
}

fn renamed(item: &Item) -> (Change, Change) {
    let (name, new) = (item.name().to_owned(), "quiteAnotherName");
    let there = match item {
        Item::Plan { .. } => Item::plan(new),
        Item::Enum { .. } => Item::enumeration(new),
        Item::Table { .. } => Item::table(new),
        Item::Inner { plan, .. } => Item::inner(plan, new),
        Item::Local { plan, owner, .. } => Item::local(plan, owner, new),
    };
    let change = Change::Rename { item: item.clone(), to: new.to_owned() };
    (change, Change::Rename { item: there, to: name })
}

fn items(outline: &Outline) -> Vec<Item> {
    let first = outline.files.first().unwrap();
    let enums = first.enums.iter().map(|each| each.item.clone());
    let plans = first.plans.iter().map(|plan| outline.plan(*plan)).flat_map(|plan| {
        let entries = plan.entries.iter().map(|entry| entry.item.clone());
        // A reaction has the name of its supervisor.
        let named = plan.components().filter(|it| it.kind != ComponentKind::Reactions);
        let components = named.map(|component| component.item.clone());
        std::iter::once(plan.item.clone()).chain(entries).chain(components).collect::<Vec<_>>()
    });
    let tables = first.tables.iter().map(|each| each.item.clone());
    enums.chain(tables).chain(plans).collect()
}

/// The target of every edge of a text, by element and name.
fn targets(text: &str) -> Vec<String> {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let compiled = compile(&Source::new("case.afp", text), &toolboxes, &Texts::default());
    let components = compiled.outline.plans.iter().flat_map(Plan::components);
    let exits = components.flat_map(|component| {
        component.exits.iter().map(|exit| {
            let target = exit.edge.as_ref().and_then(|edge| edge.target.as_ref());
            let target = target.map_or("", |target| &target.text);
            format!("{}.{} -> {target}", component.item, exit.name)
        })
    });
    let mut targets: Vec<_> = exits.collect();
    targets.sort();
    targets
}

/// Redirects each edge of a component to `terminate`, doubles each formula, and reverts both.
fn of_component(text: &str, component: &Component) -> usize {
    let mut tried = 0;
    let item = &component.item;
    for exit in &component.exits {
        let edge = exit.edge.as_ref().and_then(|edge| edge.target.as_ref());
        let Some(target) = edge.filter(|target| target.text != "terminate") else { continue };
        let to = |to: &str| Change::Connect {
            from: item.clone(),
            outcome: exit.name.to_string(),
            to: to.to_owned(),
        };
        let edges = component.exits.iter().filter_map(|exit| exit.edge.as_ref());
        let same_line = edges.filter_map(|edge| edge.target.as_ref());
        if same_line.filter(|other| other.span == target.span).count() > 1 {
            // An outcome that left a shared line returns on a separate line.
            let back = changed(&changed(text, &to("terminate")), &to(&target.text));
            assert_eq!(targets(&back), targets(text), "{item}.{}", exit.name);
        } else {
            there_and_back(text, &to("terminate"), &to(&target.text));
        }
        tried += 1;
    }
    for input in &component.inputs {
        let Some(value) = input.binding.as_ref().and_then(|binding| binding.value.as_ref()) else {
            continue;
        };
        let written = &text[value.span.start as usize..value.span.end as usize];
        let bind = |formula: String| Change::Bind {
            component: item.clone(),
            port: input.name.to_string(),
            to: Binding::In(formula),
        };
        there_and_back(text, &bind(format!("2 * ({written})")), &bind(written.to_owned()));
        tried += 1;
    }
    tried
}

fn of_start(text: &str, plan: &Plan) {
    let start = plan.starts.first().and_then(|start| start.target.as_ref()).unwrap();
    let name = |item: &Item| item.name().to_owned();
    let other = plan.elements.iter().map(|each| name(&each.item)).find(|each| *each != start.text);
    let to = |to: &str| Change::SetStart { plan: name(&plan.item), to: to.to_owned() };
    if let Some(other) = other {
        there_and_back(text, &to(&other), &to(&start.text));
    }
}

#[test]
fn a_change_and_its_inverse_restore_the_bytes() {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let mut tried = 0;
    for path in shipped() {
        let text = fs::read_to_string(&path).unwrap();
        let source = Source::new("case.afp", text.as_str());
        let compiled = compile(&source, &toolboxes, &Texts::default());
        for item in items(&compiled.outline) {
            let (there, back) = renamed(&item);
            there_and_back(&text, &there, &back);
            tried += 1;
        }
        let outline = &compiled.outline;
        for plan in outline.files[0].plans.iter().map(|plan| outline.plan(*plan)) {
            of_start(&text, plan);
            for component in plan.components() {
                tried += of_component(&text, component);
            }
        }
    }
    assert!(tried > 100, "only {tried} changes of shipped plans");
}

#[test]
fn items_with_the_same_name_are_distinct() {
    let text = "plan P {\n    start a\n    actor a: A { Done -> a }\n    actor a: B { Done -> a }\n    actor : C { Done -> a }\n}\n";
    let rename = |name: &str| Change::Rename { item: Item::inner("P", name), to: "b".into() };
    let second = changed(text, &rename("a#2"));
    assert_eq!(second, text.replace("a: B", "b: B"));
    let first = changed(text, &rename("a"));
    assert_eq!(
        first,
        text.replace("a: A", "b: A").replace("-> a", "-> b").replace("start a", "start b")
    );
    let remove = Change::Remove { item: Item::inner("P", "#1") };
    assert_eq!(changed(text, &remove), text.replace("    actor : C { Done -> a }\n", ""));
    let nameless = edit(&[Source::new("case.afp", text)], &TOOLBOXES, 0, &rename("#1"));
    assert_eq!(nameless.unwrap_err().reason, "it has no name yet");
}
